"""Turn a trace in phases into the events of a script. In a phase, values stay constant.

All inputs of the rule are sent repeatedly, with one period, except on channels that are silent in a
phase. A rate or a previous sample takes two messages at the beginning of its phase, an oscillation
several.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from rossmarie import ir
from rossmarie.ir.beams import USUAL_DISTANCES, is_of_scan
from rossmarie.ir.carried import carries, holds_flags
from rossmarie.ir.script import FieldValue, Script, ScriptedArrival, ScriptedReset, SettingValue
from rossmarie.testing.beams import is_column, readings
from rossmarie.testing.goals import visible_step
from rossmarie.testing.skills import reported_by_skills
from rossmarie.testing.solve import RuleFormulas
from rossmarie.testing.variables import Ramp, Values, Variable

_ANGLES: Mapping[ir.AnyFunction, str] = {
    ir.Function.ROLL: "roll",
    ir.Function.PITCH: "pitch",
    ir.Function.YAW: "yaw",
}
_SECOND = 1_000_000_000
_USUAL_BEAT_NS = _SECOND // 10


@dataclass(frozen=True)
class Phase:
    """Values that stay for `length_ns`; `silent` are the channels without messages."""

    values: Values
    length_ns: int
    silent: frozenset[int] = frozenset()


def beat_ns(machine: ir.Machine, rule: ir.Rule) -> int:
    """The period of messages that keeps all inputs of a rule fresh: at most half of the shortest
    timeout. It is 1, 2 or 5 times a power of ten of nanoseconds. With rates, it is a power of two
    of a second, because doubles are divided by it without rounding.
    """
    timeouts = [machine.inputs[used].timeout_ns for used in rule.inputs]
    most_ns = min([2 * _USUAL_BEAT_NS, *(each for each in timeouts if each is not None)]) // 2
    samples = ir.supports(machine).propositions[rule.condition].samples
    has_rate = any(_is_rate(machine.signals[each].node) for each in samples)
    if has_rate and most_ns >= _SECOND // 512:
        return _SECOND >> math.ceil(math.log2(_SECOND / most_ns))
    unit_ns = int(10.0 ** math.floor(math.log10(max(most_ns, 1))))
    return max(each * unit_ns for each in (1, 2, 5) if each * unit_ns <= max(most_ns, 1))


def _is_rate(node: ir.SignalNode) -> bool:
    return isinstance(node, ir.Sampled) and node.function is ir.Sampling.RATE


@dataclass(frozen=True)
class PhaseSearch:
    """The machine, the solver's world and the period with which the phases of one rule are
    played.
    """

    world: RuleFormulas
    machine: ir.Machine
    rule: int
    beat_ns: int
    ramp: Ramp

    def script(self, name: str, phases: Sequence[Phase]) -> Script:
        """The events of phases, without expectations. The script is empty if no skills give the
        required answers.
        """
        ends = list(itertools.accumulate(phase.length_ns for phase in phases))
        starts = [0, *ends[:-1]]
        events: list[ScriptedArrival | ScriptedReset] = list(self._beats(phases, starts, ends))
        before: dict[Variable, float] = {}
        for phase, start_ns, end_ns in zip(phases, starts, ends, strict=True):
            reported = self._reported(phase)
            events += self._changes(reported, before, start_ns)
            kept = {each: before[each] for each in phase.values if each in before}
            before = kept | dict(reported.values)
            if self.machine.rules[self.rule].release is None:
                events.append(ScriptedReset(end_ns - self.beat_ns, self.rule))
        events.sort(key=_start)
        return Script(name, reported_by_skills(self.machine, events) or (), (), None)

    def _reported(self, phase: Phase) -> Phase:
        """The phase without the numbers that only messages on silent channels could carry."""
        inputs, slots = self.machine.inputs, self.machine.slots
        values = {
            variable: value
            for variable, value in phase.values.items()
            if variable.kind != "slot"
            or inputs[slots[variable.index].input].channel not in phase.silent
        }
        return replace(phase, values=values)

    # --- messages that keep inputs alive -----------------------------------------------------

    def _beats(
        self, phases: Sequence[Phase], starts: Sequence[int], ends: Sequence[int]
    ) -> Iterator[ScriptedArrival]:
        groups: dict[tuple[tuple[int, int], ...], list[int]] = {}
        for used in self._one_of_each_channel():
            channel = self.machine.inputs[used].channel
            stretches: list[tuple[int, int]] = []
            for phase, start_ns, end_ns in zip(phases, starts, ends, strict=True):
                if channel in phase.silent:
                    continue
                if stretches and stretches[-1][1] == start_ns:
                    start_ns = stretches.pop()[0]
                stretches.append((start_ns, end_ns))
            groups.setdefault(tuple(stretches), []).append(used)
        for stretches_of_group, inputs in groups.items():
            names = tuple(self.machine.inputs[used].name for used in inputs)
            topics = tuple(self._topic(used) for used in inputs)
            for first_ns, last_ns in stretches_of_group:
                yield ScriptedArrival(first_ns, last_ns, self.beat_ns, names, topics, ())

    def _one_of_each_channel(self) -> list[int]:
        found: dict[int, int] = {}
        for used in self.machine.rules[self.rule].inputs:
            found.setdefault(self.machine.inputs[used].channel, used)
        return list(found.values())

    def _topic(self, used: int) -> str:
        return self.machine.channels[self.machine.inputs[used].channel].topic

    # --- what changes ------------------------------------------------------------------------

    def _changes(self, phase: Phase, before: Values, start_ns: int) -> Iterator[ScriptedArrival]:
        later: list[tuple[int, list[FieldValue]]] = []
        settings: list[FieldValue] = []
        moved: set[int] = set()
        for variable, value in phase.values.items():
            moves = list(self._moves(variable, value, phase.values))
            if moves:
                moved.add(self._slot_of(variable))
                settings += moves[0][1]
                later += moves[1:]
        arrays = {each.index for each in phase.values if each.kind == "element"}
        for variable, value in phase.values.items():
            is_moved = variable.kind == "slot" and variable.index in moved
            if before.get(variable) != value and not is_moved:
                settings += self._setting(variable, value)
        for array in sorted(arrays):
            reported, reported_before = (
                self._reported_of(array, each) for each in (phase.values, before)
            )
            if reported != reported_before:
                settings += self._array(array, *reported)
        if settings:
            yield self._sent(start_ns, settings)
        merged: dict[int, list[FieldValue]] = {}
        for offset_ns, each in later:
            merged.setdefault(offset_ns, []).extend(each)
        for offset_ns, each in sorted(merged.items()):
            yield self._sent(start_ns + offset_ns, each)

    def _sent(self, at_ns: int, settings: list[FieldValue]) -> ScriptedArrival:
        inputs = tuple(dict.fromkeys(setting.input for setting in settings))
        topics = tuple(dict.fromkeys(setting.topic for setting in settings))
        return ScriptedArrival(at_ns, at_ns, None, inputs, topics, tuple(settings))

    def _setting(self, variable: Variable, value: float) -> Iterator[FieldValue]:
        if variable.kind == "slot":
            yield self._of_slot(variable.index, value)
        elif variable.kind == "angle":
            node = self.machine.signals[variable.index].node
            assert isinstance(node, ir.Apply)
            first = self.machine.signals[node.operands[0]].node
            if isinstance(first, ir.Read):
                slot = self.machine.slots[first.slot]
                name = self.machine.inputs[slot.input].name
                unit = self.world.unit(variable).symbol
                angle = _ANGLES[node.function]
                yield FieldValue(name, self._topic(slot.input), slot.path[:-1], value, angle, unit)

    def _value_of(self, kind: ir.FieldKind, number: float) -> SettingValue:
        match kind:
            case ir.FieldKind.FLAG:
                return number != 0.0
            case ir.FieldKind.TEXT:
                return self.machine.texts[int(number)] if number >= 0 else "something else"
            case ir.FieldKind.REAL:
                return number

    def _of_slot(self, index: int, number: float) -> FieldValue:
        slot = self.machine.slots[index]
        value = self._value_of(slot.kind, number)
        name = self.machine.inputs[slot.input].name
        unit = self.world.unit(Variable("slot", index)).symbol
        return FieldValue(name, self._topic(slot.input), slot.path, value, None, unit)

    def _elements(self, array: int, values: Values) -> tuple[float, ...]:
        """All elements of an array; none if no rule at hand reads an element. Elements without a
        value are zero, or for a scan at the usual greatest distance.
        """
        parts = {each.part for each in values if (each.kind, each.index) == ("element", array)}
        places = range(self.world.length if parts else 0)
        usual = USUAL_DISTANCES[1] if is_of_scan(self.machine.arrays[array]) else 0.0
        return tuple(values.get(Variable("element", array, part), usual) for part in places)

    def _reported_of(self, array: int, values: Values) -> tuple[tuple[float, ...], float]:
        """All elements of an array, and for points of a scan their side in degrees (else 0)."""
        its_list = self.machine.arrays[array].list
        side = None if its_list is None else values.get(Variable("side", its_list))
        return self._elements(array, values), side or 0.0

    def _array(self, index: int, elements: tuple[float, ...], side: float) -> Iterator[FieldValue]:
        """The settings of an array: the array as a whole; for a list, a field of one element after
        the other; for points of a scan, the readings.
        """
        array = self.machine.arrays[index]
        if is_of_scan(array) and array.list is not None:
            if is_column(array, "range"):
                yield from readings(self.machine, array, elements, side)
            return
        name, topic = self.machine.inputs[array.input].name, self._topic(array.input)
        unit = self.world.unit(Variable("element", index)).symbol
        if array.list is None:
            value = tuple(each != 0.0 for each in elements) if holds_flags(array) else elements
            yield FieldValue(name, topic, array.path, value, None, unit)
            return
        kind = ir.FieldKind.FLAG if holds_flags(array) else array.kind
        for place, number in enumerate(elements):
            path = tuple(place if step == ir.EACH else step for step in array.path)
            yield FieldValue(name, topic, path, self._value_of(kind, number), None, unit)

    # --- what takes several messages ---------------------------------------------------------

    def _moves(
        self, variable: Variable, value: float, values: Values
    ) -> Iterator[tuple[int, list[FieldValue]]]:
        """The settings of a variable, each with its time in ns after the beginning of a phase."""
        slot = self._slot_of(variable)
        if slot < 0:
            return
        now = values.get(Variable("slot", slot), 0.0)
        if variable.kind == "rate" and value != 0.0:
            for count in range(-1, self.ramp.count + 1):
                number = now + value * count * self.beat_ns / 1e9
                yield (count + 1) * self.beat_ns, [self._of_slot(slot, number)]
        elif variable.kind == "previous" and value != now:
            yield 0, [self._of_slot(slot, value)]
            yield self.beat_ns, [self._of_slot(slot, now)]
        elif variable.kind == "oscillating" and value != 0.0:
            node = self.machine.propositions[variable.index].node
            assert isinstance(node, ir.Oscillates)
            swing = _visible_swing(self.machine.slots[slot], node.swing, now)
            step_ns = min(self.beat_ns, node.window_ns // (node.count + 3))
            for count in range(node.count + 3):
                number = now + (swing if count % 2 else 0.0)
                yield count * step_ns, [self._of_slot(slot, number)]

    def _slot_of(self, variable: Variable) -> int:
        """The field that a rate, a sample or an oscillation is computed from; -1 if there is no
        such field.
        """
        if variable.kind == "oscillating":
            node = self.machine.propositions[variable.index].node
            signal = node.signal if isinstance(node, ir.Oscillates) else -1
        elif variable.kind in ("rate", "previous"):
            sampled = self.machine.signals[variable.index].node
            signal = sampled.signal if isinstance(sampled, ir.Sampled) else -1
        else:
            return -1
        read = None if signal < 0 else self.machine.signals[signal].node
        return read.slot if isinstance(read, ir.Read) else -1


def _visible_swing(slot: ir.Slot, swing: float, now: float) -> float:
    """The swing of a field from its present value. It is clearly larger than required if the field
    can carry it.
    """
    sizes = [factor * swing for factor in (2.0, 1.25, 1.0)] if swing else [1.0]
    if slot.limits is not None:
        step = abs(slot.scale)
        sizes = [math.ceil(size / step) * step for size in sizes] if swing else [step]
    shifts = [size * sign for size in sizes for sign in (1, -1)]
    return next((each for each in shifts if carries(slot, now + each)), shifts[0])


def ramp_of(machine: ir.Machine, rule: int, beat: int) -> Ramp:
    """The ramp of a rate: over one message, or as long as the longest `for`."""
    longest_ns = delay_ns(machine, machine.rules[rule].condition)
    return Ramp(beat / 1e9, min(math.ceil(longest_ns / beat), 63))


def delay_ns(machine: ir.Machine, proposition: int, *, value: bool = True) -> int:
    """The longest time in ns until a proposition is `value`, after its leaves have the values for
    it.
    """
    node = machine.propositions[proposition].node
    own_ns = 0
    match node:
        case ir.Not(operand=operand):
            return delay_ns(machine, operand, value=not value)
        case ir.Held(duration_ns=duration_ns):
            own_ns = duration_ns if value else 0
        case ir.Oscillates(window_ns=window_ns) | ir.Recurs(window_ns=window_ns):
            own_ns = window_ns
        case ir.AgeReaches(age_ns=age_ns):
            own_ns = age_ns // 1000 * 1000 if value else 0
        case ir.Compare() | ir.Between() | ir.Flag():
            own_ns = max(_windows(machine, ir.compared_signals(node)), default=0)
        case ir.Literal() | ir.Quantified() | ir.And() | ir.Or() | ir.Since():
            pass
    below = (delay_ns(machine, each, value=value) for each in ir_operands(node))
    return own_ns + max(below, default=0)


def _windows(machine: ir.Machine, signals: Sequence[int]) -> Iterator[int]:
    """The windows in ns of the numbers. Windows of samples of samples are added."""
    for signal in signals:
        node = machine.signals[signal].node
        own_ns = node.window_ns if isinstance(node, ir.Sampled) else 0
        yield own_ns + max(_windows(machine, ir.signal_operands(node)), default=0)


def ir_operands(node: ir.PropositionNode) -> tuple[int, ...]:
    """The operands of a proposition that are propositions, except those of elements."""
    return () if isinstance(node, ir.Quantified) else tuple(ir.proposition_operands(node))


def round_up(length_ns: int, beat: int) -> int:
    """A readable length in ns: whole tenths of a second or more, and a multiple of the period."""
    step_ns = max(round(visible_step(length_ns / 1e9) * 1e11), beat)
    step_ns = math.ceil(step_ns / beat) * beat
    return math.ceil(length_ns / step_ns) * step_ns


def _start(event: ScriptedArrival | ScriptedReset) -> tuple[int, bool, bool]:
    if isinstance(event, ScriptedReset):
        return event.at_ns, True, True
    return event.first_ns, event.period_ns is None, False
