"""Replays of many recordings at the same time: reported in their order, and none keeps the
others.
"""

from __future__ import annotations

import json
import os
import pty
import re
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest
import typer

from dslkit.campaign import Campaign, FailedEpisode
from dslkit.ending import INTERNAL_ERROR
from dslkit.options import ReportFormat
from rossmarie.cli import replays
from support import command_line
from support.recordings import ROS1, readings, write_ros1

MAIN = [sys.executable, "-c", "from rossmarie.cli.main import main; main()"]
RULES = """action stop;
input on = topic /on : std_msgs/Bool timeout 2 sec;
rule it: if on then { stop; };
"""


def replay(rules: Path, *arguments: str | Path, folder: Path) -> subprocess.CompletedProcess[str]:
    return command_line.run("rossmarie", "replay", rules, *arguments, folder=folder)


@pytest.fixture
def drives(tmp_path: Path) -> Path:
    """A folder with rules, `whole.bag`, the first half of it in `half.bag`, and no recording in
    `broken.bag`.
    """
    (tmp_path / "rules.ross").write_text(
        "action stop;\ninput volts = topic /battery : std_msgs/Float32 .data timeout 1 sec;\n"
        "rule high: if volts > 20 then { stop; };\n"
    )
    written = write_ros1(tmp_path / "whole.bag", readings(ROS1, 800)).read_bytes()
    (tmp_path / "half.bag").write_bytes(written[: len(written) // 2])
    (tmp_path / "broken.bag").write_text("broken")
    return tmp_path


@pytest.fixture
def switches(tmp_path: Path) -> Path:
    """A folder with rules, and with recordings in which a switch is on so often."""
    (tmp_path / "rules.ross").write_text(RULES)
    for number in range(4):
        rows = "".join(f"{second},{int(second < 2 * number)}\n" for second in range(10))
        path = tmp_path / f"drive{number}.csv"
        path.write_text("time,on\n" + rows)
    return tmp_path


def test_each_is_reported_as_if_it_were_alone_in_the_order_in_which_they_were_given(
    drives: Path,
) -> None:
    rules, names = drives / "rules.ross", ["half.bag", "broken.bag", "whole.bag"]
    alone = {name: replay(rules, name, folder=drives) for name in names}
    together = replay(rules, *names, folder=drives)
    *sections, totals = together.stdout.split("\n\n")
    reported = "\n\n".join(sections)
    assert reported == "\n\n".join(f"{name}:\n{alone[name].stdout.rstrip()}" for name in names)
    assert re.fullmatch(r"2 of 3 recordings replayed, 2 min \d+ s: 2 activations\n", totals)
    assert alone["broken.bag"].returncode == 1
    assert together.returncode == 1
    lines = together.stderr.splitlines()
    assert [line[:6] for line in lines] == ["1 of 3", "2 of 3", "3 of 3"]
    assert sorted(line.split(": ")[1] for line in lines) == sorted(names)
    assert "broken.bag: cannot be used" in together.stderr


def test_reports_come_into_a_folder_for_each(switches: Path) -> None:
    shutil.copytree(switches, switches / "again")
    given = ["drive1.csv", "drive2.csv", "again/drive1.csv", "drive1.csv"]
    done = replay(switches / "rules.ross", *given, "--out", "out", folder=switches)
    assert (done.returncode, done.stdout.count("wrote")) == (0, 3), "one was given twice"
    folders = sorted(path.name for path in (switches / "out").iterdir())
    assert folders == ["drive1.csv", "drive1.csv-2", "drive2.csv"]
    header = (switches / "out/drive1.csv-2/verdicts.jsonl").read_text().splitlines()[0]
    assert json.loads(header)["recording"] == "again/drive1.csv"
    assert (switches / "out/drive2.csv/timeline.html").is_file()


def test_a_recording_that_cannot_be_read_decides_on_the_exit_code(switches: Path) -> None:
    done = replay(switches / "rules.ross", "none.bag", "drive1.csv", folder=switches)
    assert done.returncode == 2
    assert "error[ROSS610]" in done.stdout
    assert done.stdout.endswith("1 of 2 recordings replayed, 9.0 s: 1 activation\n")


def test_nothing_is_written_where_one_report_cannot_be(switches: Path) -> None:
    (switches / "out").mkdir()
    (switches / "out/drive1.csv").write_text("in the way")
    given = ["drive1.csv", "drive2.csv", "--out", "out"]
    done = replay(switches / "rules.ross", *given, folder=switches)
    assert done.returncode == 2
    assert "cannot write to out/drive1.csv" in done.stderr
    assert "is not a folder" in done.stderr
    assert [each.name for each in (switches / "out").iterdir()] == ["drive1.csv"]


def test_findings_about_the_rules_are_reported_once(switches: Path) -> None:
    rules = switches / "rules.ross"
    rules.write_text(RULES + "action nobody;\n")
    done = replay(rules, "drive1.csv", "drive2.csv", folder=switches)
    assert done.returncode == 0
    assert done.stdout.count("warning[") == 1
    rules.write_text(RULES.replace("on then", "off then"))
    done = replay(rules, "drive1.csv", "drive2.csv", folder=switches)
    assert (done.returncode, done.stdout.count("error[")) == (1, 1)
    assert done.stderr == ""


def test_bags_and_tables_go_together(switches: Path) -> None:
    write_ros1(switches / "drive.bag", readings(ROS1))
    done = replay(switches / "rules.ross", "drive.bag", "drive1.csv", folder=switches)
    assert "drive.bag:\n" in done.stdout
    assert "drive1.csv:\nRule" in done.stdout


def test_on_a_terminal_tables_are_fitted_to_it(switches: Path) -> None:
    ours, theirs = pty.openpty()
    command: list[str | Path] = [
        *MAIN,
        "replay",
        switches / "rules.ross",
        "drive1.csv",
        "drive2.csv",
    ]
    environment = {**os.environ, "TERM": "xterm", "COLUMNS": "70"}
    with subprocess.Popen(
        command, cwd=switches, stdout=theirs, stderr=subprocess.PIPE, env=environment
    ):
        os.close(theirs)
        shown = b""
        try:
            while piece := os.read(ours, 4096):
                shown += piece
        except OSError:  # how Linux tells the end
            pass
    os.close(ours)
    lines = re.sub(r"\x1b\[[\d;]*m", "", shown.decode()).splitlines()
    assert "\x1b[" in shown.decode()
    assert max(map(len, lines)) <= 70
    assert lines[-1].startswith("2 of 2 recordings replayed")


def test_who_interrupts_it_gets_one_line(switches: Path) -> None:
    rows = "".join(f"{step / 100},{step % 2}\n" for step in range(20_000))
    given = [f"long{number}.csv" for number in range(20)]
    for name in given:
        (switches / name).write_text("time,on\n" + rows)
    with subprocess.Popen(
        [*MAIN, "replay", switches / "rules.ross", *given], cwd=switches, start_new_session=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    ) as running:  # fmt: skip
        assert running.stderr is not None
        assert running.stderr.readline().startswith("1 of 20")
        os.killpg(running.pid, signal.SIGINT)
        reported, complaints = running.communicate(timeout=command_line.TIME_LIMIT_S)
    assert (running.returncode, reported) == (130, "")
    assert complaints.splitlines()[-1] == "rossmarie: interrupted"
    assert "Traceback" not in complaints


def test_a_replay_that_does_not_come_to_its_end_is_a_defect(
    switches: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    reason = "its process ended with exit code -9"
    ended = Campaign({}, (FailedEpisode("a.bag", reason), FailedEpisode("b.bag", reason)))
    monkeypatch.setattr(replays, "_campaign", lambda *_: ended)
    with pytest.raises(typer.Exit) as found:
        replays.run_replays(
            switches / "rules.ross",
            [Path("a.bag"), Path("b.bag")],
            [],
            None,
            ReportFormat.TEXT,
            [],
            [],
            [],
        )
    assert found.value.exit_code == INTERNAL_ERROR
    assert capsys.readouterr().out.startswith(f"a.bag:\nnot finished: {reason}\n\nb.bag:\n")
