"""`ezskiros learn` with real runs: skills run, their recordings are replayed, and what is learnt
changes the next check and the next plan.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from ezskiros.ontology.load import VARIABLE
from support import command_line
from support.learning import RAMP, header, put_depot, refill, write

GOAL = "(depot:Charged porter true)"
SCENE = ("--scene", "depot.turtle")
ONTOLOGY = {VARIABLE: "depot.ttl"}
STATIONS = ("on the ramp", "behind the shelves", "on the ramp")


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder in which a robot has charged some times, with all that is known of it."""
    folder = tmp_path_factory.mktemp("runs")
    put_depot(folder)
    for number, station in enumerate(STATIONS, 1):
        ran = command_line.run(
            "ezskiros",
            *("run", "Refill", "charging.py", *SCENE, "Robot=porter", f"Station={station}"),
            *("--trace", f"trace_{number}.jsonl", "--period", "0.01"),
            folder=folder,
            variables=ONTOLOGY,
        )
        assert ran.returncode == 0, ran.stdout + ran.stderr
        out = ("--out", f"out_{number}")
        replayed = command_line.run(
            "rossmarie", "replay", "swaying.ross", f"run_{number}.csv", *out, folder=folder
        )
        assert replayed.returncode == 0, replayed.stdout
    return folder


def asked(folder: Path, *arguments: str) -> str:
    """The output of a command that succeeds."""
    done = command_line.run("ezskiros", *arguments, folder=folder, variables=ONTOLOGY)
    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    return done.stdout


@pytest.fixture(scope="module")
def said(runs: Path) -> str:
    """The report on the runs; the lessons are in `knowledge.json`."""
    files = sorted(each.relative_to(runs).as_posix() for each in runs.rglob("*.jsonl"))
    assert len(files) == 2 * len(STATIONS)
    return asked(runs, "learn", *files, *SCENE, "-o", "knowledge.json")


def found(runs: Path) -> dict[str, Any]:
    knowledge: dict[str, Any] = json.loads((runs / "knowledge.json").read_text("utf-8"))
    return knowledge


def test_the_report_tells_where_the_rule_became_active(said: str) -> None:
    rows = [" ".join(each.split()) for each in said.splitlines()]
    assert rows[0] == "3 runs"
    assert any(each.startswith("tilting Drive Refill 2 of 3 runs 2 ") for each in rows), said
    places = "Start = skiros:Location-2, Target = depot:Station-3"
    assert f"{places} 2 of 2 runs" in rows
    assert "failed" not in said


def test_what_is_written_is_what_happened(runs: Path, said: str) -> None:
    """The ramp tilts the robot for five ticks of 10 ms each, at the least."""
    knowledge = found(runs)
    (trip,) = knowledge["trips"]
    assert (trip["skill"], trip["runs"], trip["all_runs"]) == ("Drive", 2, 3)
    assert 0.1 <= trip["lost_s"] < 100
    costly = {each["skill"] for each in knowledge["costs"] if each["lost_s"] > 0}
    assert costly == {"Drive", "Refill"}


def test_the_same_is_printed_as_json(runs: Path, said: str) -> None:
    files = sorted(each.relative_to(runs).as_posix() for each in runs.rglob("*.jsonl"))
    printed = asked(runs, "learn", *files, *SCENE, "--format", "json")
    assert json.loads(printed)["result"] == found(runs)


def test_the_next_check_tells_it_at_the_skill(runs: Path, said: str) -> None:
    text = asked(runs, "check", "charging.py", "--knowledge", "knowledge.json")
    assert "warning[EZS870]: `tilting` became active during `Drive` in 2 of 3 runs" in text
    assert "--> charging.py:13:7" in text
    assert "= note: with Start = skiros:Location-2, Target = depot:Station-3 in 2 of 2 runs" in text
    assert "= note: its description has no hold-condition" in text
    assert "EZS870" not in asked(runs, "check", "charging.py")


def test_the_next_plan_avoids_the_costs(runs: Path, said: str) -> None:
    """Without what was learnt both stations are as good, and the first is taken."""
    plan = ("plan", "charging.py", *SCENE, "--goal", GOAL)
    assert "depot:Station-3" in asked(runs, *plan)
    text = asked(runs, *plan, "--knowledge", "knowledge.json")
    assert "depot:Station-4" in text
    assert "depot:Station-3" not in text
    assert text.endswith("expected to lose 0.0 s to rules, after 3 runs\n")


def learn(folder: Path, *arguments: str | Path) -> tuple[int, str, str]:
    done = command_line.run("ezskiros", "learn", *arguments, folder=folder)
    return done.returncode, done.stdout, done.stderr


def pair(folder: Path) -> tuple[Path, Path]:
    return (
        write(folder / "trace.jsonl", refill(0, RAMP)),
        write(folder / "verdicts.jsonl", [header(-1, 11)]),
    )


def test_runs_in_which_nothing_happened_say_so(tmp_path: Path) -> None:
    code, out, _ = learn(tmp_path, *pair(tmp_path))
    assert code == 0
    assert out == "1 run: no rule became active while skills ran, and no skill failed\n"


def test_records_are_not_overwritten(tmp_path: Path) -> None:
    trace, verdicts = pair(tmp_path)
    before = trace.read_bytes()
    code, _, said = learn(tmp_path, verdicts, "-o", trace)
    assert (code, trace.read_bytes()) == (2, before)
    assert "does not end in .json" in said


@pytest.mark.parametrize("name", ["missing.jsonl", "."])
def test_a_file_that_cannot_be_read_is_reported(name: str, tmp_path: Path) -> None:
    code, _, said = learn(tmp_path, *pair(tmp_path), name)
    assert code == 2
    assert said.startswith(f"ezskiros: cannot read {name}: ")


def test_a_scene_that_is_not_there_is_reported(tmp_path: Path) -> None:
    code, out, _ = learn(tmp_path, *pair(tmp_path), "--scene", "missing.turtle")
    assert code == 2
    assert "error[EZS001]" in out


def test_texts_of_records_do_nothing_to_a_terminal(tmp_path: Path) -> None:
    trace = refill(0, RAMP)
    for each in trace:
        each["skill"] = "[red]\x1b[2J" + each["skill"]
        each["event"] = each["event"].replace("succeeded", "failed")
    files = (write(tmp_path / "a.jsonl", trace), write(tmp_path / "b.jsonl", [header(-1, 11)]))
    code, out, _ = learn(tmp_path, *files)
    assert code == 0
    assert "[red]" in out
    assert "\x1b" not in out


@pytest.mark.parametrize("command", ["check", "plan"])
def test_knowledge_that_cannot_be_read_is_reported(command: str, tmp_path: Path) -> None:
    put_depot(tmp_path)
    more = (*SCENE, "--goal", GOAL) if command == "plan" else ()
    done = command_line.run(
        "ezskiros",
        *(command, "charging.py", *more, "--knowledge", "missing.json"),
        folder=tmp_path,
        variables=ONTOLOGY,
    )
    assert done.returncode == 2
    assert done.stderr == "ezskiros: cannot read missing.json: no such file or directory\n"
    (tmp_path / "missing.json").write_text("{}", encoding="utf-8")
    done = command_line.run(
        "ezskiros",
        *(command, "charging.py", *more, "--knowledge", "missing.json"),
        folder=tmp_path,
        variables=ONTOLOGY,
    )
    assert (done.returncode, done.stderr) == (1, "")
    assert "error[EZS869]" in done.stdout
