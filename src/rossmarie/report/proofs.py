"""The proofs about the generated C: as a model, as findings, and as a table for readers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TextIO

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from dslkit.diagnostics import Diagnostic
from dslkit.source import Span
from rossmarie import ir
from rossmarie.core import sampling_row
from rossmarie.report.coverage import print_table
from rossmarie.verification.check import Check
from rossmarie.verification.errors import PartRefuted
from rossmarie.verification.prover import ProofOutcome, ProofVerdict

_MESSAGES = "messages"
_GROUPS = {
    "visit": "rules and conditions",
    "numbers": _MESSAGES,
    "update": _MESSAGES,
    "step": _MESSAGES,
    "reactor": "actions and commands",
}
_OTHERS = "evaluation, timers, calls"


@dataclass(frozen=True)
class Proofs:
    """The outcomes of all queries about the C of a machine. `unasked` are the generated sources, or
    parts of them, without any query. `tools` are the versions of the programs that answered.
    """

    machine: ir.Machine
    outcomes: tuple[ProofOutcome, ...]
    unasked: tuple[str, ...]
    tools: Mapping[str, str]

    @property
    def rules(self) -> tuple[str, ...]:
        """The names of the rules."""
        return tuple(rule.name for rule in self.machine.rules)

    @property
    def is_inductive(self) -> bool:
        """Say whether the proofs cover runs of any length. Each step begins in a state that another
        step may have left, so all steps have to be proved.
        """
        is_proved = all(outcome.verdict is ProofVerdict.PROVED for outcome in self.outcomes)
        return is_proved and not parts_without_queries(self.machine)

    @property
    def is_complete(self) -> bool:
        """Say whether everything is proved."""
        return self.is_inductive and not self.unasked

    def having(self, verdict: ProofVerdict) -> tuple[ProofOutcome, ...]:
        """The outcomes with this verdict."""
        return tuple(outcome for outcome in self.outcomes if outcome.verdict is verdict)

    def reasons(self, outcome: ProofOutcome) -> tuple[str, ...]:
        """The reasons of an outcome, each once."""
        return tuple(dict.fromkeys(outcome.reasons))


def refutations(proofs: Proofs, file: Span) -> Iterator[Diagnostic]:
    """A finding for each refuted part, at its place in the rules, or at `file`."""
    for outcome in proofs.having(ProofVerdict.REFUTED):
        first, *others = proofs.reasons(outcome) or ("its obligation",)
        finding = PartRefuted(part=outcome.check.about, sentence=first, check=outcome.check.name)
        places = (_place(proofs.machine, words) for words in (first, outcome.check.about))
        span = next((place for place in places if place is not None), file)
        yield finding.at(span, notes=[finding.NorDoes(sentence=other) for other in others])


def _place(machine: ir.Machine, words: str) -> Span | None:
    """The place of the rule, condition, number or topic that the words name."""
    for rule in machine.rules:
        if f"rule {rule.name} " in f"{words} ":
            return rule.head
    said = [
        *((proposition.text, proposition.span) for proposition in machine.propositions),
        *((signal.text, signal.span) for signal in machine.signals),
    ]
    for text, span in said:
        if f"`{text}`" in words:
            return span
    for used in machine.inputs:
        if machine.channels[used.channel].topic in words.split():
            return used.span
    return None


def parts_without_queries(machine: ir.Machine) -> tuple[str, ...]:
    """The operations of the generated C that no query covers."""
    nodes = (signal.node for signal in machine.signals)
    parts = (
        (
            "samples of windows",
            any(isinstance(n, ir.Sampled) and sampling_row(n.function).has_window for n in nodes),
        ),
        (
            "messages at the instant at which a number beside elements expires",
            bool(ir.beside(machine)),
        ),
    )
    return tuple(part for part, is_present in parts if is_present)


# --- the table -------------------------------------------------------------------------------


def write_proofs(proofs: Proofs, out: TextIO) -> None:
    """Write the number of answered queries of each group, the unproved parts with reasons, the
    rules for which the proof is unbounded, and the verdict.
    """
    print_table(_table(proofs, styled=Console(file=out).is_terminal), out)
    out.write("".join(f"{line}\n" for line in _conclusion(proofs)))


def _table(proofs: Proofs, *, styled: bool) -> Table:
    table = Table(box=SIMPLE_HEAD if styled else None, pad_edge=False, header_style="bold")
    table.add_column("Part of the generated C", overflow="fold", min_width=20)
    table.add_column("Proved", justify="right", no_wrap=True)
    table.add_column("Not proved", overflow="fold")
    groups: dict[str, list[ProofOutcome]] = {}
    for outcome in proofs.outcomes:
        groups.setdefault(_group(outcome.check), []).append(outcome)
    for name, outcomes in groups.items():
        table.add_row(*map(Text, (name, _counts(outcomes), _left(outcomes))))
    for name in proofs.unasked:
        table.add_row(*map(Text, (name, "", "no query covers this part")))
    return table


def _group(check: Check) -> str:
    return _GROUPS.get(check.name.partition("_")[0], _OTHERS)


def _counts(outcomes: Sequence[ProofOutcome]) -> str:
    proved = sum(outcome.verdict is ProofVerdict.PROVED for outcome in outcomes)
    return f"{proved}/{len(outcomes)}"


def _left(outcomes: Sequence[ProofOutcome]) -> str:
    return "; ".join(
        f"{outcome.verdict.value}: {outcome.check.about}"
        for outcome in outcomes
        if outcome.verdict is not ProofVerdict.PROVED
    )


def _conclusion(proofs: Proofs) -> Iterator[str]:
    """Describe the open parts, with the reasons, and the overall result."""
    for outcome in proofs.having(ProofVerdict.UNDECIDED):
        for reason in proofs.reasons(outcome):
            yield f"undecided: {outcome.check.about}: {reason}"
    yield ""
    if proofs.rules:
        whom = (
            ", ".join(proofs.rules)
            if proofs.is_inductive
            else "no rule, because this needs the proofs of all parts"
        )
        yield f"For runs of any length: {whom}"
    counts = [
        f"{len(found)} {verdict.value}"
        for verdict in ProofVerdict
        if (found := proofs.having(verdict))
    ]
    counts += [f"{len(proofs.unasked)} not asked about"] if proofs.unasked else []
    with_what = ", ".join(f"{tool} {its}" for tool, its in proofs.tools.items())
    verdict = "Proved" if proofs.is_complete else "NOT proved"
    yield f"{verdict}: the generated C implements the rules ({', '.join(counts)}; {with_what})"
