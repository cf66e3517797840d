"""Prove the generated C of the examples, and write the page about the cost of the proofs.

If the command line names examples, only these examples are proved, and the page keeps the rows of
the other examples. With `--library`, the examples are the files of the library. Each row has a
digest of its rules file. The exit code is 1 if a query is not proved.
"""

from __future__ import annotations

import argparse
import hashlib
import re
import resource
import sys
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from machine import processor
from proved_examples import EXAMPLES, LIBRARY

from rossmarie.driver.verifying import prove, queries_of
from rossmarie.verification.prover import ProofVerdict, Prover

ROOT = Path(__file__).parents[1]
SECONDS = 120
SUBJECTS = {"examples": "the examples", "library": "the files of [the library](library.md)"}
"""The subjects of the pages, by the names of the pages."""


def processor_seconds() -> float:
    """The CPU seconds of all child processes so far."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


@dataclass(frozen=True)
class Proved:
    """The row of one rules file, and a line for each query that is not proved."""

    row: str
    unproved: tuple[str, ...]


def proved(prover: Prover, example: str) -> Proved:
    """Run all queries about one rules file."""
    queries = queries_of(ROOT / example)
    before = processor_seconds()
    proofs = prove(queries, prover, seconds=SECONDS)
    minutes = (processor_seconds() - before) / 60
    verdicts = Counter(outcome.verdict for outcome in proofs.outcomes)
    cells = [
        link(example),
        len(queries.compiled.machine.rules),
        len(proofs.outcomes),
        verdicts[ProofVerdict.PROVED],
        verdicts[ProofVerdict.UNDECIDED],
        verdicts[ProofVerdict.REFUTED],
        f"{minutes:.0f}",
        digest(example),
    ]
    unproved = (
        f"- {link(example)}: {outcome.check.about}"
        for outcome in proofs.outcomes
        if outcome.verdict is not ProofVerdict.PROVED
    )
    return Proved("| " + " | ".join(map(str, cells)) + " |", tuple(unproved))


def digest(example: str) -> str:
    """The beginning of the SHA-256 of a rules file without its comments, its documentation and the
    texts of its hazards.
    """
    text = (ROOT / example).read_text(encoding="utf-8")
    rules = re.sub(r"'''.*?'''|//[^\n]*", "", text, flags=re.DOTALL)
    rules = re.sub(r'(hazard \w+) "[^"]*"', r"\1", rules)
    return f"`{hashlib.sha256(' '.join(rules.split()).encode()).hexdigest()[:12]}`"


def link(example: str) -> str:
    """The name of a rules file on the page, as a link."""
    return f"[{Path(example).name}](../../{example})"


def written(page: str, examples: Iterable[str]) -> dict[str, Proved]:
    """The examples that a page already contains, each with its row and its lines."""
    found = {}
    for example in examples:
        named = re.escape(link(example))
        rows = re.findall(rf"^\| {named} .*$", page, re.MULTILINE)
        unproved = re.findall(rf"^- {named}: .*$", page, re.MULTILINE)
        if rows:
            found[example] = Proved(rows[0], tuple(unproved))
    return found


PREFACE = """\
# Cost of proofs: {name}

Written by `benchmarks/proofs.py`; do not edit. `rossmarie verify` proves the generated C of
{subject} with {tools}, on {processor}.
Each solver has at most {seconds} seconds of CPU time for each query. The digest identifies the
rules that were proved.

| Rules file | Rules | Queries | Proved | Undecided | Refuted | CPU minutes | Digest |
|---|---|---|---|---|---|---|---|"""


def page(prover: Prover, known: Iterable[Proved], name: str) -> str:
    """The text of the page with this name."""
    known = list(known)
    preface = PREFACE.format(
        name=name,
        subject=SUBJECTS[name],
        tools=", ".join(f"{tool} {version}" for tool, version in prover.tools().items()),
        processor=processor(),
        seconds=SECONDS,
    )
    unproved = [line for each in known for line in each.unproved]
    heading = ["", "Not proved:", ""] if unproved else []
    return "\n".join([preface, *(each.row for each in known), *heading, *unproved, ""])


def main() -> int:
    """Prove the examples, and write the page after each example."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, required=True, help="the page to write")
    parser.add_argument("--library", action="store_true", help="prove the files of the library")
    parser.add_argument(
        "examples",
        nargs="*",
        metavar="EXAMPLE",
        help="a rules file to prove; all rules files without this argument",
    )
    arguments = parser.parse_args()
    examples = LIBRARY if arguments.library else EXAMPLES
    if unknown := {*arguments.examples} - {*examples}:
        parser.error(f"unknown examples: {', '.join(unknown)}; choose from {', '.join(examples)}")
    out: Path = arguments.out
    known = written(out.read_text(encoding="utf-8"), examples) if out.is_file() else {}
    wanted = arguments.examples or examples
    name = "library" if arguments.library else "examples"
    prover = Prover()
    if reason := prover.lacking():
        parser.error(f"{reason}; run `make prover` to install the prover")
    for example in wanted:
        known[example] = proved(prover, example)
        rows = (known[each] for each in examples if each in known)
        out.write_text(page(prover, rows, name), encoding="utf-8")
    return int(any(known[example].unproved for example in wanted))


if __name__ == "__main__":
    sys.exit(main())
