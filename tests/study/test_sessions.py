"""Sessions: their folders, and the log of the progress."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
from study_kit.cli import ConditionName, app
from study_kit.faults import CONDITIONS
from study_kit.sessions import PROGRESS, SessionError, prepare, read_progress, session_of, watch
from typer.testing import CliRunner

WRONG, RIGHT = "if drive.overspeeed then", "if drive.overspeed then"


def test_a_repair_is_seen_while_the_participant_works(tmp_path: Path) -> None:
    session = prepare("P01", CONDITIONS["rossmarie"], tmp_path)
    started = threading.Event()

    def tell(line: Mapping[str, Any]) -> None:
        started.set()

    def work() -> None:
        started.wait()
        text = session.file.read_text(encoding="utf-8")
        session.file.write_text(text.replace(WRONG, RIGHT), encoding="utf-8")

    participant = threading.Thread(target=work)
    participant.start()
    watch(session, 1.0, tell, period=0.05)
    participant.join()
    lines = read_progress(session.folder / PROGRESS)
    assert [each["event"] for each in lines] == ["start", "change", "end"]
    states = [each["faults"]["misspelt-name"] for each in lines]
    assert states == ["kept", "fixed", "fixed"]
    assert "overspeed" not in (session.folder / PROGRESS).read_text(encoding="utf-8")


def test_the_folder_of_a_session_is_found_again(tmp_path: Path) -> None:
    made = prepare("P02", CONDITIONS["ezskiros"], tmp_path)
    assert session_of(made.folder) == made
    assert {each.name for each in (made.folder / "work").iterdir()} == {
        *("TASK.md", "deliver.py", "ontology", "world.py", "world.pyi"),
    }


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["prepare", "P 1", "cpp"], "study: `P 1` is no pseudonym"),
        (["watch", "."], "study: . is no session"),
        (["analyse", "."], "study: . has no sessions"),
        (["simulate", "."], "study: . exists already"),
    ],
)
def test_a_mistake_of_the_leader_is_told_in_one_line(
    words: list[str], reason: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    done = CliRunner().invoke(app, words)
    assert done.exit_code == 2
    assert done.output.startswith(reason)
    assert done.output.count("\n") == 1


def test_a_session_is_not_prepared_twice(tmp_path: Path) -> None:
    prepare("P01", CONDITIONS["cpp"], tmp_path)
    with pytest.raises(SessionError, match="exists already"):
        prepare("P01", CONDITIONS["cpp"], tmp_path)


def test_a_wrong_line_has_its_place(tmp_path: Path) -> None:
    (tmp_path / PROGRESS).write_text('{"format": "else"}\n')
    with pytest.raises(SessionError, match=f"{PROGRESS}:1:1: this line is not of a progress log"):
        read_progress(tmp_path / PROGRESS)


def test_the_command_line_knows_all_conditions() -> None:
    assert [each.value for each in ConditionName] == list(CONDITIONS)
