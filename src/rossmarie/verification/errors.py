"""ROSS79x: the results of proofs about the generated C."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class PartRefuted(Error, code="ROSS790", name="part-refuted"):
    """A part of the generated C that does not implement the rules."""

    title = "refuted: {part}"
    label = "does not hold: {sentence}"
    note = "shown by `check_{check}` of the harness"
    help = (
        "this is a defect of this tool, in the C or in its specification: do not use the C, "
        "and please report it, with the rules and what `--keep DIR` writes"
    )
    part: str
    sentence: str
    check: str

    class NorDoes(Remark):
        says = "nor does: {sentence}"
        sentence: str


class NoProver(Error, code="ROSS791", name="no-prover"):
    """A system without a usable prover."""

    title = "nothing can be proved here: CBMC 6 or a solver of it is missing"
    label = "{reason}"
    note = "cbmc, cadical and z3 are packages of Debian 13"
    help = (
        "install these packages, use the Docker image debian:trixie, or on another Linux run "
        "`tools/setup_prover_debian.sh` of ROSSMARie's sources as root"
    )
    reason: str


class ProgramRefused(Error, code="ROSS792", name="program-refused"):
    """A program that CBMC does not translate."""

    title = "CBMC does not take the generated C"
    label = "{reason}"
    note = "nothing was asked, so nothing is proved"
    help = (
        "see that the headers of the C library are there (on Debian: libc6-dev); if they are, this "
        "is a defect of this tool: please report it, with the rules"
    )
    reason: str


ALL: tuple[type[Template], ...] = (PartRefuted, NoProver, ProgramRefused)
