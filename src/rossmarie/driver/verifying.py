"""Verification: from a rules file to proofs about the C that is generated from it."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from dslkit.writing import write_texts
from rossmarie import ir
from rossmarie.driver.build import generate, write_generated
from rossmarie.driver.pipeline import Compiled, compile_file
from rossmarie.driver.sources import hashed_sources
from rossmarie.driver.workers import answers
from rossmarie.report.proofs import Proofs, parts_without_queries
from rossmarie.report.safety import EvidenceKind, evidence_text
from rossmarie.report.safety.evidence import Hashed
from rossmarie.report.safety.proved import bound_of, verification_results
from rossmarie.targets import c99
from rossmarie.verification.check import Check
from rossmarie.verification.harness import Harness, covered, harness
from rossmarie.verification.prover import ProofOutcome, ProofVerdict, Prover, ProverError
from rossmarie.verification.reactor_harness import reactor_harness


@dataclass(frozen=True)
class VerificationQueries:
    """The queries about a rules file: `programs`, each with its checks. `files` are the files that
    the queries are about.
    """

    compiled: Compiled
    files: Mapping[str, str]
    programs: tuple[Harness, ...]

    def texts(self) -> dict[str, str]:
        """All input of the prover, by name."""
        return {**self.files, **{f"{program.name}.c": program.text for program in self.programs}}


def queries_of(
    rules: Path,
    *,
    systems: Sequence[Path] = (),
    message_folders: Sequence[Path] = (),
    only: Sequence[ir.Category] = (),
) -> VerificationQueries:
    """The queries about the rules of a file. With `only`, they are about the rules of these
    categories.

    Raises `RulesError`.
    """
    compiled = compile_file(rules, systems=systems, message_folders=message_folders, only=only)
    files = generate(compiled.machine, c99.TARGET.name)
    origin = next(iter(files.values())).partition("\n")[0]
    programs = tuple(
        replace(program, text=f"{origin} */\n{program.text}")
        for program in _programs(compiled.machine)
    )
    return VerificationQueries(compiled, covered(files), programs)


def _programs(machine: ir.Machine) -> Iterator[Harness]:
    """One program for the monitor and, if rules have actions, one for the reactor."""
    yield harness(machine)
    if machine.reactions.tasks:
        yield reactor_harness(machine)


def keep(
    queries: VerificationQueries, folder: Path, rules: Path, *, replaces_others: bool = False
) -> list[Path]:
    """Write the prover's input files. Raises the errors of `build_files`."""
    return write_generated(queries.texts(), folder, rules, replaces_others=replaces_others)


def prove(
    queries: VerificationQueries,
    prover: Prover,
    *,
    seconds: int,
    on_progress: Callable[[float], None] = lambda _: None,
) -> Proofs:
    """Run all queries, each with a time limit in seconds per solver.

    Raises `ProverError` if the prover rejects the program.
    """
    checks = [(program, check) for program in queries.programs for check in program.checks]
    with prover.workshop() as folder:
        write_texts(folder, queries.files)
        for program in queries.programs:
            prover.compile(folder, program)
        ask = partial(_outcome, prover, folder, seconds)
        found = list(answers(ask, checks, on_progress))
    pairs = zip(checks, found, strict=True)
    return Proofs(
        machine=queries.compiled.machine,
        outcomes=tuple(outcome or _ended(check) for (_, check), outcome in pairs),
        unasked=tuple(_unasked(queries)),
        tools=prover.tools(),
    )


def _unasked(queries: VerificationQueries) -> Iterator[str]:
    """The sources that no program includes."""
    for name in queries.files:
        asked = any(f'"{name}"' in program.text for program in queries.programs)
        if name.endswith(".c") and not asked:
            yield name
    yield from parts_without_queries(queries.compiled.machine)


def _outcome(
    prover: Prover, folder: Path, seconds: int, asked: tuple[Harness, Check]
) -> ProofOutcome:
    program, check = asked
    try:
        return prover.run(program, check, folder, seconds)
    except ProverError as error:
        return ProofOutcome(
            check, ProofVerdict.UNDECIDED, (f"the prover fails: {complaint(error)}",)
        )


def _ended(check: Check) -> ProofOutcome:
    return ProofOutcome(
        check, ProofVerdict.UNDECIDED, ("the system ended the prover; memory may be short",)
    )


def complaint(error: ProverError) -> str:
    """The line with the reason in the output of the prover."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    reasons = [line for line in lines if re.search(r"\berror: |^Reason: ", line)]
    return (reasons or lines[-1:] or ["it printed no reason"])[0]


def verification_report(
    queries: VerificationQueries, proofs: Proofs, rules: Path, *, version: str
) -> str:
    """The report of `prove`, for a safety file."""
    return evidence_text(
        EvidenceKind.VERIFICATION,
        tools={"rossmarie": version, **proofs.tools},
        sources=hashed_sources(queries.compiled.sources, rules),
        outputs=[Hashed.of(name, text.encode()) for name, text in queries.texts().items()],
        bound=bound_of(proofs.machine),
        results=tuple(verification_results(proofs)),
    )
