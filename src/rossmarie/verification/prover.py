"""CBMC, as a program beside us: where it is, and what it says of one check.

CBMC 6 is a package of Debian 13. Where the system itself has none, one in a folder with a whole
Debian of its own (as debootstrap makes it) is run by chroot, which needs root.
"""

from __future__ import annotations

import enum
import json
import os
import re
import shutil
import signal
import subprocess
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rossmarie.cache import cache_folder
from rossmarie.verification.check import Check
from rossmarie.verification.harness import Harness

_SOLVERS = ((), ("--smt2",))
"""CBMC's own SAT solver, and z3."""

_ONLY_LOOPS = ("--no-standard-checks", "--no-assertions")
"""What remains to be shown then is that loops end."""

_PROGRAM = "program.goto"


class Verdict(enum.Enum):
    """What became of a check."""

    PROVED = "proved"
    REFUTED = "refuted"
    UNDECIDED = "undecided"


@dataclass(frozen=True)
class Outcome:
    """The verdict on a check, and the sentences that do not hold, or why there is no verdict."""

    check: Check
    verdict: Verdict
    reasons: tuple[str, ...] = ()


class ProverError(Exception):
    """The prover does not accept the program; the message is what it says."""


@dataclass(frozen=True)
class Prover:
    """CBMC of the system (`root` is None), or in a Debian of its own below `root`."""

    root: Path | None

    def version(self) -> str:
        """What CBMC says of itself, as `6.6.0`; empty if it does not run."""
        try:
            done = self._must(["cbmc", "--version"], self.root or Path("/"))
        except (OSError, ProverError):
            return ""
        found = re.match(r"[\d.]+", done)
        return found[0] if found else ""

    @contextmanager
    def workshop(self) -> Iterator[Path]:
        """A folder that the prover can see, for as long as it is needed."""
        inside = None if self.root is None else self.root / "tmp"
        with tempfile.TemporaryDirectory(prefix="rossmarie_", dir=inside) as folder:
            yield Path(folder)

    def compile(self, folder: Path, harness: Harness) -> None:
        """Write the program of a harness, beside the sources that it includes, and translate it."""
        (folder / "harness.c").write_text(harness.text, encoding="utf-8")
        self._must(["goto-cc", "-o", _PROGRAM, "harness.c"], folder)

    def run(self, harness: Harness, check: Check, folder: Path, seconds: float) -> Outcome:
        """Ask about a check. No single question is given more than so many seconds."""
        program = _PROGRAM
        if check.replaced:
            program = f"{check.name}.goto"
            calls = [
                word for old, new in check.replaced for word in ("--replace-calls", f"{old}:{new}")
            ]
            self._must(["goto-instrument", *calls, _PROGRAM, program], folder)
        command = ["cbmc", program, "--function", f"check_{check.name}", "--json-ui"]
        command += ["--unwind", str(harness.passes), *_unwound(check)]
        listed = _messages(self._must([*command, "--show-properties"], folder))
        known = [each["name"] for message in listed for each in message.get("properties", ())]
        questions = [_ONLY_LOOPS, *(_named(group) for group in _grouped(known))]
        answers = [self._ask(command, question, folder, seconds) for question in questions]
        reasons = tuple(reason for answer in answers for reason in answer[1])
        return Outcome(check, max((answer[0] for answer in answers), key=_weight), reasons)

    def _ask(
        self, command: Sequence[str], question: Sequence[str], folder: Path, seconds: float
    ) -> tuple[Verdict, tuple[str, ...]]:
        """Ask all solvers at once; the first answer counts. What has none is asked in halves, as
        many easy questions together can be a hard one.
        """
        asked = [*command, "--slice-formula", *question]
        with ExitStack() as stack:
            started = [
                stack.enter_context(self._start([*asked, *option], folder)) for option in _SOLVERS
            ]
            found = _first(started, seconds)
        if found is not None:
            return found
        names = () if question is _ONLY_LOOPS else question[1::2]
        if len(names) < 2:
            about = names[0] if names else "that its loops end"
            return Verdict.UNDECIDED, (f"no answer within {seconds:g} s: {about}",)
        middle = len(names) // 2
        halves = (names[:middle], names[middle:])
        answers = [self._ask(command, _named(half), folder, seconds) for half in halves]
        return max((each[0] for each in answers), key=_weight), answers[0][1] + answers[1][1]

    def _must(self, command: Sequence[str], folder: Path) -> str:
        with self._start(command, folder) as started:
            started.process.wait()
            if started.process.returncode != 0:
                raise ProverError(started.text())
            return started.text()

    def _start(self, command: Sequence[str], folder: Path) -> _Started:
        if self.root is not None:
            inside = Path("/") / folder.relative_to(self.root)
            script = 'cd "$0" && exec "$@"'
            command = ["chroot", str(self.root), "/bin/sh", "-c", script, str(inside), *command]
        return _Started(command, folder)


class _Started:
    """A program that runs, and what it has said; ended with all that it started when left."""

    def __init__(self, command: Sequence[str], folder: Path) -> None:
        # A file, as a pipe that nobody reads would hold the program up.
        self._said = tempfile.TemporaryFile(  # noqa: SIM115  (closed when left)
            mode="w+", encoding="utf-8", errors="replace"
        )
        self.process = subprocess.Popen(
            command,
            cwd=folder,
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
        """Whether it ends within a moment."""
        try:
            self.process.wait(0.02)
        except subprocess.TimeoutExpired:
            return False
        return True

    def text(self) -> str:
        """What it has said so far."""
        self._said.seek(0)
        return self._said.read()


def find_prover() -> Prover | None:
    """CBMC 6 of the system, or in the cache of ROSSMARie (`prover`); None if there is neither."""
    known = []
    if shutil.which("cbmc"):
        known.append(Prover(None))
    own = cache_folder() / "prover"
    if (own / "usr/bin/cbmc").exists() and hasattr(os, "geteuid") and os.geteuid() == 0:
        known.append(Prover(own))
    return next((prover for prover in known if prover.version().startswith("6.")), None)


def _unwound(check: Check) -> list[str]:
    options: list[str] = []
    for loop, passes in check.unwound:
        options += ["--unwindset", f"{loop}:{passes}", "--no-unwinding-assertions"]
    return options


def _named(names: Sequence[str]) -> list[str]:
    return [word for name in names for word in ("--property", name)]


def _grouped(names: Sequence[str]) -> list[list[str]]:
    """Claims by the function that makes them; what C itself forbids comes all together."""
    groups: dict[str, list[str]] = {}
    for name in names:
        function, kind = name.split(".", 1)
        groups.setdefault(function if kind.startswith("assertion") else "", []).append(name)
    return list(groups.values())


def _weight(verdict: Verdict) -> int:
    return (Verdict.PROVED, Verdict.UNDECIDED, Verdict.REFUTED).index(verdict)


def _first(started: Sequence[_Started], seconds: float) -> tuple[Verdict, tuple[str, ...]] | None:
    """The first answer of several; those that give none are passed over."""
    until = time.monotonic() + seconds
    running = list(started)
    while time.monotonic() < until and running:
        for each in [each for each in running if each.has_ended()]:
            running.remove(each)
            answer = _read(each.text())
            if answer is not None:
                return answer
    return None


def _messages(text: str) -> list[Any]:
    """What CBMC says, as data; nothing if it was cut off."""
    try:
        messages = json.loads(text)
    except ValueError:
        return []
    return messages if isinstance(messages, list) else []


def _read(text: str) -> tuple[Verdict, tuple[str, ...]] | None:
    """The answer in CBMC's messages; None if there is none."""
    messages = _messages(text)
    results = [result for message in messages for result in message.get("result", ())]
    is_done = any("cProverStatus" in message for message in messages)
    if not is_done or any(each["status"] not in ("SUCCESS", "FAILURE") for each in results):
        return None
    failed = tuple(each["description"] for each in results if each["status"] == "FAILURE")
    return (Verdict.REFUTED if failed else Verdict.PROVED), failed
