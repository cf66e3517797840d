"""Commands end with the right exit code and without a traceback. The tests send signals from the
first instant on, close streams, pass streams that reject text, and block outputs.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path

import pytest

from support import command_line
from support.command_line import TIME_LIMIT_S
from support.parts import FULL_DEVICE, MOUNTS, MUJOCO, PROC, needs
from support.provers import is_running, wait_for
from support.skills import ONTOLOGY

PICK_PLACE = Path(__file__).parents[2] / "examples" / "pick_place"
PARTS = ONTOLOGY.parent / "contract_parts.py"
PROGRAMS = ("ezskiros", "heron", "rossmarie")
RULES = """action stop;
input on = topic /on : std_msgs/Bool timeout 1 sec
rule it: if on then { stop; };
"""
WRONG = RULES + "rule other: if on > 3 m then { stop; }; // h\u00e4lt an \u2192 \u00b2\n"


def path_of(program: str) -> str:
    return str(Path(sys.executable).with_name(program))


def alone(
    program: str, *words: str | Path, folder: Path, **variables: str
) -> subprocess.CompletedProcess[bytes]:
    """A run in a process of its own, for what is decided when Python starts."""
    return subprocess.run(
        [path_of(program), *map(os.fsencode, words)],
        cwd=folder,
        env={**os.environ, **variables},
        capture_output=True,
        timeout=TIME_LIMIT_S,
        check=False,
    )


# --- signals ---------------------------------------------------------------------------------

INSTANTS = (0.0, 0.02, 0.07, 0.15, 0.3, 0.6)


@contextmanager
def running(*command: str, folder: Path) -> Iterator[subprocess.Popen[str]]:
    """A command that listens to signals; before, Python itself decides what becomes of them."""
    with subprocess.Popen(
        command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as started:
        try:
            until = time.monotonic() + TIME_LIMIT_S
            while not listens(started.pid):
                assert time.monotonic() < until
                time.sleep(0.001)
            yield started
        finally:
            started.kill()


def listens(process: int) -> bool:
    """Say whether a process catches SIGTERM."""
    caught = Path(f"/proc/{process}/status").read_text().partition("SigCgt:")[2].split()[0]
    return bool(int(caught, 16) >> (signal.SIGTERM - 1) & 1)


def code_and_words(command: Sequence[str], folder: Path, number: int, after_s: float) -> object:
    with running(*command, folder=folder) as started:
        time.sleep(after_s)
        started.send_signal(number)
        _, said = started.communicate(timeout=TIME_LIMIT_S)
        return started.returncode, said


@needs(PROC)
@pytest.mark.parametrize(
    "command",
    [
        ("rossmarie", "check", "pipe.ross"),
        ("ezskiros", "check", "--watch", str(PICK_PLACE / "skills")),
        pytest.param(("heron", "run", "nav"), marks=needs(MUJOCO)),
    ],
    ids=lambda command: command[0],
)
def test_from_its_imports_on_a_signal_ends_a_command(
    command: tuple[str, ...], tmp_path: Path
) -> None:
    os.mkfifo(tmp_path / "pipe.ross")  # nobody writes to it: none of these ends by itself
    program, *words = command
    whole = (path_of(program), *words)
    with ThreadPoolExecutor(2) as threads:
        runs = {
            (number, instant): threads.submit(code_and_words, whole, tmp_path, number, instant)
            for number, instant in zip(
                (signal.SIGINT, signal.SIGINT, signal.SIGTERM) * 2, INSTANTS, strict=True
            )
        }
        found = {key: each.result() for key, each in runs.items()}
    assert found == {(number, instant): (128 + number, "") for number, instant in found}


@pytest.mark.deep  # in each run, `tests/dslkit/campaign` ends campaigns
@needs(PROC)
@needs(MUJOCO)
def test_an_evaluation_that_is_ended_says_what_is_kept_and_ends_its_workers(tmp_path: Path) -> None:
    journal = tmp_path / "experiments" / "episodes.jsonl"
    words = ("evaluate", "--experiment", "place", "--jobs", "2", "--out", ".")
    with running(path_of("heron"), *words, folder=tmp_path) as started:
        wait_for(lambda: journal.exists() and journal.read_text().count("\n") > 1, TIME_LIMIT_S)
        workers = workers_of(started.pid)
        started.send_signal(signal.SIGTERM)
        _, said = started.communicate(timeout=TIME_LIMIT_S)
    assert started.returncode == 128 + signal.SIGTERM
    assert said.splitlines()[-1] == (
        "heron: interrupted; finished work is kept; run the same command again to continue"
    )
    assert len(workers) == 2
    assert not any(map(is_running, workers))


def workers_of(process: int) -> list[int]:
    children = Path(f"/proc/{process}/task/{process}/children").read_text().split()
    named = {int(each): Path(f"/proc/{each}/cmdline").read_text() for each in children}
    return [number for number, command in named.items() if "spawn_main" in command]


# --- streams ---------------------------------------------------------------------------------

WITHOUT_UTF8 = (
    {"PYTHONIOENCODING": "ascii"},
    {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
)


@pytest.mark.parametrize("variables", WITHOUT_UTF8, ids=["asked for", "by locale"])
def test_text_that_a_terminal_cannot_show_is_written_with_its_numbers(
    variables: dict[str, str], tmp_path: Path
) -> None:
    name = os.fsdecode(b"\xfftief.ross")
    (tmp_path / name).write_text(WRONG, encoding="utf-8")
    done = alone("rossmarie", "check", name, folder=tmp_path, **variables)
    said = done.stdout.decode("ascii")
    assert (done.returncode, done.stderr) == (1, b"")
    assert r"h\xe4lt an \u2192 \xb2" in said
    assert "<U+DCFF>tief.ross:4" in said


def test_numbers_are_written_only_where_they_have_to_be(tmp_path: Path) -> None:
    (tmp_path / "rules.ross").write_text(WRONG, encoding="utf-8")
    done = alone("rossmarie", "check", "rules.ross", folder=tmp_path, PYTHONIOENCODING="latin-1")
    assert r"hält an \u2192 ²" in done.stdout.decode("latin-1")


@pytest.mark.parametrize(
    ("program", "words", "code"),
    [
        ("ezskiros", ("show", "pick_and_place", "skills"), 0),  # by Rich
        ("ezskiros", ("run", "\u00e4", "skills"), 2),
        ("heron", ("record", "fl\u00fcge", "--out", "a.mcap"), 2),
        ("rossmarie", ("--h\u00e4lp",), 2),  # by Typer
    ],
)
def test_whoever_writes_it(program: str, words: tuple[str, ...], code: int, tmp_path: Path) -> None:
    (tmp_path / "skills").symlink_to(PICK_PLACE / "skills")
    ontology = {"EZSKIROS_ONTOLOGY": str(PICK_PLACE / "ontology")}
    done = alone(program, *words, folder=tmp_path, PYTHONIOENCODING="ascii", **ontology)
    assert done.returncode == code
    said = done.stdout + done.stderr
    assert said.isascii()
    assert b"Traceback" not in said


def test_a_file_name_that_is_no_text_gets_into_what_is_written(tmp_path: Path) -> None:
    name = os.fsdecode(b"\xfe.ross")
    (tmp_path / name).write_text(RULES)
    done = command_line.run("rossmarie", "report", name, folder=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert r"\udcfe.ross" in (tmp_path / "report.html").read_text(encoding="utf-8")


def shell(text: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """The result of a shell command that can call `rossmarie` and the other programs."""
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    return subprocess.run(
        ["sh", "-c", text], cwd=folder, env={**os.environ, "PATH": path},
        capture_output=True, text=True, timeout=TIME_LIMIT_S, check=False,
    )  # fmt: skip


def test_streams_that_are_closed_are_not_mixed_up_with_files(tmp_path: Path) -> None:
    (tmp_path / "rules.ross").write_text(RULES)
    done = shell("rossmarie graph rules.ross --format svg --out a.svg <&- >&- 2>&-", tmp_path)
    assert done.returncode == 0
    assert (tmp_path / "a.svg").read_text().endswith("</svg>\n")
    (tmp_path / "drive.csv").write_text("time,on\n0.0,0\n1.0,1\n")
    done = shell("rossmarie replay rules.ross drive.csv >&-", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")


def test_nobody_reads_any_more(tmp_path: Path) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    with open(writing, "w") as closed:  # noqa: PTH123
        for words in (("explain", "ROSS301"), ("--help",)):
            done = subprocess.run(
                [path_of("rossmarie"), *words], stdout=closed, stderr=subprocess.PIPE, check=False
            )
            assert (done.returncode, done.stderr) == (128 + signal.SIGPIPE, b"")


@needs(FULL_DEVICE)
def test_neither_output_nor_complaints_can_be_written(tmp_path: Path) -> None:
    done = shell("rossmarie explain ROSS301 >/dev/full 2>/dev/full", tmp_path)
    assert done.returncode == 2


# --- folders ---------------------------------------------------------------------------------


def test_the_current_folder_is_gone(tmp_path: Path) -> None:
    done = shell("mkdir gone; cd gone; rmdir ../gone; rossmarie check rules.ross", tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "rossmarie: the current folder is gone: change to another one\n"


WRITING = {
    "rossmarie": [
        ("build", "none.ross", "--out", "file/below"),
        ("build", "none.ross", "--out", "new", "--sources", "folder"),
        ("check", "none.ross", "--witnesses", "file/below"),
        ("check", "none.ross", "--witnesses", "file/below.ross"),
        ("coverage", "none.ross", "none.csv", "--out", "folder"),
        ("graph", "none.ross", "--out", "file/below.svg"),
        ("model", "none.csv", "--out", "file/below.ross"),
        ("replay", "none.ross", "none.csv", "--out", "file"),
        ("replay", "none.ross", "none.csv", "none.bag", "--out", "file/below"),
        ("report", "none.ross", "--out", "folder"),
        ("test", "none.ross", "--junit", "file/below.xml"),
        ("test", "file/none.ross", "--write"),
        ("verify", "none.ross", "--out", "nowhere/v.json"),
        ("verify", "none.ross", "--keep", "file/below"),
    ],
    "ezskiros": [
        ("owl", "--out", "file"),
        ("plan", "none", "--goal", "(a b c)", "--scene", "none.turtle", "--out", "file/a.py"),
        ("run", "none", "none.py", "--out", "folder"),
        ("run", "none", "none.py", "--trace", "file/below"),
        ("show", "none", "none.py", "--format", "btcpp", "--out", "file/below"),
        ("show", "none", "none.py", "--format", "svg", "--out", "nowhere/a.svg"),
        ("stubs", "--out", "folder"),
    ],
    "heron": [
        ("demo", "--out", "file/below.html"),
        ("demo", "--out", "folder"),
        ("evaluate", "--out", "file/below"),
        ("gallery", "--out", "file/below"),
        ("run", "place", "--film", "file/below.gif"),
        ("record", "nav", "--out", "file/below.mcap"),
    ],
}


@pytest.mark.parametrize(
    ("program", "words"), [(program, words) for program in WRITING for words in WRITING[program]]
)
def test_outputs_are_tried_before_anything_is_read(
    program: str, words: tuple[str, ...], tmp_path: Path
) -> None:
    (tmp_path / "file").touch()
    (tmp_path / "folder").mkdir()
    done = command_line.run(program, *words, folder=tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"{program}: cannot write ")
    assert done.stderr.count("\n") == 1
    assert sorted(each.name for each in tmp_path.iterdir()) == ["file", "folder"]


@needs(MOUNTS)
def test_a_full_device_is_known_before_and_a_device_that_may_not_be_written(tmp_path: Path) -> None:
    words = "rossmarie graph none.ross --out small/a.svg"
    (tmp_path / "small").mkdir()
    full = "mount -t tmpfs -o size=4k none small; head -c 4096 /dev/zero > small/all"
    done = shell(f"{full}; {words}; ls -A small; umount small", tmp_path)
    assert done.stderr == "rossmarie: cannot write small/a.svg: no space left on device\n"
    assert done.stdout == "all\n"
    done = shell(f"mount -t tmpfs -o ro none small; {words}; umount small", tmp_path)
    assert done.stderr == "rossmarie: cannot write small/a.svg: read-only file system\n"


LONG = "# " + "long " * 2000 + "\n"
SKILLS = """\
from contract_parts import Grab, cora, rparts, skiros
from ezskiros import SkillDescription


class Fetch(SkillDescription):
    def description(self, Robot: cora.Robot, Gripper: rparts.GripperEffector,
                    Object: skiros.Product, From: skiros.Location):
        self.pre_conditions += Robot.at(From)


class fetch(Fetch.SkillBase):
    def expandBT(self, params):
        self.serialstar(Grab())
"""
OLD = """\
from skiros2_skill.core.skill import SkillDescription
from skiros2_common.core.params import ParamTypes


class Wait(SkillDescription):
    def createDescription(self):
        self.addParam("Duration", 0.0, ParamTypes.Required)
"""
REPLACED = [
    ("rossmarie", ("fmt", "FILE"), LONG.replace("#", "//") + "action   stop;\n"),
    ("ezskiros", ("migrate", "--write", "FILE"), LONG + OLD),
    ("ezskiros", ("check", "--fix", "FILE", "--ontology", str(ONTOLOGY)), LONG + SKILLS),
]


@pytest.mark.parametrize(("program", "words", "text"), REPLACED)
def test_a_file_that_cannot_be_written_to_its_end_stays_as_it_was(
    program: str, words: tuple[str, ...], text: str, tmp_path: Path
) -> None:
    """Files may have 8 KiB, as if a device were full then."""
    file = tmp_path / ("rules.ross" if program == "rossmarie" else "skills.py")
    shutil.copy(PARTS, tmp_path)
    file.write_text(text)
    command = [path_of(program), *(each.replace("FILE", file.name) for each in words)]
    done = subprocess.run(
        ["sh", "-c", 'ulimit -f 16; exec "$@"', "sh", *command],
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    assert file.read_text() == text
    assert done.returncode == 2
    assert f"cannot write {file.name}: file too large" in done.stderr
    subprocess.run(command, cwd=tmp_path, capture_output=True, check=False)
    assert file.read_text() != text


# --- names -----------------------------------------------------------------------------------

HEAVY = (b"matplotlib", b"mujoco", b"numpy", b"pyoxigraph", b"py_trees", b"rosbags", b"z3", b"lark")


@pytest.mark.parametrize(
    ("program", "words", "said"),
    [
        *((program, ("--help",), b"Usage") for program in PROGRAMS),
        *((program, ("chekc",), b"No such command 'chekc'") for program in PROGRAMS),
        ("heron", ("record", "foo", "--out", "a.mcap"), b"there are nav, place, human"),
        ("heron", ("record", "nav", "--variant", "fast", "--out", "a.mcap"), b"there are gentle"),
        ("heron", ("evaluate", "--experiment", "foo"), b"there are nav, place, human"),
    ],
)
def test_names_are_known_before_much_is_imported(
    program: str, words: tuple[str, ...], said: bytes, tmp_path: Path
) -> None:
    done = alone(program, *words, folder=tmp_path, PYTHONPROFILEIMPORTTIME="1")
    assert done.returncode == (0 if "--help" in words else 2)
    assert said in done.stdout + done.stderr
    imported = {line.rpartition(b"|")[2].strip() for line in done.stderr.splitlines()}
    assert b"typer" in imported
    assert imported.isdisjoint(HEAVY)
