"""Proves the generated C of the examples, and writes the page of proofs and their cost.

Examples that are named are proved; the page keeps the rows of the others. With `--library` the
examples are the files of the library. A row says by a digest of which sources it is. The exit code
is 1 if a query is not proved.
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
from rossmarie.verification.prover import PROGRAMS, Prover, Verdict

ROOT = Path(__file__).parents[1]
SECONDS = 120


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
    """Ask all queries about one rules file."""
    queries = queries_of(ROOT / example)
    before = processor_seconds()
    proofs = prove(queries, prover, seconds=SECONDS)
    minutes = (processor_seconds() - before) / 60
    verdicts = Counter(outcome.verdict for outcome in proofs.outcomes)
    cells = [
        link(example),
        len(queries.compiled.machine.rules),
        len(proofs.outcomes),
        verdicts[Verdict.PROVED],
        verdicts[Verdict.UNDECIDED],
        verdicts[Verdict.REFUTED],
        f"{minutes:.0f}",
        digest(example),
    ]
    unproved = (
        f"- {link(example)}: {outcome.check.about}"
        for outcome in proofs.outcomes
        if outcome.verdict is not Verdict.PROVED
    )
    return Proved("| " + " | ".join(map(str, cells)) + " |", tuple(unproved))


def digest(example: str) -> str:
    """The beginning of the SHA-256 of a rules file without its comments and documentation."""
    text = (ROOT / example).read_text(encoding="utf-8")
    rules = re.sub(r"'''.*?'''|//[^\n]*", "", text, flags=re.DOTALL)
    return f"`{hashlib.sha256(' '.join(rules.split()).encode()).hexdigest()[:12]}`"


def link(example: str) -> str:
    """The name of a rules file on the page, as a link."""
    return f"[{Path(example).name}](../../{example})"


def written(page: str, examples: Iterable[str]) -> dict[str, Proved]:
    """Those of the examples that a page has, each with its rows."""
    found = {}
    for example in examples:
        named = re.escape(link(example))
        rows = re.findall(rf"^\| {named} .*$", page, re.MULTILINE)
        unproved = re.findall(rf"^- {named}: .*$", page, re.MULTILINE)
        if rows:
            found[example] = Proved(rows[0], tuple(unproved))
    return found


def page(prover: Prover, known: Iterable[Proved], of: str) -> str:
    """The whole page about examples, which are `of` something."""
    known = list(known)
    tools = ", ".join(f"{tool} {prover.version(tool)}" for tool in PROGRAMS)
    unproved = [line for each in known for line in each.unproved]
    return "\n".join(
        [
            "# What proofs cost",
            "",
            f"Written by `benchmarks/proofs.py`; do not edit. `rossmarie verify` on {of}, by",
            f"{tools}, on {processor()}.",
            f"No solver was given more than {SECONDS} seconds of a processor for one query.",
            "",
            "| Rules file | Rules | Queries | Proved | Undecided | Refuted | Processor minutes "
            "| Sources |",
            "|---|---|---|---|---|---|---|---|",
            *(each.row for each in known),
            *(["", "Not proved:", ""] if unproved else []),
            *unproved,
            "",
        ]
    )


def main() -> int:
    """Prove, and write the page after each example."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, required=True, help="the page to write")
    parser.add_argument("--library", action="store_true", help="prove files of the library")
    parser.add_argument("examples", nargs="*", metavar="EXAMPLE", help="one of the rules files")
    arguments = parser.parse_args()
    examples = LIBRARY if arguments.library else EXAMPLES
    if unknown := {*arguments.examples} - {*examples}:
        parser.error(f"no example: {', '.join(unknown)}; there are {', '.join(examples)}")
    out: Path = arguments.out
    known = written(out.read_text(encoding="utf-8"), examples) if out.is_file() else {}
    wanted = arguments.examples or examples
    of = "files of [the library](library.md)" if arguments.library else "examples"
    prover = Prover()
    if reason := prover.lacking():
        parser.error(f"{reason}; `make prover` sets it up")
    for example in wanted:
        known[example] = proved(prover, example)
        rows = (known[each] for each in examples if each in known)
        out.write_text(page(prover, rows, of), encoding="utf-8")
    return int(any(known[example].unproved for example in wanted))


if __name__ == "__main__":
    sys.exit(main())
