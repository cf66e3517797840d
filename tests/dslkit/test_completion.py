"""Shells complete the names that the programs know, fast, and the scripts work in each shell."""

from __future__ import annotations

import os
import pty
import re
import select
import subprocess
import sys
import time
from pathlib import Path

import pytest

from support.command_line import run
from support.parts import FISH, ZSH, needs

HEAVY = {"mujoco", "numpy", "pydantic", "py_trees", "rosbags", "shapely", "torch", "z3"}
PROGRAMS = Path(sys.executable).parent


def completed(line: str, shell: str = "bash") -> list[str]:
    """The words for the end of a line, as the script of a shell gets them."""
    program = line.split()[0]
    variables = {f"_{program.upper()}_COMPLETE": f"complete_{shell}"}
    if shell == "bash":
        words = line.split(" ")
        variables |= {"COMP_WORDS": line, "COMP_CWORD": str(len(words) - 1)}
    else:
        variables |= {"_TYPER_COMPLETE_ARGS": line, "_TYPER_COMPLETE_FISH_ACTION": "get-args"}
    done = run(program, variables=variables)
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout.split("\n")[:-1]


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("rossmarie ver", ["verify"]),
        ("rossmarie example ", ["franka", "heron", "husky", "turtlebot4", "ur5e"]),
        ("rossmarie example tu", ["turtlebot4"]),
        ("rossmarie explain ROSS30", [f"ROSS30{number}" for number in range(1, 10)]),
        ("rossmarie explain [", [""]),
        ("rossmarie build --target r", ["ros1", "ros2"]),
        ("rossmarie build --rev", ["--review"]),
        ("rossmarie check --format ", ["text", "json", "sarif"]),
        ("rossmarie graph --format ", ["text", "svg", "dot", "json"]),
        ("rossmarie replay rules.ross drive.bag --format j", ["json"]),
        ("crosscheck explain CHK00", ["CHK001"]),
        ("crosscheck show --format s", ["svg"]),
        ("ezskiros explain EZS001", ["EZS001"]),
        ("ezskiros show --format ", ["text", "svg", "btcpp"]),
        ("heron run cor", ["corridor"]),
        ("heron run nav --variant ", ["flat", "gentle", "steep"]),
        ("heron record pl", ["place"]),
        ("heron record place --variant h", ["high", "hurried"]),
        ("heron evaluate --experiment hu", ["human"]),
        ("heron learn steps --algorithm ", ["ppo", "sac"]),
        ("rossmarie check ", [""]),
    ],
)
def test_known_names_are_completed(line: str, words: list[str]) -> None:
    assert completed(line) == words


def test_fish_gets_an_explanation_with_each_word() -> None:
    assert "husky\tHusky: a base" in "\n".join(completed("rossmarie example h", "fish"))
    assert completed("rossmarie explain ROSS301", "fish") == ["ROSS301\tunit-mismatch"]


def test_zsh_gets_what_its_completion_evaluates() -> None:
    (first, *_) = completed("rossmarie explain ROSS301", "zsh")
    assert first == '_arguments \'*: :(("ROSS301":"unit-mismatch"))\''
    assert completed("rossmarie check ", "zsh") == ["_files"]


@pytest.mark.parametrize(
    "line", ["rossmarie explain ", "rossmarie example ", "ezskiros explain ", "heron run "]
)
def test_completion_loads_no_heavy_module(line: str) -> None:
    program = line.split()[0]
    code = (
        "import sys\n"
        f"from {program}.__main__ import main\n"
        "try:\n    main()\nfinally:\n    print(*sys.modules, file=sys.stderr)\n"
    )
    variables = {f"_{program.upper()}_COMPLETE": "complete_bash", "COMP_WORDS": line}
    variables |= {"COMP_CWORD": "2"}
    command = [sys.executable, "-c", code.replace("sys\n", f"sys; sys.argv[0] = '{program}'\n", 1)]
    done = subprocess.run(command, env={**os.environ, **variables}, capture_output=True, text=True)
    assert done.stdout.strip()
    assert not HEAVY & set(done.stderr.split())


def test_bash_completes_what_somebody_types(tmp_path: Path) -> None:
    script = run("rossmarie", variables={"_ROSSMARIE_COMPLETE": "source_bash"}).stdout
    (tmp_path / "rossmarie.bash").write_text(script)
    typed = "source rossmarie.bash\nrossmarie example tur\t\nexit\n"
    assert "rossmarie example turtlebot4" in typed_into(["bash", "--norc", "-i"], typed, tmp_path)


def typed_into(command: list[str], typed: str, folder: Path) -> str:
    """The screen of a shell into which somebody types, one line after the other."""
    path = f"{PROGRAMS}{os.pathsep}{os.environ['PATH']}"
    child, terminal = pty.fork()
    if child == 0:
        os.chdir(folder)
        os.execvpe(command[0], command, {**os.environ, "PATH": path, "TERM": "dumb"})
    screen = ""
    try:
        for line in typed.splitlines(keepends=True):
            screen += read_until_quiet(terminal)
            text, tab, rest = line.partition("\t")
            os.write(terminal, (text + tab).encode())
            if tab:
                screen += read_until(terminal, "turtlebot4")
                os.write(terminal, rest.encode())
        screen += read_until_quiet(terminal)
    finally:
        os.close(terminal)
        os.waitpid(child, 0)
    return re.sub(r"\x1b\[[?0-9;]*[a-zA-Z]", "", screen)


def read_until_quiet(terminal: int) -> str:
    """The output of a terminal until nothing more comes."""
    return read_until(terminal, None)


def read_until(terminal: int, wanted: str | None, seconds: float = 60.0) -> str:
    """The output of a terminal until a text comes; without a text until nothing more comes."""
    text, end = "", time.monotonic() + seconds
    while time.monotonic() < end and (wanted is None or wanted not in text):
        is_ready, _, _ = select.select([terminal], [], [], 0.5)
        if not is_ready and wanted is None and text:
            break
        try:
            text += os.read(terminal, 4096).decode(errors="replace") if is_ready else ""
        except OSError:  # the shell has ended
            break
    return text


@pytest.mark.parametrize(
    "shell", [pytest.param("zsh", marks=needs(ZSH)), pytest.param("fish", marks=needs(FISH))]
)
def test_the_script_of_a_shell_is_read_by_the_shell(shell: str, tmp_path: Path) -> None:
    script = run("rossmarie", variables={"_ROSSMARIE_COMPLETE": f"source_{shell}"}).stdout
    path = tmp_path / "script"
    path.write_text(script)
    done = subprocess.run([shell, "-n", str(path)], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
