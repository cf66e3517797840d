from __future__ import annotations

import io
import re

import pytest

from rossmarie.report.model import Replay
from rossmarie.report.table import write_table
from support.docking import docking


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_plain_text_has_one_line_for_each_rule(drive: Replay) -> None:
    out = io.StringIO()
    write_table(drive, out)
    head, *rows = out.getvalue().splitlines()
    assert re.split(r"  +", head) == ["Rule", "Activations", "Active for", "Longest", "First cause"]
    assert [row.split()[0] for row in rows] == [rule.name for rule in drive.machine.rules]
    assert re.match(r"slow_on_slope +3 +11\.3 s +5\.7 s +00:24\.7  imu\.steep: ", rows[0])
    assert rows[4].endswith("still active at the end")
    assert not re.search(r"\x1b| $", out.getvalue(), re.MULTILINE)


def test_it_fits_a_terminal_of_80_columns(drive: Replay, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setenv("TERM", "xterm")
    out = Terminal()
    write_table(drive, out)
    plain = re.sub(r"\x1b\[[0-9;]*m", "", out.getvalue())
    assert max(len(line) for line in plain.splitlines()) <= 80
    for rule in drive.machine.rules:
        assert rule.name in plain
    causes = plain.split("First cause")[1].splitlines()[2:]
    assert sum(bool(line.strip()) for line in causes) == sum(
        rule.name in plain.split("First cause")[1] for rule in drive.machine.rules
    )


def test_a_rule_that_was_never_active_says_so(drive: Replay) -> None:
    quiet = Replay(drive.machine, "a", "b", "native", 0, 1, (), (), ())
    out = io.StringIO()
    write_table(quiet, out)
    assert out.getvalue().count("never") == len(drive.machine.rules)


def test_what_rules_would_have_done_stands_below() -> None:
    out = io.StringIO()
    write_table(docking(), out)
    assert out.getvalue().split("\n\n")[1].splitlines() == [
        "Rule      Action  Would do                Times  Overruled",
        "docking   creep   limit /cmd_vel              1",
        "docking   creep   publish /lamp at 2 Hz       2  1 x by touching",
        "touching  alarm   publish /lamp at 10 Hz      1",
        "touching  alarm   call /horn                  1",
        "touching  stop    block /cmd_vel              1",
    ]


def test_both_tables_fit_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "60")
    monkeypatch.setenv("TERM", "xterm")
    out = Terminal()
    write_table(docking(), out)
    plain = re.sub(r"\x1b\[[0-9;]*m", "", out.getvalue())
    assert max(len(line) for line in plain.splitlines()) <= 60
    assert "1 x by" in plain
