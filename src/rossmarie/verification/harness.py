"""The program for CBMC: the unchanged generated C, its definitions, and the checks.

The input is a machine; the result is C text and the list of its checks. Each check begins in any
state that satisfies the invariants and calls one part of the generated code. Its obligations are
that the invariants are true again. This is one inductive step, so the proofs are unbounded. If a
part calls another part with its own check, the contract of the called part replaces it. The
contract states the facts that the check of the called part has proved.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from rossmarie.ir import model as ir
from rossmarie.ir.limits import MOST_EVALUATIONS
from rossmarie.verification.check import Check
from rossmarie.verification.contracts import CONTRACTS, NONDETERMINISM
from rossmarie.verification.definitions import Definitions
from rossmarie.verification.engine_checks import EngineChecks
from rossmarie.verification.events import Events
from rossmarie.verification.frames import FrameChecks
from rossmarie.verification.guard_checks import GuardChecks
from rossmarie.verification.invariants import Invariants, Sentence
from rossmarie.verification.layout import ProofLayout, layout_of
from rossmarie.verification.message_checks import ELEMENTS, MessageChecks
from rossmarie.verification.program import (
    PRELUDE,
    assertions,
    assumptions,
    obligation,
    predicate,
)
from rossmarie.verification.time_checks import TimeChecks

_UNCHECKED = """\
#pragma CPROVER check push
#pragma CPROVER check disable "bounds"
#pragma CPROVER check disable "pointer"
"""

_MODELS = """\
/* Models of the C library: each function is an arbitrary function of its arguments. */
double __CPROVER_uninterpreted_sqrt(double);
double __CPROVER_uninterpreted_middle(unsigned k, unsigned is_upper); /* of a window */
double __CPROVER_uninterpreted_total(unsigned k);
double sqrt(double x) { return isnan(x) ? NAN : __CPROVER_uninterpreted_sqrt(x); }
"""

_MOMENTS = {
    "looked": ("clock", "marks", "in_time", "quiet", "leaves", "ages", "recent", "swinging",
               "derived", "rules", "woken"),
    "at_rest": ("unmarked", "clock", "marks", "in_time", "quiet", "leaves", "ages", "recent",
                "swinging", "derived", "rules", "woken"),
}  # fmt: skip


@dataclass(frozen=True)
class Harness:
    """The text of the program beside the generated C, and its checks. `passes` is the most passes
    of any loop. `name` is the name of the file.
    """

    text: str
    checks: tuple[Check, ...]
    passes: int
    name: str = "harness"


def covered(files: Mapping[str, str]) -> dict[str, str]:
    """The generated files as the queries cover them. In them, the engine checks the guards of
    expired numbers before it stores a message. With numbers beside elements (S74), the engine
    checks these guards after it has stored the message. No query covers this order.
    """
    return {
        name: re.sub(r"^#define BESIDE \d+\n", "", text, flags=re.MULTILINE)
        for name, text in files.items()
    }


def harness(machine: ir.Machine) -> Harness:
    """All obligations about the monitor of a machine."""
    return _Writer(machine).harness()


class _Writer:
    """Writes the program of one machine."""

    def __init__(self, machine: ir.Machine) -> None:
        self._machine = machine
        self._layout: ProofLayout = layout_of(machine)
        self._definitions = Definitions(self._layout)
        self._invariants = Invariants(self._layout, self._definitions)
        self._groups = self._invariants.groups()

    def harness(self) -> Harness:
        frames = FrameChecks(self._layout, self._definitions)
        guards = GuardChecks(self._layout, self._definitions, self._invariants)
        messages = MessageChecks(self._layout, self._definitions, frames, guards.parts())
        written = [
            *EngineChecks(self._layout, self._definitions, frames, guards.parts()).written(),
            *TimeChecks(self._layout, frames, guards.parts()).written(),
            *guards.written(),
            *messages.written(),
        ]
        most_events = (MOST_EVALUATIONS + 1) * (len(self._machine.rules) + 1)
        parts = [
            PRELUDE,
            f'#include "{self._layout.name}_monitor.c"\n',
            _MODELS,
            _UNCHECKED,
            self._nondeterminism(),
            self._definitions.text(),
            frames.text(),
            Events(self._layout, self._definitions).text(),
            *self._predicates(),
            guards.text(),
            CONTRACTS.format(most_events=most_events, pending=self._pending()),
            messages.text(),
            *(each.text() for each in written),
        ]
        return Harness("\n".join(parts), tuple(each.check for each in written), self._passes())

    def _nondeterminism(self) -> str:
        small = self._layout.is_small
        return NONDETERMINISM.format(
            name=self._layout.name,
            rules=max(1, len(self._machine.rules)),
            word="m->dirty" if small else "m->dirty[node / 64]",
            pending="" if small else "    m.pending = nondet_number() % 2 != 0;\n",
        )

    def _pending(self) -> str:
        """The obligation that a flag is set while marks exist, if there are too many marks for one
        word.
        """
        if self._layout.is_small:
            return ""
        return obligation("m->pending", "`pending` is set while nodes are evaluated") + "\n"

    def _passes(self) -> int:
        """The most passes of any loop. Loops run over the parts of a machine, or over marked
        nodes.
        """
        layout = self._layout
        limits = sum(guard.limit_count + 2 for guard in layout.guards)
        nodes = layout.proposition_count + len(self._machine.rules)
        return max(nodes, len(layout.values), limits, ELEMENTS) + 2

    # --- predicates --------------------------------------------------------------------------

    def _predicates(self) -> Iterator[str]:
        """Each predicate twice: as an assumption, and as an obligation."""
        for word, write in (("suppose", assumptions), ("must_be", assertions)):
            for name, sentences in self._groups.items():
                yield predicate(f"static void {word}_{name}", write(sentences))
            for name, groups in self._moments().items():
                lines = "\n".join(f"    {word}_{group}(m, t_ns);" for group in groups)
                yield predicate(f"static void {word}_{name}", lines)
            yield predicate(f"static void {word}_unlooked", self._unlooked(word, write))
            yield predicate(f"static void {word}_restarted", write(self._restarted()))

    def _moments(self) -> dict[str, tuple[str, ...]]:
        return {"leaves": (*self._invariants.guards(), "literals"), **_MOMENTS}

    def _unlooked(self, word: str, write: Callable[[Sequence[Sentence]], str]) -> str:
        """The sentences that hold before timers are handled: propositions are still as right as at
        the last evaluation, and no timer has been due since.
        """
        groups = ("clock", "marks", "just_in_time", "leaves", "recent", "rules", "ahead", "woken")
        lines = [f"    {word}_{group}(m, t_ns);" for group in groups]
        lines.append(f"    {word}_derived(m, m->now_ns);")
        return "\n".join([*lines, write(_reported(self._invariants, self._layout))])

    def _restarted(self) -> list[Sentence]:
        """The sentences after a restart: all computed propositions and rules are marked; inputs are
        kept.
        """
        marked = range(
            self._layout.leaf_count, self._layout.proposition_count + len(self._machine.rules)
        )
        return [
            *(Sentence("each computed node is marked", self._invariants.marked(n)) for n in marked),
            Sentence("the clock is set", "m->now_ns == t_ns && m->wake_ns == t_ns"),
            *(Sentence("no duration has begun", f"m->held_due_ns[{k}] == NEVER")
              for k in range(len(self._layout.held))),
            *(Sentence("no channel is quiet", f"!m->quiet[{c}]")
              for c in range(len(self._machine.channels))),
            *(Sentence("ages are not yet tested", f"{self._definitions.proposition(age)} == UNSET")
              for age in self._layout.ages),
        ]  # fmt: skip


def _reported(invariants: Invariants, layout: ProofLayout) -> list[Sentence]:
    """Each reported proposition about an oscillation was right at the last evaluation, or it is
    marked.
    """
    found = []
    for k, proposition in enumerate(layout.oscillations):
        reported = invariants.reported(k).replace("t_ns -", "m->now_ns -")
        marked = invariants.marked(layout.node_of_proposition[proposition])
        found.append(
            Sentence("the reported value of an oscillation was right", f"({marked} || {reported})")
        )
    return found
