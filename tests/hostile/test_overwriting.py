"""No command replaces a file that its program did not write, unless its user gives `--force`."""

from __future__ import annotations

import shlex
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
import typer

import crosscheck.cli.main
import ezskiros.cli.main
import heron.cli.main
import rossmarie.cli.main
from support.command_line import run
from support.robots import put_example

PICK_PLACE = Path(__file__).parents[2] / "examples" / "pick_place"
MINE = "# A source of the user.\nimport os\n"
RULES = """action stop;
input on = topic /on : std_msgs/Bool timeout 1 sec
rule it: if on then { stop; };
"""
APPS = {
    "crosscheck": crosscheck.cli.main.app,
    "ezskiros": ezskiros.cli.main.app,
    "heron": heron.cli.main.app,
    "rossmarie": rossmarie.cli.main.app,
}
READ = {
    *("rules", "files", "paths", "recordings", "recording", "system", "messages", "ontology"),
    *("scene", "values", "knowledge", "verification", "policy", "learned", "context", "guards"),
    "compare",
}
"""The names of arguments and options with files that commands read."""
ELSEWHERE = {
    ("ezskiros", "check", "rules"),
    # A study log is appended to, and a file of another kind is refused: the tests of study logs.
    *((program, "check", "study") for program in ("crosscheck", "ezskiros", "rossmarie")),
    ("rossmarie", "report", "coverage"),
    ("rossmarie", "verify", "keep"),  # the names are those of the queries: the prover's tests
}


@dataclass(frozen=True)
class Writer:
    """A use of a command that writes `file`; `option` names the parameter that leads there."""

    program: str
    command: str
    option: str
    file: str
    is_quick: bool = True

    def __str__(self) -> str:
        return f"{self.program} {self.command}"


def _heron(command: str, option: str, file: str) -> Writer:
    return Writer("heron", command, option, file, is_quick=False)


PLAN = "plan skills --scene lab.turtle --goal '(skiros:contain shelf starter)' --out mine.py"
PICK = "run pick skills --scene lab.turtle --simulate Object=cable Gripper=gripper"
EPISODES = ["nav", "place", "human", "contact", "corridor", "blocked", "second", "insertion"]
WRITERS = [
    *(
        Writer("crosscheck", f"show whiteboard.ross --format {form} --out {file}", "out", file)
        for form, file in (("svg", "mine.svg"), ("json", "mine.json"), ("text", "mine.py"))
    ),
    Writer("crosscheck", "weave whiteboard.ross --out mine.json", "out", "mine.json"),
    Writer("ezskiros", "example pick_place .", "folder", "lab.turtle", is_quick=False),
    Writer("ezskiros", "export skills --out mine.json", "out", "mine.json"),
    Writer("ezskiros", "learn verdicts.jsonl --out mine.json", "out", "mine.json", is_quick=False),
    Writer("ezskiros", "owl --ontology ontology --out .", "out", "ezskiros-sumo.owl"),
    Writer("ezskiros", PLAN, "out", "mine.py", is_quick=False),
    Writer("ezskiros", f"{PICK} --out mine.turtle", "out", "mine.turtle"),
    Writer("ezskiros", f"{PICK} --trace world.py", "trace", "world.py"),
    *(
        Writer("ezskiros", f"show pick_and_place skills --format {form} --out {file}", "out", file)
        for form, file in (("svg", "mine.svg"), ("btcpp", "mine.xml"), ("text", "mine.py"))
    ),
    Writer("ezskiros", "stubs --ontology ontology --out world.py", "out", "world.py"),
    *(
        _heron(f"run {name} --film a.gif" + " --policy p" * (name == "insertion"), "film", "a.gif")
        for name in EPISODES
    ),
    _heron("record nav --out mine.mcap", "out", "mine.mcap"),
    _heron("record nav --out new.mcap --trace mine.jsonl", "trace", "mine.jsonl"),
    _heron("evaluate --out .", "out", "experiments.md"),
    _heron("evaluate --out .", "out", "experiments/nav.csv"),
    _heron("learn moves --out .", "out", "learning.md"),
    _heron("learn moves --film mine.gif", "film", "mine.gif"),
    _heron("demo --out mine.html", "out", "mine.html"),
    _heron("gallery --out .", "out", "gallery.md"),
    _heron("gallery --out .", "out", "gallery/nav-gentle.webp"),
    Writer("rossmarie", "build drive.ross --out .", "out", "drive_monitor.c"),
    Writer("rossmarie", "build drive.ross --out out --sources mine.txt", "sources", "mine.txt"),
    Writer("rossmarie", "build drive.ross --out out --review a.html", "review", "a.html"),
    Writer(
        "rossmarie",
        "check drive.ross --thorough --witnesses .",
        "witnesses",
        "drive_ROSS708_1.csv",
    ),
    Writer("rossmarie", "check drive.ross --thorough --witnesses a.ross", "witnesses", "a.ross"),
    Writer("rossmarie", "coverage drive.ross drive.csv --out mine.json", "out", "mine.json"),
    Writer("rossmarie", "example husky .", "folder", "husky.ross", is_quick=False),
    Writer("rossmarie", "export drive.ross --out mine.json", "out", "mine.json"),
    Writer("rossmarie", "graph drive.ross --format svg --out mine.svg", "out", "mine.svg"),
    Writer("rossmarie", "graph drive.ross --format dot --out mine.dot", "out", "mine.dot"),
    Writer("rossmarie", "graph drive.ross --out mine.txt", "out", "mine.txt"),
    Writer("rossmarie", "graph drive.ross --format json --out mine.json", "out", "mine.json"),
    Writer("rossmarie", "init drive.mcap --out .", "out", "robot.ross", is_quick=False),
    Writer("rossmarie", "model drive.mcap --out a.ross", "out", "a.ross", is_quick=False),
    Writer("rossmarie", "replay drive.ross drive.csv --out .", "out", "timeline.html"),
    Writer("rossmarie", "replay drive.ross drive.csv --out .", "out", "verdicts.jsonl"),
    Writer("rossmarie", "report drive.ross --out mine.html", "out", "mine.html"),
    Writer("rossmarie", "test drive.ross --junit mine.xml", "junit", "mine.xml"),
    Writer("rossmarie", "test drive.ross --write", "write", "drive.tests.ross"),
    Writer("rossmarie", "verify drive.ross --out mine.json", "out", "mine.json", is_quick=False),
]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder in which each of the commands works."""
    shutil.copytree(PICK_PLACE, tmp_path / "lab")
    found = tmp_path / "lab"
    (found / "drive.ross").write_text(RULES)
    (found / "drive.csv").write_text("time,on\n0.0,0\n1.0,1\n2.5,0\n3.0,0\n")
    (found / "gallery").mkdir()
    (found / "experiments").mkdir()
    return found


def _contents(folder: Path) -> dict[Path, bytes]:
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def _call(writer: Writer, folder: Path, *more: str) -> Any:
    return run(writer.program, *shlex.split(writer.command), *more, folder=folder)


@pytest.mark.parametrize("writer", WRITERS, ids=str)
def test_a_file_of_a_user_stays(writer: Writer, folder: Path) -> None:
    if writer.program == "crosscheck":
        folder = put_example(folder / "board")
    (folder / writer.file).write_text(MINE)
    before = _contents(folder)
    done = _call(writer, folder)
    told = done.stdout + done.stderr
    assert _contents(folder) == before, told
    assert done.returncode == 2, told
    assert writer.file in done.stderr
    assert "--force" in done.stderr


@pytest.mark.parametrize("writer", [each for each in WRITERS if each.is_quick], ids=str)
def test_with_force_it_is_replaced_and_then_it_is_the_program_s(
    writer: Writer, folder: Path
) -> None:
    if writer.program == "crosscheck":
        folder = put_example(folder / "board")
    (folder / writer.file).write_text(MINE)
    first = _call(writer, folder, "--force")
    assert first.returncode in (0, 1), first.stderr
    assert (folder / writer.file).read_text() != MINE
    again = _call(writer, folder)
    assert (again.returncode, again.stderr) == (first.returncode, first.stderr), again.stderr


@pytest.mark.parametrize("program", APPS)
def test_each_file_that_commands_take_is_read_or_is_among_those(program: str) -> None:
    known = {
        (writer.program, writer.command.partition(" --")[0], writer.option) for writer in WRITERS
    }
    for words, command in _commands(typer.main.get_command(APPS[program]), ()):
        for parameter in command.params:
            if not _takes_a_path(parameter) or parameter.name in READ:
                continue
            place = (program, words[0], parameter.name)
            used = {(each, command.split()[0], option) for each, command, option in known}
            assert place in used | ELSEWHERE, f"add it to WRITERS or READ: {place}"
            if place in used:
                assert "--force" in {name for each in command.params for name in each.opts}


def _commands(command: Any, words: tuple[str, ...]) -> Any:
    """Every command with its words."""
    if not hasattr(command, "commands"):
        yield words, command
        return
    for name, each in command.commands.items():
        yield from _commands(each, (*words, name))


def _takes_a_path(parameter: Any) -> bool:
    return "Path" in str(parameter.type_descriptor.annotation)
