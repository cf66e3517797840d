"""A campaign loses nothing and counts nothing twice, whatever happens to its episodes."""

from __future__ import annotations

import io
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import pytest
from rich.console import Console

from dslkit.campaign import Bar, BusyError, Campaign, ForeignError, Journal, Processes, run
from support import campaigns
from support.campaigns import SlowToArrive, work

SLOW = [f"slow:{number}" for number in range(30)]


def campaign(path: Path, keys: Sequence[str], limit_s: float = 60.0) -> tuple[Campaign, str]:
    """A campaign of these keys, and what was shown of it."""
    shown = io.StringIO()
    with Journal(path, "test") as journal, Bar(Console(file=shown, width=120), "test") as bar:
        return run(keys, work, journal, Processes(2, limit_s), bar), shown.getvalue()


def keys_in(path: Path) -> list[str]:
    """Those of all whole lines, as somebody else reads them."""
    lines = path.read_text(encoding="utf-8").split("\n")[1:-1]
    return [json.loads(line)["key"] for line in lines]


def test_rows_come_in_the_order_of_the_keys(tmp_path: Path) -> None:
    found, _ = campaign(tmp_path / "new" / "journal.jsonl", ["slow:b", "a:", "c:", "a:"])
    assert list(found.values) == ["slow:b", "a:", "c:"]
    assert found.values["a:"] == {"key_was": "a:", "number": 2}
    assert found.failures == ()


def test_an_episode_that_fails_is_reported_and_the_rest_goes_on(tmp_path: Path) -> None:
    keys = ["a:", "raise:it broke", "die:", "hang:", "b:", "c:"]
    found, shown = campaign(tmp_path / "journal.jsonl", keys, limit_s=4.0)
    assert list(found.values) == ["a:", "b:", "c:"]
    reasons = {failure.key: failure.reason for failure in found.failures}
    assert reasons["raise:it broke"] == "ValueError: it broke"
    assert "exit code" in reasons["die:"]
    assert reasons["hang:"] == "took longer than 4 s"
    assert "die: failed: its process ended" in shown
    assert sorted(keys_in(tmp_path / "journal.jsonl")) == ["a:", "b:", "c:"]


def test_a_worker_never_hears_of_an_interruption_not_even_while_it_starts(tmp_path: Path) -> None:
    before = signal.pthread_sigmask(signal.SIG_BLOCK, ())
    found, _ = campaign(tmp_path / "journal.jsonl", ["blocked:a", "die:", "blocked:b"])
    assert list(found.values.values()) == [{"is": True}] * 2, "the one that is started later, too"
    assert signal.pthread_sigmask(signal.SIG_BLOCK, ()) == before


def test_what_is_done_is_not_done_again(tmp_path: Path) -> None:
    path = tmp_path / "journal.jsonl"
    campaign(path, ["a:", "b:"])
    lines = path.read_text(encoding="utf-8").replace('"number": 2', '"number": 7')
    path.write_text(lines, encoding="utf-8")
    found, shown = campaign(path, ["a:", "b:", "c:"])
    assert [row["number"] for row in found.values.values()] == [7, 7, 2]
    assert "2 of 3 are already done" in shown


def started(path: Path, *keys: str) -> subprocess.Popen[str]:
    """A campaign in a process group of its own, with its first results."""
    environment = {**os.environ, "PYTHONPATH": str(Path(campaigns.__file__).parents[1])}
    running = subprocess.Popen(
        [sys.executable, campaigns.__file__, path, *keys], env=environment, start_new_session=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    until = time.monotonic() + 60
    while not path.exists() or len(path.read_text(encoding="utf-8").splitlines()) < 4:
        assert time.monotonic() < until
        time.sleep(0.05)
    return running


def all_have_ended(group: int) -> bool:
    """Say whether all processes of a group end soon. They close their output before they end."""
    until = time.monotonic() + 20
    while processes_of(group) and time.monotonic() < until:
        time.sleep(0.05)
    return not processes_of(group)


def processes_of(group: int) -> list[str]:
    """The processes of a group that are still there; those that have ended do not count."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            state, _, its_group = stat.read_text().rpartition(")")[2].split()[:3]
        except OSError:
            continue
        if int(its_group) == group and state != "Z":
            found.append(stat.parent.name)
    return found


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGKILL])
def test_a_campaign_that_was_ended_goes_on(tmp_path: Path, how: signal.Signals) -> None:
    path = tmp_path / "journal.jsonl"
    running = started(path)
    os.killpg(running.pid, how)
    _, complaints = running.communicate(timeout=30)
    if how is signal.SIGINT:
        assert complaints.strip().endswith("KeyboardInterrupt")
        assert complaints.count("Traceback") == 1, "that of the one who was interrupted"
    assert all_have_ended(running.pid)
    done = keys_in(path)
    assert 3 <= len(done) < 30
    found, shown = campaign(path, SLOW)
    assert len(found.values) == 30
    assert f"{len(done)} of 30 are already done" in shown
    assert sorted(keys_in(path)) == sorted(SLOW)


def test_episodes_end_with_the_campaign_whatever_they_do(tmp_path: Path) -> None:
    running = started(tmp_path / "journal.jsonl", "a:", "b:", "c:", "hang:")
    running.kill()
    running.communicate(timeout=30)
    assert all_have_ended(running.pid)


def test_the_time_to_start_a_process_does_not_count() -> None:
    found = Processes(2, limit_s=1.0).results(SlowToArrive(), ["a:", "b:"])
    assert [result.failure for result in found] == ["", ""]


def test_a_line_that_was_not_finished_is_dropped(tmp_path: Path) -> None:
    path = tmp_path / "journal.jsonl"
    campaign(path, ["a:"])
    with path.open("a", encoding="utf-8") as file:
        file.write('{"key": "b:", "num')
    found, _ = campaign(path, ["a:", "b:"])
    assert list(found.values) == ["a:", "b:"]
    assert keys_in(path) == ["a:", "b:"]


def test_a_result_that_comes_twice_counts_once(tmp_path: Path) -> None:
    path = tmp_path / "journal.jsonl"
    for number in (1, 2):
        with Journal(path, "test") as journal:
            journal.append("a:", {"number": number})
            assert journal.values == {"a:": {"number": 1}}
    assert keys_in(path) == ["a:"]


def test_two_runs_do_not_write_into_one_journal(tmp_path: Path) -> None:
    path = tmp_path / "journal.jsonl"
    with Journal(path, "test"), pytest.raises(BusyError, match="in use"), Journal(path, "test"):
        pass


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ('{"journal_of": "another one"}\n', "the journal of another one, not of test"),
        ("a;b;c\n", "not a campaign journal"),
        ('{"journal_of": "test"}\n[1]\n', "not a campaign journal"),
        ("[]\n", "not a campaign journal"),
        ("no end", "not a campaign journal"),
        ('{"journal_of": "test"}\n\xff\n', "not a campaign journal"),
    ],
)
def test_a_file_of_somebody_else_is_left_alone(tmp_path: Path, text: str, reason: str) -> None:
    path = tmp_path / "journal.jsonl"
    path.write_bytes(text.encode("latin-1"))
    with pytest.raises(ForeignError, match=reason), Journal(path, "test"):
        pass
    assert path.read_bytes() == text.encode("latin-1")
