"""Provers for tests: one that answers as it is told, and a Debian made in no time."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from rossmarie.verification.check import Check
from rossmarie.verification.harness import Harness
from rossmarie.verification.prover import (
    PROGRAMS,
    Outcome,
    Prover,
    ProverError,
    Verdict,
    find_prover,
)
from support.parts import PROVER, require


def real_prover() -> Prover:
    """CBMC; without it the test is skipped."""
    require(PROVER)
    found = find_prover()
    assert found is not None
    return found


@dataclass(frozen=True)
class StandIn(Prover):
    """Proves everything at once, but what is named: `refuted` and `undecided` with a sentence.

    Over `fails` it fails, at `dies` the system ends it, and over `hangs` it broods with a process
    beside it, which notes its number in the file of that name in `folder`.
    """

    root: Path | None = None
    refuted: tuple[tuple[str, str], ...] = ()
    undecided: tuple[tuple[str, str], ...] = ()
    fails: str = ""
    dies: str = ""
    hangs: str = ""
    folder: Path = Path()
    refuses: str = ""

    def version(self, program: str = "cbmc") -> str:
        return {"cbmc": "6.6.0", "cadical": "1.7.3", "z3": "4.13.3"}[program]

    def compile(self, folder: Path, harness: Harness) -> None:
        del folder, harness
        if self.refuses:
            raise ProverError(self.refuses)

    def run(self, harness: Harness, check: Check, folder: Path, seconds: int) -> Outcome:
        del harness, folder, seconds
        if check.name == self.fails:
            raise ProverError("Usage:\nunknown option\n")
        if check.name == self.dies:
            os.kill(os.getpid(), signal.SIGKILL)
        if check.name == self.hangs:
            self._hang()
        for verdict, those in (
            (Verdict.REFUTED, self.refuted),
            (Verdict.UNDECIDED, self.undecided),
        ):
            reasons = tuple(reason for name, reason in those if name == check.name)
            if reasons:
                return Outcome(check, verdict, reasons)
        return Outcome(check, Verdict.PROVED)

    def _hang(self) -> None:
        with subprocess.Popen(["sleep", "120"], start_new_session=True) as beside:
            try:
                (self.folder / self.hangs).write_text(str(beside.pid))
                time.sleep(120)
            finally:
                beside.kill()


_SCRIPT = """\
#!/bin/sh
# debootstrap, but quick: a folder in which sh runs, and provers answer.
for folder; do :; done
echo called >> {calls}
{before}
for file in /bin/sh $(ldd /bin/sh | grep -o '/[^ ]*'); do
    mkdir -p "$folder$(dirname "$file")"
    cp "$file" "$folder$file"
done
mkdir -p "$folder/usr/bin" "$folder/tmp"
for program in cbmc cadical z3; do
    printf '#!/bin/sh\\necho 6.6.0\\n' > "$folder/usr/bin/$program"
    chmod +x "$folder/usr/bin/$program"
done
"""


@dataclass(frozen=True)
class QuickDebian:
    """A debootstrap on the path, and an empty cache."""

    programs: Path
    cache: Path
    calls: Path

    def write(self, before: str = "") -> None:
        """Install it; `before` is what it does at first."""
        script = self.programs / "debootstrap"
        script.write_text(_SCRIPT.format(calls=self.calls, before=before))
        script.chmod(0o755)

    def count(self) -> int:
        """How often it was called."""
        return self.calls.read_text().count("called") if self.calls.exists() else 0


def quick_debian(folder: Path, monkeypatch: pytest.MonkeyPatch) -> QuickDebian:
    """In a folder of its own; nothing else of the system's provers is found."""
    made = QuickDebian(folder / "bin", folder / "cache" / "rossmarie", folder / "calls")
    made.programs.mkdir()
    made.write()
    for name in PROGRAMS:  # those of the system do not answer
        (made.programs / name).write_text("#!/bin/sh\nexit 1\n")
        (made.programs / name).chmod(0o755)
    monkeypatch.setenv("XDG_CACHE_HOME", str(folder / "cache"))
    monkeypatch.setenv("PATH", f"{made.programs}:/usr/sbin:/usr/bin:/sbin:/bin")
    return made


def wait_for(condition: Callable[[], bool], seconds: float = 30.0) -> None:
    """Return once it holds; fail if it does not for so long."""
    until = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < until, "it takes too long"
        time.sleep(0.05)


def is_running(number: int) -> bool:
    """Whether a process does more than wait for its parent to notice its end."""
    try:
        return Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False
