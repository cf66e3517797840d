"""Proposed traces for the goals of a rule. The interpreter judges them.

For each leaf: values at, just under and just over its threshold, while the whole condition depends
on the leaf. For each `for` and each age: a hold that is one step too short, then a full hold. For
each input with a timeout: silence. If a `since` has to be true, the trace that begins it comes
first.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import z3

from rossmarie import ir
from rossmarie.ir.script import Script
from rossmarie.testing.before import wanted_before
from rossmarie.testing.goals import (
    ComparisonEdge,
    atoms,
    deadline_step_ns,
    decisions,
    edges,
    losable_inputs,
    stays,
)
from rossmarie.testing.phases import Phase, PhaseSearch, beat_ns, delay_ns, ramp_of, round_up
from rossmarie.testing.sides import beside
from rossmarie.testing.solve import RuleFormulas
from rossmarie.testing.variables import Values
from rossmarie.testing.whole import is_carried

_MOST_BEATS = 20_000
_LONGEST_NAME = 90
_MOST_BEFORE = 3  # the most phases that lead to another phase


@dataclass(frozen=True)
class ProposedScript:
    """A script for the goals of one rule."""

    rule: int
    script: Script


def propose(machine: ir.Machine, rules: Sequence[int] | None = None) -> Iterator[ProposedScript]:
    """Proposals for all rules, or for the rules with these numbers, in this order. Their messages
    can exist, and they are no longer than tests may be.
    """
    for index in range(len(machine.rules)) if rules is None else rules:
        for proposal in _Proposer(machine, index).all():
            if proposal.script.can_be_written and is_carried(machine, proposal.script):
                yield proposal


class _Proposer:
    """Makes the proposals for one rule."""

    def __init__(self, machine: ir.Machine, index: int) -> None:
        self._machine = machine
        self._index = index
        self._rule = machine.rules[index]
        self._roots = self._rule.roots
        leaves = {leaf for root in self._roots for leaf in ir.leaf_propositions(machine, root)}
        self._leaves = sorted(leaves)
        below = {each for root in self._roots for each in ir.reachable_propositions(machine, root)}
        nodes = (machine.propositions[each].node for each in sorted(below))
        self._counted = tuple(node.operand for node in nodes if isinstance(node, ir.Recurs))
        self._beat_ns = beat_ns(machine, self._rule)
        ramp = ramp_of(machine, index, self._beat_ns)
        self._world = RuleFormulas(machine, self._leaves, ramp=ramp)
        self._stage = PhaseSearch(self._world, machine, index, self._beat_ns, ramp)
        settled_ns = max(
            delay_ns(machine, root, value=value) for root in self._roots for value in (True, False)
        )
        self._hold_ns = round_up(settled_ns + 4 * self._beat_ns, self._beat_ns)
        self._condition = self._world.formula(self._rule.condition)

    def all(self) -> Iterator[ProposedScript]:
        """All proposals; none if the rule cannot be inactive, or if a trace takes too long."""
        if self._hold_ns > _MOST_BEATS * self._beat_ns:
            return
        calm = self._calm()
        if calm is None:
            return
        for leaf in self._leaves:
            yield from self._leaf(leaf, calm)
        for decision in decisions(self._machine, self._rule):
            for atom in atoms(self._machine, decision):
                node = self._machine.propositions[atom].node
                if isinstance(node, ir.Recurs):
                    yield from self._recurs(atom, node, decision, calm)
                else:
                    yield from self._held(atom, decision, calm)
        for used in losable_inputs(self._machine, self._rule):
            yield from self._silence(used)

    def _calm(self) -> Values | None:
        over = z3.Not(self._condition)
        release = [self._world.formula(root) for root in self._roots[1:]]
        return self._world.solve([over, *release]) or self._world.solve([over])

    def _hangs_on(self, proposition: int, decision: int | None = None) -> z3.BoolRef:
        """A formula: the value of a proposition decides whether the rule is cleared or
        activated.
        """
        roots = (*self._roots, *self._counted) if decision is None else (decision,)
        disjuncts = []
        for root in roots:
            true, false = (
                self._world.formula(root, {proposition: value}) for value in (True, False)
            )
            disjuncts.append(true != false)
        if decision is None and len(self._roots) > 1:
            # A release counts while the rule's condition is false.
            disjuncts[1] = z3.And(disjuncts[1], z3.Not(self._condition))
        return z3.Or(disjuncts)

    # --- leaves ------------------------------------------------------------------------------

    def _leaf(self, leaf: int, calm: Values) -> Iterator[ProposedScript]:
        node = self._machine.propositions[leaf].node
        hangs = self._hangs_on(leaf)
        if isinstance(node, ir.AgeReaches):
            yield from self._age(leaf, node, hangs)
            return
        found = edges(self._machine, leaf)
        for edge in found:
            yield from self._edge(leaf, edge, hangs, calm)
        if not found:
            formula = self._world.formula(leaf)
            true = self._world.solve([hangs, formula], calm, leaf)
            false = self._world.solve([hangs, z3.Not(formula)], true or calm, leaf)
            yield from self._made(leaf, self._text(leaf), calm, [true, false, true])

    def _edge(
        self, leaf: int, edge: ComparisonEdge, hangs: z3.BoolRef, calm: Values
    ) -> Iterator[ProposedScript]:
        is_array = isinstance(self._machine.propositions[leaf].node, ir.Quantified)
        term = self._world.signal(edge.signal, 0 if is_array else None)
        near, found = calm, []
        for side in (-1, 0, 1):
            formulas = beside(self._machine, edge, term, side)
            tried = (self._world.solve([hangs, one], near, leaf) for one in formulas)
            values = next((each for each in tried if each is not None), None)
            near = values or near
            found.append(values)
        shown = self._machine.signals[edge.constant]
        number = edge.threshold * shown.scale + shown.offset
        around = f"{number:.9g} {shown.unit}".strip()
        yield from self._made(leaf, f"{self._text(leaf)}, around {around}", calm, found)

    def _age(self, leaf: int, node: ir.AgeReaches, hangs: z3.BoolRef) -> Iterator[ProposedScript]:
        formula = self._world.formula(leaf)
        old = self._world.solve([hangs, formula])
        young = self._world.solve([hangs, z3.Not(formula)], old)
        if old is None or young is None:
            return
        silent = frozenset({self._machine.inputs[node.input].channel})
        step_ns = deadline_step_ns(node.age_ns)
        short_ns = (node.age_ns // step_ns - 1) * step_ns  # `> d` is reached at d + 1 ns (S31)
        phases = [
            self._phase(young, self._hold_ns),
            self._phase(young, short_ns, silent),
            self._phase(young, self._hold_ns),
            self._phase(old, self._hold_ns),
            self._phase(young, self._hold_ns),
        ]
        yield self._proposal(self._text(leaf), phases)

    # --- durations ---------------------------------------------------------------------------

    def _held(self, atom: int, decision: int, calm: Values) -> Iterator[ProposedScript]:
        held = ir.held_of(self._machine, atom)
        node = None if held is None else self._machine.propositions[held].node
        if held is None or not isinstance(node, ir.Held):
            return
        formula = self._world.formula(node.operand)
        hangs = self._hangs_on(held, decision)
        on = self._world.solve([formula, hangs], calm)
        if on is None:
            return
        off = self._world.solve([z3.Not(formula), hangs], on)
        off = off or self._world.solve([z3.Not(formula)], on)
        if off is None:
            return
        inner_ns = delay_ns(self._machine, node.operand)
        outer_ns = delay_ns(self._machine, node.operand, value=False)
        step_ns = deadline_step_ns(node.duration_ns)
        short_ns = inner_ns + node.duration_ns - step_ns - outer_ns
        if short_ns <= 0:  # the operand takes longer to become false than it may stay true
            short_ns = self._hold_ns
        lengths = (self._hold_ns, short_ns, self._hold_ns, self._hold_ns, self._hold_ns)
        phases = [
            self._phase(values, length_ns)
            for values, length_ns in zip((off, on, off, on, off), lengths, strict=True)
        ]
        yield self._proposal(self._text(atom), phases)

    # --- counts of edges -------------------------------------------------------------------

    def _recurs(
        self, recurs: int, node: ir.Recurs, decision: int, calm: Values
    ) -> Iterator[ProposedScript]:
        """The condition with counted edges alternates as often as required, as fast as it can."""
        formula = self._world.formula(node.operand)
        hangs = self._hangs_on(recurs, decision)
        on = self._world.solve([formula, hangs], calm)
        off = None if on is None else self._world.solve([z3.Not(formula), hangs], on)
        if on is None or off is None:
            return
        times = [delay_ns(self._machine, node.operand, value=value) for value in (True, False)]
        on_ns, off_ns = (round_up(time_ns + self._beat_ns, self._beat_ns) for time_ns in times)
        if (node.count - 1) * (on_ns + off_ns) >= node.window_ns:
            return
        often = [(on, on_ns), (off, off_ns)] * node.count
        phases = [(off, self._hold_ns), *often, (off, self._hold_ns)]
        yield self._proposal(self._text(recurs), [self._phase(*each) for each in phases])

    # --- stale inputs -------------------------------------------------------------------------

    def _silence(self, used: int) -> Iterator[ProposedScript]:
        declared = self._machine.inputs[used]
        assert declared.timeout_ns is not None
        rests_on = ir.supports(self._machine).propositions
        for leaf in ir.leaf_propositions(self._machine, self._rule.condition):
            if used not in rests_on[leaf].inputs:
                continue
            hangs = self._hangs_on(leaf, self._rule.condition)
            values = self._world.solve([hangs, z3.Not(self._condition)])
            if values is None:
                continue
            silent = frozenset({declared.channel})
            if stays(declared):
                phases = [self._phase(values, self._hold_ns, silent)]
                phases.append(self._phase(values, self._hold_ns))
                yield self._proposal(f"{declared.name} has not come yet", phases)
                return
            length_ns = round_up(declared.timeout_ns + self._hold_ns, self._beat_ns)
            phases = [
                self._phase(values, self._hold_ns),
                self._phase(values, length_ns, silent),
                self._phase(values, self._hold_ns),
            ]
            yield self._proposal(f"{declared.name} falls silent", phases)
            return

    # --- names -------------------------------------------------------------------------------

    def _made(
        self, leaf: int, name: str, calm: Values, values: Sequence[Values | None]
    ) -> Iterator[ProposedScript]:
        """A calm phase, then phases with the values, then a calm phase. If the rule has a release
        of its own, another phase comes before each value: a calm phase, or a phase that activates
        the rule if the leaf belongs to the release.
        """
        known = [each for each in values if each is not None]
        if not known:
            return
        phases = [calm, *known, calm]
        if self._has_own_release():
            fire = self._world.solve([self._condition], calm)
            is_of_condition = leaf in ir.leaf_propositions(self._machine, self._rule.condition)
            between = calm if is_of_condition or fire is None else fire
            phases = [calm, *(each for value in known for each in (between, value)), calm]
        yield self._proposal(name, [self._phase(each, self._hold_ns) for each in phases])

    def _has_own_release(self) -> bool:
        """Say whether the rule's release contains a leaf that its condition does not contain."""
        condition = ir.leaf_propositions(self._machine, self._rule.condition)
        return any(leaf not in condition for leaf in self._leaves)

    def _phase(self, values: Values, length_ns: int, silent: frozenset[int] = frozenset()) -> Phase:
        """A phase in which the inputs that have to be old are silent, for long enough."""
        old = {each.index for each, value in values.items() if each.kind == "aged" and value}
        ages_ns = [
            node.age_ns
            for node in (self._machine.propositions[leaf].node for leaf in self._leaves)
            if isinstance(node, ir.AgeReaches) and node.input in old
        ]
        if ages_ns:
            least_ns = max(ages_ns) + self._hold_ns
            length_ns = max(length_ns, round_up(least_ns, self._beat_ns))
        channels = {self._machine.inputs[used].channel for used in old}
        return Phase(values, length_ns, silent | channels)

    def _proposal(self, name: str, phases: Sequence[Phase]) -> ProposedScript:
        cleaned = f"{self._rule.name}: {name}".replace('"', "'")
        led = [each for phase in phases for each in self._led_to(phase)]
        return ProposedScript(self._index, self._stage.script(cleaned, led))

    def _led_to(self, phase: Phase) -> list[Phase]:
        """A phase, preceded by the phases that give each `since` the value that the phase
        requires.
        """
        phases = [phase]
        while len(phases) <= _MOST_BEFORE:
            wanted = wanted_before(self._world, phases[0].values)
            values = self._world.solve(wanted, phases[0].values) if wanted else None
            if values is None:
                break
            phases.insert(0, self._phase(values, self._hold_ns))
        return phases

    def _text(self, proposition: int) -> str:
        found = self._machine.propositions[proposition]
        text = " ".join(found.text.split())
        named = f"{found.name} ({text})" if found.name else text
        return named if len(named) <= _LONGEST_NAME else f"{named[: _LONGEST_NAME - 3]}..."
