"""Coverage of the rules of a machine by traces: the goals that the traces reach.

Every evaluation of the interpreter counts, including those at timers between messages.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from rossmarie import ir
from rossmarie.interpreter import Interpreter
from rossmarie.ir import InputState, TruthValue, kleene
from rossmarie.ir.script import Script
from rossmarie.testing.goals import (
    Aspect,
    ComparisonEdge,
    TraceGoal,
    atoms,
    deadline_ns,
    deadline_step_ns,
    decisions,
    edges,
    goals,
    stays,
)
from rossmarie.testing.history import History, HistoryRecorder
from rossmarie.testing.play import InstantEvents, steps_of

_ROUNDING = 1.000001


@dataclass(frozen=True)
class Coverage:
    """The goals of a machine in their order, and the reached goals."""

    machine: ir.Machine
    goals: tuple[TraceGoal, ...]
    reached: frozenset[TraceGoal]


def cover(machine: ir.Machine, scripts: Iterable[Script]) -> Coverage:
    """The joint coverage of several scripts."""
    watcher = Watcher(machine)
    for script in scripts:
        watcher.watch(steps_of(machine, script), script.end_ns)
    return watcher.coverage()


@dataclass
class _Timer:
    """The instant since which the operand of a `for` has been true. None if the operand is not
    true, or if it has counted as true since before the start.
    """

    is_from_start: bool
    start_ns: int | None = None


@dataclass
class Watcher:
    """Watches traces, one after another. Their histories contain the signals `kept`."""

    machine: ir.Machine
    reached: set[TraceGoal] = field(default_factory=set)
    kept: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        watched = tuple(range(len(self.machine.propositions)))
        self._watching = dataclasses.replace(self.machine, watches=watched)
        self._decisions = [
            _Decision(self.machine, rule, decision)
            for rule, declared in enumerate(self.machine.rules)
            for decision in decisions(self.machine, declared)
        ]

    def coverage(self) -> Coverage:
        """The coverage by all traces so far."""
        return Coverage(self.machine, tuple(goals(self.machine)), frozenset(self.reached))

    def watch(
        self, steps: Iterable[InstantEvents], end_ns: int, *, from_zero: bool = True
    ) -> History:
        """Watch one trace, from 0 s or from its first step on. Returns its history."""
        recorder = HistoryRecorder(self._watching, self.kept)
        trace = _Trace(self._watching, self._decisions, self.reached, recorder, not from_zero)
        for step in steps:
            trace.begin(step.at_ns)
            trace.step(step)
        trace.begin(end_ns)
        trace.advance(end_ns)
        return recorder.history()


class _Decision:
    """The effect of atoms on one decision. Results are stored."""

    def __init__(self, machine: ir.Machine, rule: int, decision: int) -> None:
        self.rule = rule
        self.decision = decision
        self.atoms = atoms(machine, decision)
        self.edges = {atom: edges(machine, atom) for atom in self.atoms}
        self._machine = machine
        self._known: dict[tuple[TruthValue, ...], frozenset[int]] = {}

    def decisive(self, propositions: Sequence[TruthValue]) -> frozenset[int]:
        """The atoms on which the decision depends: the opposite value of such an atom would give
        the decision the opposite value.
        """
        key = tuple(propositions[atom] for atom in self.atoms)
        if key not in self._known:
            values = dict(zip(self.atoms, key, strict=True))
            self._known[key] = frozenset(
                atom for atom in self.atoms if self._hangs_on(atom, values)
            )
        return self._known[key]

    def _hangs_on(self, atom: int, values: Mapping[int, TruthValue]) -> bool:
        both = {
            evaluate(self._machine, self.decision, {**values, atom: kleene.proposition_of(value)})
            for value in (True, False)
        }
        return both == {TruthValue.TRUE, TruthValue.FALSE}


def evaluate(machine: ir.Machine, proposition: int, values: Mapping[int, TruthValue]) -> TruthValue:
    """The value of a decision, computed from the values of its atoms."""
    if proposition in values:
        return values[proposition]
    match machine.propositions[proposition].node:
        case ir.Not(operand=operand):
            return kleene.negation(evaluate(machine, operand, values))
        case ir.And(operands=operands):
            return kleene.conjunction(evaluate(machine, each, values) for each in operands)
        case ir.Or(operands=operands):
            return kleene.disjunction(evaluate(machine, each, values) for each in operands)
        case ir.Literal(value=value):
            return kleene.proposition_of(value)
        case (
            ir.Compare() | ir.Between() | ir.Flag() | ir.AgeReaches() | ir.Oscillates()
            | ir.Quantified() | ir.Held() | ir.Since() | ir.Recurs()
        ) as node:  # fmt: skip
            raise AssertionError(f"{type(node).__name__} is an atom")


class _Trace:
    """The state of the watcher within one trace."""

    def __init__(
        self,
        machine: ir.Machine,
        decisions: Sequence[_Decision],
        reached: set[TraceGoal],
        recorder: HistoryRecorder,
        has_begun: bool,
    ) -> None:
        self._machine = machine
        self._decisions = decisions
        self._reached = reached
        self._interpreter = Interpreter(machine)
        self._before: tuple[bool, ...] = (False,) * len(machine.rules)
        self._timers: dict[int, _Timer] = {}
        self._stamps: dict[int, int] = {}
        self._elements: dict[int, Sequence[float]] = {}
        self._recorder = recorder
        self._now_ns = ir.EARLIEST_NS
        self._has_begun = has_begun
        held = (ir.held_of(machine, atom) for decision in decisions for atom in decision.atoms)
        self._held = {each for each in held if each is not None}

    def begin(self, at_ns: int) -> None:
        """Run and watch the timers before an instant; a trace begins at 0 s at the latest."""
        if not self._has_begun and at_ns > 0:
            self.advance(0)
        self._has_begun = True
        if at_ns < self._now_ns:  # time jumped back: all durations start again
            self._timers.clear()
            self._stamps.clear()
        self._now_ns = at_ns
        while (wake_ns := self._interpreter.next_wake()) is not None and wake_ns < at_ns:
            self.advance(wake_ns)

    def advance(self, at_ns: int) -> None:
        """Let time pass."""
        self._interpreter.advance(at_ns)
        self._look(at_ns)

    def step(self, step: InstantEvents) -> None:
        """Process the messages and resets of one instant."""
        if step.messages:
            self._ages(step)
            self._take_elements(step)
            self._interpreter.update(step.at_ns, step.messages)
            self._look(step.at_ns)
        for rule in step.resets:
            self._interpreter.reset(step.at_ns, rule)
            self._look(step.at_ns)

    def _take_elements(self, step: InstantEvents) -> None:
        for values in step.messages.values():
            for index, elements in values.arrays.items():
                array = self._machine.arrays[index]
                self._elements[index] = [
                    each * array.scale + array.offset
                    if (array.scale, array.offset) != (1.0, 0.0) else each for each in elements
                ]  # fmt: skip

    def _ages(self, step: InstantEvents) -> None:
        """Watch messages that arrive just before an age is reached."""
        for index, used in enumerate(self._machine.inputs):
            if used.channel not in step.messages:
                continue
            before = self._stamps.get(index)
            self._stamps[index] = step.at_ns
            if before is not None:
                for decision in self._decisions:
                    self._age(decision, index, step.at_ns - before)

    def _age(self, decision: _Decision, used: int, age_ns: int) -> None:
        for atom in decision.atoms:
            node = self._machine.propositions[atom].node
            if isinstance(node, ir.AgeReaches) and node.input == used:
                left_ns = node.age_ns - age_ns
                if 0 < left_ns <= deadline_step_ns(node.age_ns) + 1:
                    goal = TraceGoal(decision.rule, Aspect.UNDER, atom, decision.decision)
                    self._reached.add(goal)

    # --- after an evaluation -----------------------------------------------------------------

    def _look(self, at_ns: int) -> None:
        self._recorder.keep(at_ns, self._interpreter)
        propositions = self._interpreter.watches
        signals = self._interpreter.signals
        active = self._interpreter.active
        for rule, (before, now) in enumerate(zip(self._before, active, strict=True)):
            if now is not before:
                self._reached.add(TraceGoal(rule, Aspect.ACTIVE if now else Aspect.CLEARED))
        self._before = active
        self._look_at_stale(propositions)
        running = {held: self._elapsed(held, propositions, at_ns) for held in self._held}
        for decision in self._decisions:
            decisive = decision.decisive(propositions)
            for atom in decision.atoms:
                if atom in decisive and propositions[atom] in (TruthValue.TRUE, TruthValue.FALSE):
                    is_true = propositions[atom] is TruthValue.TRUE
                    aspect = Aspect.TRUE if is_true else Aspect.FALSE
                    self._add(decision, aspect, atom)
                    self._look_at_edges(decision, atom, signals)
                self._look_at_deadline(decision, atom, propositions, at_ns, running)

    def _add(self, decision: _Decision, aspect: Aspect, atom: int, edge: int = 0) -> None:
        self._reached.add(TraceGoal(decision.rule, aspect, atom, decision.decision, edge))

    def _look_at_stale(self, propositions: Sequence[TruthValue]) -> None:
        states = self._interpreter.input_states
        for index, rule in enumerate(self._machine.rules):
            if propositions[rule.condition] is TruthValue.STALE:
                for used in rule.inputs:
                    is_late = stays(self._machine.inputs[used])
                    stale = InputState.NEVER if is_late else InputState.EXPIRED
                    if states[used] is stale:
                        self._reached.add(TraceGoal(index, Aspect.STALE, used))

    def _look_at_edges(self, decision: _Decision, atom: int, signals: Sequence[float]) -> None:
        for number, edge in enumerate(decision.edges[atom]):
            for value in self._compared(atom, edge, signals):
                aspect = side_of(edge, value)
                if aspect is not None:
                    self._add(decision, aspect, atom, number)

    def _compared(
        self, atom: int, edge: ComparisonEdge, signals: Sequence[float]
    ) -> Sequence[float]:
        """The values that were compared with a threshold: one number, or the elements of an
        array.
        """
        if not isinstance(self._machine.propositions[atom].node, ir.Quantified):
            return (signals[edge.signal],)
        element = self._machine.signals[edge.signal].node
        return self._elements.get(element.array, ()) if isinstance(element, ir.Element) else ()

    def _elapsed(self, held: int, propositions: Sequence[TruthValue], at_ns: int) -> int | None:
        """The time in ns for which the operand of a `for` was true when it ended; None if it has
        not ended.
        """
        node = self._machine.propositions[held].node
        assert isinstance(node, ir.Held)
        timer = self._timers.setdefault(held, _Timer(node.initially))
        ended = None
        if propositions[node.operand] is not TruthValue.TRUE:
            if timer.start_ns is not None:
                ended = at_ns - timer.start_ns
            timer.is_from_start, timer.start_ns = False, None
        elif timer.start_ns is None and not timer.is_from_start:
            timer.start_ns = at_ns
        return ended

    def _look_at_deadline(
        self,
        decision: _Decision,
        atom: int,
        propositions: Sequence[TruthValue],
        at_ns: int,
        running: Mapping[int, int | None],
    ) -> None:
        due_ns = deadline_ns(self._machine, atom)
        if due_ns is None:
            return
        node = self._machine.propositions[atom].node
        held = ir.held_of(self._machine, atom)
        if held is not None:
            start_ns = self._timers[held].start_ns
            ended = running[held]
            if ended is not None and 0 < due_ns - ended <= deadline_step_ns(due_ns):
                self._add(decision, Aspect.UNDER, atom)
        elif isinstance(node, ir.AgeReaches):
            start_ns = self._stamps.get(node.input)
        is_due = start_ns is not None and at_ns - start_ns == due_ns
        if is_due and propositions[atom if held is None else held] is TruthValue.TRUE:
            self._add(decision, Aspect.AT, atom)


def side_of(edge: ComparisonEdge, value: float) -> Aspect | None:
    """The aspect of a value that is at a threshold, or within a step of it; None for other
    values.
    """
    distance = value - edge.threshold
    if distance == 0.0:
        return Aspect.AT
    if abs(distance) <= edge.step * _ROUNDING:
        return Aspect.UNDER if distance < 0 else Aspect.OVER
    return None
