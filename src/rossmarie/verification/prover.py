"""CBMC, as a separate program: its path, and its answer to one check.

The PATH must contain CBMC 6, CaDiCaL and z3, which are packages of Debian 13. A z3 from the Python
package `z3-solver` takes precedence: it also answers the queries about rules, and is often newer,
which halves the time of some proofs.
"""

from __future__ import annotations

import enum
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import sysconfig
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from importlib import metadata
from pathlib import Path
from typing import Any, NamedTuple

from rossmarie.verification.check import Check
from rossmarie.verification.harness import Harness
from rossmarie.verification.solver_scripts import SCRIPTS

PROGRAMS = ("cbmc", "cadical", "z3")
"""The required programs: CBMC and the solvers that it calls."""

_PACKAGE = "bitwuzla"
"""The solver that is a Python package, of the extra `prover`."""

_SCRIPTS = sysconfig.get_path("scripts")
"""The folder of the programs that Python packages install."""

_SAT = ("--external-sat-solver", "cadical")
"""A SAT solver, which decides hundreds of obligations about states and instants at once."""

_OWN_SAT: tuple[str, ...] = ()
"""CBMC's own SAT solver, which continues after an obligation that does not hold."""

_SMT = ("--smt2", "--fpa")
"""z3, which supports floating-point arithmetic. It finds two sums of the same numbers equal without
a comparison of their bits.
"""

_ENDING = (*_SMT, "--no-unwinding-assertions")
"""The same for queries without the ends of loops. z3 would need too much time for these ends, so
separate queries cover them.
"""

_ANY_ARITHMETIC = ("--boolector",)
"""Bitwuzla, with sums, products and quotients as uninterpreted functions of their operands. It is
the fastest solver by far, but it cannot refute.
"""

_LISTING = 10
"""The time limit in seconds of the search for all failing obligations, after the first failing one
is known.
"""

_MOST = 600
"""The time limit in seconds of all steps that are not queries."""


class _Step(NamedTuple):
    """Solvers for groups of `size` obligations, each with a time limit in seconds."""

    size: int
    seconds: int
    solvers: Sequence[Sequence[str]]


_ALL = _UNTIL_THE_END = sys.maxsize
_FIRST = ((*_SAT, "--stop-on-fail"),)
_WHOLE = _Step(_ALL, 60, (_ANY_ARITHMETIC,))
_WHOLE_STATES = _Step(_ALL, 40, _FIRST)
_LAST = (
    _Step(5, 15, (_ANY_ARITHMETIC, _SAT, _ENDING)),
    _Step(1, _UNTIL_THE_END, (_ANY_ARITHMETIC, _SAT, _ENDING)),
)
_FORBIDDEN = (
    _Step(_ALL, 60, (_ANY_ARITHMETIC, _SAT)),
    _Step(100, 60, (_ANY_ARITHMETIC, _SAT)),
    *_LAST,
)
_STATES = (_Step(20, 15, (_ANY_ARITHMETIC, *_FIRST)), *_LAST)
_SENTENCES = (_Step(40, 15, (_ANY_ARITHMETIC,)), _Step(40, 15, (_ENDING,)), *_LAST)


class ProofVerdict(enum.Enum):
    """The outcome of a check."""

    PROVED = "proved"
    REFUTED = "refuted"
    UNDECIDED = "undecided"


@dataclass(frozen=True)
class ProofOutcome:
    """The verdict on a check, with the failing sentences, or the reason why there is no verdict."""

    check: Check
    verdict: ProofVerdict
    reasons: tuple[str, ...] = ()


_Answer = tuple[ProofVerdict, tuple[str, ...]]
"""A verdict, and the sentences that do not hold or are undecided."""


class ProverError(Exception):
    """The prover rejects the program. The message is its output."""


@dataclass(frozen=True)
class Prover:
    """CBMC and its solvers."""

    def tools(self) -> dict[str, str]:
        """The versions of CBMC and of its solvers."""
        tools = (*PROGRAMS, _PACKAGE)
        return {tool: version for tool in tools if (version := self.version(tool))}

    def version(self, program: str = "cbmc") -> str:
        """The version of CBMC, or of a solver, as `6.6.0`; empty if it does not run."""
        if program == _PACKAGE:
            return metadata.version(program)
        try:
            done = self._must([program, "--version"], Path("/"))
        except (OSError, ProverError):
            return ""
        found = re.search(r"\d+(\.\d+)+", done)
        return found[0] if found else ""

    def lacking(self) -> str | None:
        """The reason why nothing can be proved; None if CBMC 6 and its solvers run."""
        for program in PROGRAMS:
            if not self.version(program):
                is_there = shutil.which(program, path=_path()) is not None
                return f"{program} does not run" if is_there else f"{program} is not on the PATH"
        found = self.version()
        return None if found.startswith("6.") else f"cbmc is version {found}, not 6"

    @contextmanager
    def workshop(self) -> Iterator[Path]:
        """A temporary folder for programs and queries."""
        with tempfile.TemporaryDirectory(prefix="rossmarie_") as folder:
            for name, text in SCRIPTS.items():
                script = Path(folder) / name
                script.write_text(text, encoding="utf-8")
                script.chmod(0o755)
            yield Path(folder)

    def compile(self, folder: Path, harness: Harness) -> None:
        """Write the program of a harness, beside the sources that it includes, and compile it once.

        Raises `ProverError` if CBMC rejects the program.
        """
        (folder / f"{harness.name}.c").write_text(harness.text, encoding="utf-8")
        self._must(["goto-cc", "-c", "-o", f"{harness.name}.goto", f"{harness.name}.c"], folder)

    def run(self, harness: Harness, check: Check, folder: Path, seconds: int) -> ProofOutcome:
        """Run a check in the folder of its program. Each query has a CPU-time limit, in seconds."""
        command = ["cbmc", self._compile(harness, check, folder), "--json-ui"]
        command += ["--unwind", str(harness.passes), *_unwound(check)]
        listed = _messages(self._must([*command, "--show-properties"], folder))
        names = [each["name"] for message in listed for each in message.get("properties", ())]
        query = _Query([*command, "--slice-formula"], folder, seconds)
        answers = self._answers(query, names, is_arithmetic=check.is_arithmetic)
        reasons = tuple(reason for answer in answers for reason in answer[1])
        return ProofOutcome(check, max((answer[0] for answer in answers), key=_weight), reasons)

    def _compile(self, harness: Harness, check: Check, folder: Path) -> str:
        """Compile the functions that a check calls. Returns the name of the file."""
        program = f"{check.name}.goto"
        function = f"check_{check.name}"
        whole = f"{harness.name}.goto"
        self._must(["goto-cc", "--function", function, "-o", program, whole], folder)
        calls = [
            word for old, new in check.replaced for word in ("--replace-calls", f"{old}:{new}")
        ]
        if calls:
            self._must(["goto-instrument", *calls, program, program], folder)
        self._must(["goto-instrument", "--drop-unused-functions", program, program], folder)
        return program

    def _answers(
        self, query: _Query, names: Sequence[str], *, is_arithmetic: bool
    ) -> Sequence[_Answer]:
        """Query all obligations at once. If this is too hard, query all forbidden operations,
        groups of sentences, and once the ends of loops.
        """
        for whole in [_WHOLE] if is_arithmetic else [_WHOLE, _WHOLE_STATES]:
            found = list(self._narrowed(query, names, [whole]))
            if found[-1][0] is not ProofVerdict.UNDECIDED:
                return found
        found = []
        forbidden = [name for name in names if not _is_ours(name)]
        ours = [name for name in names if _is_ours(name)]
        sentences = _SENTENCES if is_arithmetic else _STATES
        found += self._narrowed(query, forbidden, _FORBIDDEN) if forbidden else ()
        found += self._narrowed(query, ours, sentences) if ours else ()
        return [*found, self._ask(query, (forbidden or names)[:1], [_SAT, _SMT])]

    def _narrowed(
        self, query: _Query, names: Sequence[str], steps: Sequence[_Step]
    ) -> Iterator[_Answer]:
        """Query groups of obligations. Finer steps get the groups that are too hard."""
        step, *finer = steps
        for first in range(0, max(len(names), 1), step.size):
            group = names[first : first + step.size]
            answer = self._ask(query.within(step.seconds), group, step.solvers)
            if answer[0] is ProofVerdict.REFUTED and not answer[1]:
                yield answer  # if solvers disagree, nothing is proved
                answer = self._ask(query.within(_LISTING), group, [_OWN_SAT])
            others = [each for each in finer if each.size < len(group) or each[1:] != step[1:]]
            if answer[0] is ProofVerdict.UNDECIDED and others:
                yield from self._narrowed(query, group, others)
            else:
                yield answer

    def _ask(
        self,
        query: _Query,
        names: Sequence[str],
        solvers: Sequence[Sequence[str]],
    ) -> _Answer:
        """Query some obligations, or all if no name is given, with all solvers at once. The first
        answer counts.
        """
        with ExitStack() as stack:
            started = [
                stack.enter_context(
                    self._start(
                        [*query.command, *_named(names), *solver],
                        query.folder,
                        query.seconds,
                    )
                )
                for solver in solvers
            ]
            found = _first(started)
        if found is not None:
            return found
        about = ", ".join(names)
        return ProofVerdict.UNDECIDED, (f"no answer within {query.seconds} s: {about}",)

    def _must(self, command: Sequence[str], folder: Path) -> str:
        with self._start(command, folder, _MOST) as started:
            started.process.wait()
            if started.process.returncode != 0:
                raise ProverError(started.text())
            return started.text()

    def _start(self, command: Sequence[str], folder: Path, seconds: int) -> _Started:
        # CPU seconds, so that a busy machine does not change the answer. The workshop's own solver
        # scripts come first.
        script = f'ulimit -t {seconds} && cd "$0" && PATH=.:$PATH exec "$@"'
        return _Started(["/bin/sh", "-c", script, str(folder), *command], folder)


@dataclass(frozen=True)
class _Query:
    """A call of CBMC: its arguments, its folder and its time limit in seconds."""

    command: Sequence[str]
    folder: Path
    seconds: int

    def within(self, seconds: int) -> _Query:
        """The same call with at most this time limit."""
        return replace(self, seconds=min(self.seconds, seconds))


class _Started:
    """A running program and its output so far. The context manager's exit ends the program and all
    its children.
    """

    def __init__(self, command: Sequence[str], folder: Path) -> None:
        # A file, because a pipe without a reader would block the program.
        self._said = tempfile.TemporaryFile(  # noqa: SIM115  (closed when left)
            mode="w+", encoding="utf-8", errors="replace"
        )
        self.process = subprocess.Popen(
            command,
            cwd=folder,
            # TMPDIR: files that remain after a kill disappear with the folder.
            env={**os.environ, "PATH": _path(), "TMPDIR": "."},
            stdout=self._said,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )

    def __enter__(self) -> _Started:
        return self

    def __exit__(self, *_: object) -> None:
        if self.process.poll() is None:
            os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()
        self._said.close()

    def has_ended(self) -> bool:
        """Wait a moment, and say whether the program has ended."""
        try:
            self.process.wait(0.02)
        except subprocess.TimeoutExpired:
            return False
        return True

    def text(self) -> str:
        """The program's output so far."""
        self._said.seek(0)
        return self._said.read()


def _path() -> str:
    """The folders in which programs are searched for."""
    return os.pathsep.join([_SCRIPTS, os.environ.get("PATH", "")])


def _unwound(check: Check) -> list[str]:
    loops = (*check.loops, *check.unwound)
    options = [word for loop, passes in loops for word in ("--unwindset", f"{loop}:{passes}")]
    return [*options, "--no-unwinding-assertions"] if check.unwound else options


def _named(names: Sequence[str]) -> list[str]:
    return [word for name in names for word in ("--property", name)]


def _is_ours(name: str) -> bool:
    return name.split(".", 1)[1].startswith("assertion")


def _weight(verdict: ProofVerdict) -> int:
    return (ProofVerdict.PROVED, ProofVerdict.UNDECIDED, ProofVerdict.REFUTED).index(verdict)


def _first(started: Sequence[_Started]) -> _Answer | None:
    """The first answer of several programs; programs without an answer are skipped."""
    running = list(started)
    while running:
        for each in [each for each in running if each.has_ended()]:
            running.remove(each)
            answer = _read(each.text())
            if answer is not None:
                return answer
    return None


def _messages(text: str) -> list[Any]:
    """The messages of CBMC, as data; empty if the output was cut off."""
    try:
        messages = json.loads(text)
    except ValueError:
        return []
    return messages if isinstance(messages, list) else []


def _read(text: str) -> _Answer | None:
    """The answer in CBMC's messages; None if there is none."""
    messages = _messages(text)
    results = [result for message in messages for result in message.get("result", ())]
    status = {message["cProverStatus"] for message in messages if "cProverStatus" in message}
    if status not in ({"success"}, {"failure"}):
        return None
    if any(each["status"] not in ("SUCCESS", "FAILURE") for each in results):
        return None
    failed = tuple(each["description"] for each in results if each["status"] == "FAILURE")
    is_proved = status == {"success"} and not failed
    return (ProofVerdict.PROVED if is_proved else ProofVerdict.REFUTED), failed
