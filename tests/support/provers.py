"""Provers for tests: the real one, and one that answers as it is reported."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from dslkit.writing import write_texts
from rossmarie import ir
from rossmarie.driver.verifying import VerificationQueries, prove
from rossmarie.report.proofs import Proofs
from rossmarie.targets import c99
from rossmarie.verification.check import Check
from rossmarie.verification.harness import Harness, covered, harness
from rossmarie.verification.prover import (
    ProofOutcome,
    ProofVerdict,
    Prover,
    ProverError,
)
from support.damage import damaged
from support.parts import PROVER, require

SECONDS = 120
"""No solver is given more of a processor for one query."""

NO_CHANGE = ("", "")


def real_prover() -> Prover:
    """CBMC; without it the test is skipped."""
    require(PROVER)
    return Prover()


def proofs_of_reactor(
    prover: Prover, queries: VerificationQueries, old: str, new: str, *names: str
) -> Proofs:
    """Ask the queries about a reactor whose names begin so, after a change of its C."""
    files = queries.files if not old else damaged(queries.files, "reactor", old, new)
    program = queries.programs[1]
    checks = tuple(check for check in program.checks if check.name.startswith(names))
    assert checks
    changed = replace(queries, files=files, programs=(replace(program, checks=checks),))
    return prove(changed, prover, seconds=SECONDS)


def asked(
    prover: Prover,
    machine: ir.Machine,
    change: tuple[str, str],
    names: Sequence[str],
    seconds: int = SECONDS,
) -> Iterator[ProofOutcome]:
    """The outcomes of the checks of a monitor whose names begin so, after a change of its C."""
    program = harness(machine)
    with prover.workshop() as folder:
        files = covered(c99.generate(machine))
        write_texts(folder, files if change == NO_CHANGE else damaged(files, "monitor", *change))
        prover.compile(folder, program)
        for check in program.checks:
            if check.name.startswith(tuple(names)):
                yield prover.run(program, check, folder, seconds)


def refuted(proofs: Proofs) -> list[str]:
    """The sentences that do not hold."""
    return [reason for each in proofs.having(ProofVerdict.REFUTED) for reason in each.reasons]


@dataclass(frozen=True)
class StandIn(Prover):
    """Proves everything at once, but what is named: `refuted` and `undecided` with a sentence.

    Over `fails` it fails, at `dies` the system ends it, and over `hangs` it broods with a process
    beside it, which notes its number in the file of that name in `folder`.
    """

    refuted: tuple[tuple[str, str], ...] = ()
    undecided: tuple[tuple[str, str], ...] = ()
    fails: str = ""
    dies: str = ""
    hangs: str = ""
    folder: Path = Path()
    refuses: str = ""

    def version(self, program: str = "cbmc") -> str:
        return {"cbmc": "6.6.0", "cadical": "1.7.3", "z3": "4.13.3", "bitwuzla": "0.10.0"}[program]

    def compile(self, folder: Path, harness: Harness) -> None:
        del folder, harness
        if self.refuses:
            raise ProverError(self.refuses)

    def run(self, harness: Harness, check: Check, folder: Path, seconds: int) -> ProofOutcome:
        del harness, folder, seconds
        if check.name == self.fails:
            raise ProverError("Usage:\nunknown option\n")
        if check.name == self.dies:
            os.kill(os.getpid(), signal.SIGKILL)
        if check.name == self.hangs:
            self._hang()
        for verdict, those in (
            (ProofVerdict.REFUTED, self.refuted),
            (ProofVerdict.UNDECIDED, self.undecided),
        ):
            reasons = tuple(reason for name, reason in those if name == check.name)
            if reasons:
                return ProofOutcome(check, verdict, reasons)
        return ProofOutcome(check, ProofVerdict.PROVED)

    def _hang(self) -> None:
        with subprocess.Popen(["sleep", "120"], start_new_session=True) as beside:
            try:
                (self.folder / self.hangs).write_text(str(beside.pid))
                time.sleep(120)
            finally:
                beside.kill()


def programs(folder: Path, versions: Mapping[str, str]) -> None:
    """Programs that say these versions of themselves, and do nothing else."""
    folder.mkdir()
    for name, version in versions.items():
        (folder / name).write_text(f"#!/bin/sh\necho {version}\n")
        (folder / name).chmod(0o755)


def wait_for(condition: Callable[[], bool], seconds: float = 30.0) -> None:
    """Return once it holds; fail if it does not for so long."""
    until = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < until, "it takes too long"
        time.sleep(0.05)


def is_running(number: int) -> bool:
    """Say whether a process is more than a zombie that waits for its parent."""
    try:
        return Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False
