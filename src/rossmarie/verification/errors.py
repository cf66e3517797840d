"""ROSS79x: the results of proofs about the generated C."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class PartRefuted(Error, code="ROSS790", name="part-refuted"):
    """A part of the generated C that does not implement the rules."""

    title = "refuted: {part}"
    label = "does not hold: {sentence}"
    note = "`check_{check}` of the harness fails"
    help = (
        "this is a defect of ROSSMARie, in the C or in its specification: do not use the C, and "
        "please report the defect, with the rules and the files that `--keep DIR` writes"
    )
    part: str
    sentence: str
    check: str

    class NorDoes(Remark):
        says = "does not hold either: {sentence}"
        sentence: str


class NoProver(Error, code="ROSS791", name="no-prover"):
    """A system without a usable prover."""

    title = "cannot prove anything: CBMC 6 or one of its solvers is missing"
    label = "{reason}"
    note = "Debian 13 has the packages cbmc, cadical and z3"
    help = (
        "install these packages, use the Docker image debian:trixie, or on another Linux run "
        "`tools/setup_prover_debian.sh` of ROSSMARie's sources as root"
    )
    reason: str


class ProgramRefused(Error, code="ROSS792", name="program-refused"):
    """A program that CBMC does not translate."""

    title = "CBMC does not accept the generated C"
    label = "{reason}"
    note = "no query reached a solver, so nothing is proved"
    help = (
        "check that the headers of the C library are installed (on Debian: libc6-dev); if they "
        "are, this is a defect of ROSSMARie: please report the defect, with the rules"
    )
    reason: str


ALL: tuple[type[Template], ...] = (PartRefuted, NoProver, ProgramRefused)
