"""What it costs to prove the generated C of the examples, and what is proved: writes the page."""

from __future__ import annotations

import resource
from collections import Counter
from pathlib import Path

from machine import processor
from written_page import written_page

from rossmarie.driver.verifying import prove, questions_of
from rossmarie.verification.prover import PROGRAMS, Prover, Verdict
from rossmarie.verification.setup import provide_prover

ROOT = Path(__file__).parents[1]
EXAMPLES = (
    "examples/thesis/mobile_base.ross",
    "examples/thesis/arm.ross",
    "examples/thesis/peg_in_hole.ross",
    "examples/husky/husky.ross",
    "examples/demo/demo.ross",
)
SECONDS = 120


def processor_seconds() -> float:
    """What all programs that have run so far have used."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def row(prover: Prover, example: str) -> tuple[str, list[str]]:
    """What comes of one rules file, and a line for each question that is not proved."""
    questions = questions_of(ROOT / example)
    before = processor_seconds()
    proofs = prove(questions, prover, seconds=SECONDS)
    minutes = (processor_seconds() - before) / 60
    verdicts = Counter(outcome.verdict for outcome in proofs.outcomes)
    cells = [
        f"[{Path(example).name}](../../{example})",
        len(questions.compiled.machine.rules),
        len(proofs.outcomes),
        verdicts[Verdict.PROVED],
        verdicts[Verdict.UNDECIDED],
        verdicts[Verdict.REFUTED],
        f"{minutes:.0f}",
    ]
    unproved = [
        f"- {Path(example).name}: {outcome.check.about}"
        for outcome in proofs.outcomes
        if outcome.verdict is not Verdict.PROVED
    ]
    return "| " + " | ".join(map(str, cells)) + " |", unproved


def page() -> str:
    """The whole page."""
    prover = provide_prover(print)
    tools = ", ".join(f"{tool} {prover.version(tool)}" for tool in PROGRAMS)
    rows = [row(prover, example) for example in EXAMPLES]
    unproved = [line for _, lines in rows for line in lines]
    return "\n".join(
        [
            "# What proofs cost",
            "",
            "Written by `benchmarks/proofs.py`; do not edit. `rossmarie verify` on examples, by",
            f"{tools}, on {processor()}.",
            f"No solver was given more than {SECONDS} seconds of a processor for one question.",
            "",
            "| Rules file | Rules | Questions | Proved | Undecided | Refuted | Processor minutes |",
            "|---|---|---|---|---|---|---|",
            *(line for line, _ in rows),
            *(["", "Not proved:", ""] if unproved else []),
            *unproved,
            "",
        ]
    )


def main() -> None:
    """Write the page."""
    written_page(__doc__).write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
