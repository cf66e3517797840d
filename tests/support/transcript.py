"""Terminal sessions in pages: commands after `$`, and their output."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from support import command_line

_PROGRAMS = ("rossmarie", "ezskiros", "crosscheck")
_RUN = (*(f"{program} " for program in _PROGRAMS), "heron ", "python ", "cat ", "sed ", "echo $?")
# Of words and quotations in which nothing has a meaning of its own.
_PLAIN = re.compile(r"""(?:[\w@%+=:,./ -]|'[^']*'|"[^"$`\\]*")+""")


@dataclass(frozen=True)
class Step:
    """A command and the output shown below it (empty: none is shown)."""

    command: str
    output: str


def steps(text: str) -> list[Step]:
    """The commands of a block, in order."""
    pieces = re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]
    return [
        Step(command.strip(), output) for command, _, output in (p.partition("\n") for p in pieces)
    ]


def shows(shown: str, actual: str) -> bool:
    """Say whether a page that shows `shown` matches the actual output.

    `...` alone on a line matches any lines; otherwise it matches any part of its line.
    """
    pattern = ""
    for line in shown.rstrip().split("\n"):
        if line.strip() == "...":
            pattern += r"(.*\n)*?"
        else:
            pattern += ".*".join(re.escape(part) for part in line.rstrip().split("...")) + r"[ ]*\n"
    return re.fullmatch(pattern, actual.rstrip() + "\n") is not None


def run(text: str, folder: Path) -> list[str]:
    """Run the commands of a block in `folder`; what was not as shown.

    Commands of this project, Python, `cat` and `sed` run; all others are taken on trust. A command
    whose output is not shown has to succeed.
    """
    problems = []
    exit_code = 0
    for step in steps(text):
        if not step.command.startswith(_RUN):
            continue
        if step.command == "echo $?":
            printed = f"{exit_code}\n"
        else:
            exit_code, printed = _execute(step.command, folder)
        if step.output.strip() and not shows(step.output, printed):
            problems.append(f"$ {step.command}\nprinted\n{printed}\nnot\n{step.output}")
        elif not step.output.strip() and exit_code != 0:
            problems.append(f"$ {step.command}\nended with {exit_code} and printed\n{printed}")
    return problems


def _execute(command: str, folder: Path) -> tuple[int, str]:
    programs = str(Path(sys.executable).parent)
    variables = {
        "PATH": f"{programs}{os.pathsep}{os.environ['PATH']}",
        "COLUMNS": "100",
        "NO_COLOR": "1",
        "TERM": "dumb",
    }
    if words := words_of(command):
        done = command_line.run(*words, folder=folder, variables=variables, is_merged=True)
    else:
        done = subprocess.run(
            command,
            shell=True,
            cwd=folder,
            env={**os.environ, **variables},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            encoding="utf-8",
            timeout=command_line.TIME_LIMIT_S,
            check=False,
        )
    return done.returncode, done.stdout


def words_of(command: str) -> list[str] | None:
    """The words of a call of a program of this project; None if it takes a shell to tell them."""
    words = shlex.split(command) if _PLAIN.fullmatch(command) else []
    return words if words and words[0] in _PROGRAMS else None
