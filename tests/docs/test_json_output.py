"""Commands with `--format json` print one JSON object that the documented schema describes."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import jsonschema
import pytest
import typer

import crosscheck.cli.main
import ezskiros.cli.main
import rossmarie.cli.main
from support.command_line import run
from support.parts import PROVER, needs

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"
SCHEMA = json.loads((ROOT / "docs" / "reference" / "json-output.schema.json").read_text())
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)
APPS = {
    "crosscheck": crosscheck.cli.main.app,
    "ezskiros": ezskiros.cli.main.app,
    "rossmarie": rossmarie.cli.main.app,
}
OTHERS = {("rossmarie", "dump"), ("crosscheck", "live")}
"""Commands whose JSON is a document of its own, or a stream of lines."""
RULES = """action stop;
input on = topic /on : std_msgs/Bool timeout 1 sec
rule it: if on then { stop; };
"""
WHITEBOARD = str(EXAMPLES / "whiteboard" / "whiteboard.ross")
WELL = [
    "rossmarie check rules.ross",
    "rossmarie coverage rules.ross drive.csv",
    "rossmarie failures rules.ross",
    "rossmarie graph rules.ross",
    "rossmarie replay rules.ross drive.csv --out seen",
    "rossmarie replay rules.ross drive.csv again.csv --out seen",
    "rossmarie test rules.ross",
    "ezskiros check skills",
    "ezskiros migrate skills",
    f"crosscheck check {WHITEBOARD}",
    f"crosscheck impact Wipe {WHITEBOARD}",
    f"crosscheck show {WHITEBOARD}",
]
WRONG = [
    ("rossmarie check none.ross", 2),
    ("rossmarie check wrong.ross", 1),
    ("rossmarie coverage wrong.ross drive.csv", 1),
    ("rossmarie failures wrong.ross", 1),
    ("rossmarie graph rules.ross --out other.ross", 2),
    ("rossmarie replay rules.ross none.csv", 2),
    ("rossmarie replay rules.ross drive.csv none.csv", 2),
    ("rossmarie replay rules.ross drive.csv --topic-map nonsense", 2),
    ("rossmarie test rules.ross nosuch", 2),
    ("rossmarie test wrong.ross", 1),
    ("rossmarie verify wrong.ross", 1),
    ("ezskiros check none.py", 2),
    ("ezskiros migrate skills --write --diff", 2),
    ("ezskiros learn none.jsonl", 2),
    ("crosscheck check none.ross", 2),
    ("crosscheck impact Wipee " + WHITEBOARD, 2),
    ("crosscheck show none.ross", 2),
]


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with rules, tests of rules, recordings and skills."""
    folder = tmp_path_factory.mktemp("lab")
    shutil.copytree(EXAMPLES / "pick_place", folder, dirs_exist_ok=True)
    (folder / "rules.ross").write_text(RULES)
    (folder / "wrong.ross").write_text("if undeclared then { stop; };\n")
    for name in ("drive.csv", "again.csv"):
        (folder / name).write_text("time,on\n0.0,0\n1.0,1\n2.5,0\n3.0,0\n")
    assert run("rossmarie", "test", "rules.ross", "--write", folder=folder).returncode == 0
    return folder


def answer_of(command: str, folder: Path) -> tuple[int, dict[str, Any]]:
    """The exit code, and the answer, which the schema describes."""
    done = run(*command.split(), "--format", "json", folder=folder)
    answer = json.loads(done.stdout)
    VALIDATOR.validate(answer)
    assert answer["command"] == " ".join(command.split()[:2])
    assert (answer["error"] is None) == (": " not in done.stderr or "of 2:" in done.stderr)
    return done.returncode, answer


@pytest.mark.parametrize("command", WELL)
def test_an_answer_is_as_the_schema_says(command: str, lab: Path) -> None:
    code, answer = answer_of(command, lab)
    assert code == (1 if answer["summary"]["errors"] else 0)
    assert answer["error"] is None
    assert (answer["result"] is None) == (command.split()[1] == "check")


@pytest.mark.parametrize(("command", "code"), WRONG)
def test_an_error_is_an_answer_as_well(command: str, code: int, lab: Path) -> None:
    found, answer = answer_of(command, lab)
    assert found == code
    assert answer["error"] or answer["summary"]["errors"]


@needs(PROVER)
def test_proofs_are_an_answer(lab: Path) -> None:
    code, answer = answer_of("rossmarie verify rules.ross --out proofs.json", lab)
    assert code == 0
    assert answer["result"] == json.loads((lab / "proofs.json").read_text())


def test_each_command_with_this_format_is_tried() -> None:
    known = {
        (program, name)
        for program, app in APPS.items()
        for name, command in typer.main.get_command(app).commands.items()  # type: ignore[attr-defined]
        for option in command.params
        if "--format" in option.opts and "json" in completions(program, name)
    }
    tried = [*WELL, *(command for command, _ in WRONG)]
    assert known - OTHERS == {tuple(command.split()[:2]) for command in tried}


def completions(program: str, command: str) -> list[str]:
    """The formats that a shell completes."""
    line = f"{program} {command} --format "
    variables = {f"_{program.upper()}_COMPLETE": "complete_bash"}
    variables |= {"COMP_WORDS": line, "COMP_CWORD": "3"}
    return run(program, variables=variables).stdout.split()


def test_the_schema_refuses_other_answers() -> None:
    VALIDATOR.check_schema(SCHEMA)
    answer = {"version": 1, "command": "rossmarie failures", "diagnostics": [], "error": None}
    counts = dict.fromkeys(("errors", "warnings", "notes", "files"), 0)
    assert VALIDATOR.is_valid({**answer, "summary": counts, "result": {"inputs": []}})
    assert not VALIDATOR.is_valid({**answer, "summary": counts, "result": {}})
    assert not VALIDATOR.is_valid({**answer, "summary": {}, "result": None})
    assert not VALIDATOR.is_valid({**answer, "summary": counts, "result": None, "version": 2})
