"""Runs in a fork are as runs in a process of their own, and commands need no help of the fork."""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from importlib.metadata import version
from itertools import count
from pathlib import Path
from textwrap import dedent

import pytest
import typer

import crosscheck.cli.main
import ezskiros.cli.main
import rossmarie.cli.main
from support.command_line import run
from support.depth import deep
from support.parts import PROC, needs
from support.provers import is_running

EXAMPLES = Path(__file__).parents[2] / "examples"


def alone(
    *command: str | Path, folder: Path | None = None, given: str = ""
) -> subprocess.CompletedProcess[str]:
    """What `run` imitates."""
    environment = {**os.environ}  # else the C library adds its own, such as the size of a terminal
    return subprocess.run(
        command, cwd=folder, env=environment, input=given, capture_output=True, text=True
    )


@pytest.fixture
def script(tmp_path: Path) -> Path:
    """A file to write a program into."""
    return tmp_path / "script.py"


# --- what a program finds --------------------------------------------------------------------

PROBE = """
import json, multiprocessing, os, signal, subprocess, sys, threading

def handler(number: int):
    return repr(signal.getsignal(number)).partition(" at ")[0]

main = sys.modules["__main__"]
print(json.dumps({
    "argv": sys.argv,
    "cwd": os.getcwd(),
    "environment": dict(os.environ),
    "PATH of children": subprocess.getoutput("echo $PATH $COLUMNS"),
    "path": sys.path,
    "read": sys.stdin.read(),
    "main": (__name__, __file__, __spec__, main.__dict__ is globals()),
    "terminals": [os.isatty(number) for number in range(3)],
    "files": sorted(os.listdir("/dev/fd")),
    "streams": [
        (each.encoding, each.errors, each.line_buffering, each.fileno())
        for each in (sys.stdin, sys.stdout, sys.stderr)
    ],
    "signals": [handler(each) for each in signal.valid_signals()],
    "blocked": sorted(signal.pthread_sigmask(signal.SIG_BLOCK, [])),
    "annotations": repr(handler.__annotations__),
    "umask": os.umask(0),
    "threads": threading.active_count(),
    "multiprocessing": (
        multiprocessing.current_process().name, multiprocessing.parent_process(),
        multiprocessing.process.ORIGINAL_DIR,
    ),
    "flags": (repr(sys.flags), sys.warnoptions, sys.getrecursionlimit(), sys.flags.dev_mode),
    "tests": [
        name for name in sys.modules
        if name.partition(".")[0] in ("_pytest", "hypothesis", "pytest", "support", "xdist")
    ],
}))
"""


def test_a_program_finds_all_as_in_a_process_of_its_own(
    script: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    script.write_text(PROBE)
    monkeypatch.delenv("HOME", raising=False)
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    run("rossmarie", "--version", variables={"LEFT_BEHIND": "1"})
    monkeypatch.setenv("COLUMNS", "70")
    found = run(script, "a b", "-c", folder=folder, given="two\nlines")
    asked = alone(sys.executable, script, "a b", "-c", folder=folder, given="two\nlines")
    assert json.loads(found.stdout) == json.loads(asked.stdout)
    assert (found.returncode, found.stderr) == (0, "")


def test_variables_are_added_for_one_run(script: Path) -> None:
    script.write_text("import os; print(os.environ.get('ONE_RUN'), 'PATH' in os.environ)")
    assert run(script, variables={"ONE_RUN": "yes"}).stdout == "yes True\n"
    assert run(script).stdout == "None True\n"


def test_a_variable_that_would_come_too_late_is_refused(
    script: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    script.write_text("")
    with pytest.raises(ValueError, match="PYTHONHASHSEED is read when Python starts"):
        run(script, variables={"PYTHONHASHSEED": "1"})
    monkeypatch.setenv("LC_ALL", "C.UTF-8" if os.environ.get("LC_ALL") != "C.UTF-8" else "C")
    with pytest.raises(ValueError, match="LC_ALL is read"):
        run(script)


@needs(PROC)
@pytest.mark.parametrize("program", ["ezskiros", "rossmarie"])
def test_a_server_that_has_imported_all_has_one_thread(program: str, tmp_path: Path) -> None:
    script = tmp_path / program
    script.write_text(
        "import os, sys\n"
        f"assert '{program}.driver' in sys.modules\n"
        "print(len(os.listdir(f'/proc/{os.getppid()}/task')))"
    )
    assert run(script).stdout == "1\n"


def test_who_interrupts_the_tests_from_the_keyboard_does_not_interrupt_a_run(script: Path) -> None:
    script.write_text("import os; print(os.getsid(0))")
    assert int(run(script).stdout) != os.getsid(0)


# --- how it ends -----------------------------------------------------------------------------

ENDINGS = {
    "at its end": "print('all done')",
    "with a number": "import sys; sys.exit(3)",
    "with nothing": "import sys; print('fine', end=''); sys.exit()",
    "with a sentence": "import sys; sys.exit('that is wrong')",
    "at once": "import os; print('stale'); os._exit(7)",
    "with what was left for its end": (
        "import atexit, sys; atexit.register(print, 'last'); print('first'); sys.exit(4)"
    ),
    "when its threads have ended": (
        "import threading; threading.Thread(target=lambda: print('thread')).start()"
    ),
    "killed": "import os; os.kill(os.getpid(), 9)",
    "aborted": (
        "import os, resource; resource.setrlimit(resource.RLIMIT_CORE, (0, 0));"
        "print('said', flush=True); os.abort()"
    ),
    "with its output closed": "import os; print('stale'); os.close(1)",
    "with more than pipes hold": (
        "import sys; print('o' * 1_000_000); print('e' * 1_000_000, file=sys.stderr)"
    ),
    "with a file that is no Python": "no python at all",
}


@pytest.mark.parametrize("code", ENDINGS.values(), ids=ENDINGS)
def test_it_ends_as_a_process_of_its_own(script: Path, code: str) -> None:
    script.write_text(code)
    found, asked = run(script), alone(sys.executable, script)
    assert (found.returncode, found.stdout) == (asked.returncode, asked.stdout)
    assert found.stderr.endswith(asked.stderr.partition("(most recent call last):\n")[2])


@pytest.mark.parametrize("code", ["raise ValueError('oh')", "raise KeyboardInterrupt"])
def test_an_error_is_reported_with_its_place(script: Path, code: str) -> None:
    script.write_text(f"def fail():\n    {code}\n\nprint('before')\nfail()\n")
    found, asked = run(script), alone(sys.executable, script)
    assert (found.returncode, found.stdout) == (asked.returncode, asked.stdout)
    assert found.returncode != 0
    assert found.stderr.startswith("Traceback (most recent call last):\n")
    assert found.stderr.endswith(asked.stderr.partition("\n")[2])


def test_both_outputs_may_be_one(script: Path) -> None:
    code = "import sys; print('a', flush=True); print('b', file=sys.stderr); print('c')"
    script.write_text(code)
    done = run(script, is_merged=True)
    assert (done.stdout, done.stderr) == ("a\nb\nc\n", "")


@needs(PROC)
def test_what_hangs_is_ended_with_those_it_has_started(script: Path, tmp_path: Path) -> None:
    started = tmp_path / "started"
    script.write_text(
        dedent(f"""
        import subprocess, time
        print("hangs", flush=True)
        beside = subprocess.Popen(["sleep", "10000"])
        with open({str(started)!r}, "w") as file:
            file.write(str(beside.pid))
        time.sleep(10000)
        """)
    )
    for seconds in count(1):  # so long that it comes that far
        with pytest.raises(subprocess.TimeoutExpired) as found:
            run(script, timeout=seconds)
        if started.exists() and started.read_text():
            break
    assert str(found.value.stdout) == "hangs\n"
    assert not is_running(int(started.read_text()))
    script.write_text("print('as ever')")
    assert run(script).stdout == "as ever\n"


def test_it_has_no_more_memory_than_it_may(script: Path) -> None:
    script.write_text("try:\n    bytes(2 << 30)\nexcept MemoryError:\n    print('no more')")
    assert run(script, memory=1 << 30).stdout == "no more\n"
    assert run(script).stdout == ""


def test_a_server_that_is_killed_is_replaced(script: Path) -> None:
    script.write_text("import os; os.kill(os.getppid(), 9)")
    with pytest.raises(RuntimeError, match=r"the server of programs has ended: -9"):
        run(script)
    script.write_text("print('as ever')")
    assert run(script).stdout == "as ever\n"


def test_two_run_at_the_same_time(script: Path, tmp_path: Path) -> None:
    """Each waits for the other: one after the other they would never end."""
    script.write_text(
        dedent("""
        import pathlib, sys, time
        mine, other = map(pathlib.Path, sys.argv[1:])
        mine.touch()
        while not other.exists():
            time.sleep(0.01)
        print(mine.name)
        """)
    )
    one, other = tmp_path / "one", tmp_path / "other"
    with ThreadPoolExecutor() as threads:
        runs = [threads.submit(run, script, *each) for each in ((one, other), (other, one))]
    assert [each.result().stdout for each in runs] == ["one\n", "other\n"]


# --- what commands need ----------------------------------------------------------------------

COMMANDS = {
    "crosscheck": [
        "check robot.ross",
        "explain CHK102",
        "impact Wipe robot.ross",
        "live robot.ross --duration 1",
        "show robot.ross --format svg --out robot.svg",
        "weave robot.ross --out guards.json",
    ],
    "heron": ["run nav --ros1 --arm none"],
    "ezskiros": [
        "check skills",
        "explain EZS401",
        "explain Pick skills",
        "example pick_place copied",
        "export skills --out skills.json",
        "learn drive.csv",
        "migrate skills",
        "owl --ontology ontology --out owl",
        "plan skills --scene lab.turtle --goal '(skiros:contain shelf starter)'",
        "run pick skills --scene lab.turtle --simulate Object=cable Gripper=gripper",
        "show pick_and_place skills --format btcpp --out a.xml",
        "stubs --ontology ontology --out world.pyi",
    ],
    "rossmarie": [
        "check drive.ross",
        "build drive.ross --target ros2",
        "coverage drive.ross drive.csv",
        "dump drive.ross --after generate",
        "example husky",
        "explain unit-mismatch",
        "export drive.ross --out rules.json",
        "failures drive.ross",
        "fmt drive.ross",
        "graph drive.ross --format svg",
        "init drive.csv",
        "model drive.csv",
        "replay drive.ross drive.csv --out seen",
        "report drive.ross --date 2026-03-04",
        "test drive.ross --write",
    ],
}
TIME = re.compile(r"\d+\.\d+ m?s")
RULES = """action stop;
input on = topic /on : std_msgs/Bool timeout 1 sec
rule it: if on then { stop; };
"""


@pytest.mark.parametrize(
    ("program", "command"),
    [
        *((program, commands[0]) for program, commands in COMMANDS.items()),
        *deep((program, each) for program, commands in COMMANDS.items() for each in commands[1:]),
    ],
)
def test_a_command_imports_what_it_needs(program: str, command: str, tmp_path: Path) -> None:
    """Started by itself, where nothing has been imported, it does the same."""
    folders = [tmp_path / "fork" / "lab", tmp_path / "process" / "lab"]
    for folder in folders:
        shutil.copytree(EXAMPLES / "pick_place", folder)
        (folder / "drive.ross").write_text(RULES)
        shutil.copytree(EXAMPLES / "whiteboard", folder.parent / "whiteboard")
        robot = (EXAMPLES / "whiteboard" / "whiteboard.ross").read_text()
        (folder / "robot.ross").write_text(
            robot.replace("skills.json", "../whiteboard/skills.json")
        )
        (folder / "drive.csv").write_text("time,on\n0.0,0\n1.0,1\n2.5,0\n3.0,0\n")
    words = shlex.split(command)
    found = run(program, *words, folder=folders[0])
    asked = alone(Path(sys.executable).with_name(program), *words, folder=folders[1])
    assert (found.returncode, found.stderr) == (asked.returncode, asked.stderr)
    assert TIME.sub("", found.stdout) == TIME.sub("", asked.stdout)
    assert "Traceback" not in asked.stderr


@pytest.mark.parametrize(
    ("program", "app", "elsewhere"),
    [
        ("crosscheck", crosscheck.cli.main.app, set()),
        ("ezskiros", ezskiros.cli.main.app, set()),
        ("rossmarie", rossmarie.cli.main.app, {"verify"}),  # `test_verification.py` starts it
    ],
)
def test_each_command_is_among_them(program: str, app: typer.Typer, elsewhere: set[str]) -> None:
    there_are = typer.main.get_command(app).commands.keys()  # type: ignore[attr-defined]
    assert {command.split()[0] for command in COMMANDS[program]} == there_are - elsewhere


@pytest.mark.parametrize("program", COMMANDS)
def test_the_version_is_printed(program: str) -> None:
    done = run(program, "--version")
    assert (done.returncode, done.stdout) == (0, f"{program} {version('rossmarie')}\n")
