"""A witness as a script: the messages that show a finding, written as a user would write them."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from rossmarie import ir
from rossmarie.analysis.witness import Witness, other_text, views
from rossmarie.interpreter import arithmetic
from rossmarie.ir.carried import holds_flags
from rossmarie.ir.script import FieldValue, Script, ScriptedArrival, SettingValue
from rossmarie.testing.frames import asked_frames
from rossmarie.testing.goals import edges
from rossmarie.testing.orientation import ANGLES, UPRIGHT
from rossmarie.testing.run import expectations_of
from rossmarie.testing.skills import reported_by_skills
from rossmarie.units import parse_unit

_DEGREES = parse_unit("deg")
_DIGITS = 6
_FEWEST = 3  # the fewest messages that are written as a repetition
_UNSET = object()
_Run = tuple[int, int, int | None]
"""The first and the last instant, and the period, of messages."""


def script_of(
    machine: ir.Machine, witness: Witness, name: str, rules: Sequence[int]
) -> Script | None:
    """The witness as a script in which some rules behave as in the witness; None if there is no
    such script. If the rules behave the same, orientations are written as angles, and numbers in
    the units of the rules. Otherwise both are written as in messages.
    """
    for is_plain in (False, True):
        events = reported_by_skills(machine, _Teller(machine, is_plain).events(witness))
        if events is None:
            return None
        script = Script(name, events, (), None)
        if all(is_shown(machine, witness, script, rule) for rule in rules):
            return script
    return None


def is_shown(machine: ir.Machine, witness: Witness, script: Script, rule: int) -> bool:
    """Say whether a rule becomes active and is cleared in a script as it does in a witness."""
    # The last of several evaluations at one instant counts.
    seen = {0: False} | {view.at_ns: view.active[rule] for view in views(machine, witness)}
    before = [None, *seen.values()]
    changed = [each for each, last in zip(seen.items(), before, strict=False) if each[1] != last]
    own = expectations_of(machine, script, rule, witness.end_ns)
    return changed == [(each.first_ns, each.is_active) for each in own]


@dataclass
class _Teller:
    """Writes the messages of a witness; `last` are the last values of fields, in SI."""

    machine: ir.Machine
    is_plain: bool
    last: dict[tuple[str, ir.Path, str | None], SettingValue] = field(default_factory=dict)

    def __post_init__(self) -> None:
        frames = asked_frames(self.machine)
        self.last |= {(topic, path, None): text for (topic, path), text in frames.items()}

    def events(self, witness: Witness) -> list[ScriptedArrival]:
        """All messages, in their order. Messages without changes are written as repetitions."""
        instants: dict[int, list[int]] = {}
        reported: list[ScriptedArrival] = []
        for sending in witness.events:
            settings: list[FieldValue] = []
            for channel, values in sending.messages.items():
                instants.setdefault(channel, []).append(sending.at_ns)
                settings += self._news(channel, values)
            if settings:
                inputs = tuple(dict.fromkeys(setting.input for setting in settings))
                topics = tuple(dict.fromkeys(setting.topic for setting in settings))
                once = (sending.at_ns, sending.at_ns, None)
                reported.append(ScriptedArrival(*once, inputs, topics, tuple(settings)))
        events = [*self._repeated(instants, reported), *reported]
        return sorted(events, key=lambda event: (event.first_ns, event.period_ns is None))

    def _repeated(
        self, instants: Mapping[int, Sequence[int]], reported: Sequence[ScriptedArrival]
    ) -> Iterator[ScriptedArrival]:
        """The messages by their instants. A single message is written only if no other event
        reports it.
        """
        groups: dict[_Run, list[int]] = {}
        for channel, times_ns in instants.items():
            for run in _runs(times_ns):
                groups.setdefault(run, []).append(channel)
        said = {(topic, event.first_ns) for event in reported for topic in event.topics}
        for (first_ns, last_ns, period_ns), channels in groups.items():
            topics = [
                topic
                for topic in (self.machine.channels[channel].topic for channel in channels)
                if period_ns is not None or (topic, first_ns) not in said
            ]
            names = tuple(self._name(topic) for topic in topics)
            if names:
                yield ScriptedArrival(first_ns, last_ns, period_ns, names, tuple(topics), ())

    def _name(self, topic: str) -> str:
        channels = self.machine.channels
        return next(
            used.name for used in self.machine.inputs if channels[used.channel].topic == topic
        )

    # --- fields ------------------------------------------------------------------------------

    def _news(self, channel: int, values: ir.ChannelValues) -> Iterator[FieldValue]:
        """The settings that differ from the message before."""
        for setting in self._settings(channel, values):
            key = (setting.topic, setting.path, setting.angle)
            usual: object = _UNSET if setting.angle is None else 0.0
            if self.last.get(key, usual) != setting.value:
                yield setting
            self.last[key] = setting.value

    def _settings(self, channel: int, values: ir.ChannelValues) -> Iterator[FieldValue]:
        machine = self.machine
        topic = machine.channels[channel].topic
        turned: set[int] = set()
        for group in () if self.is_plain else self._orientations():
            parts = tuple(values.slots.get(slot, math.nan) for slot in group)
            if not any(math.isnan(part) for part in parts):
                turned |= set(group)
                yield from self._turned(group[0], topic, parts)
        for its_list in machine.lists:  # a witness sends such fields without elements
            used = machine.inputs[its_list.input]
            if used.channel == channel:
                yield FieldValue(used.name, topic, its_list.path, ())
        for index, elements in values.arrays.items():
            array = machine.arrays[index]
            if array.list is not None:
                continue
            si = [raw * array.scale + array.offset for raw in elements]
            reported = tuple(each != 0.0 for each in si) if holds_flags(array) else tuple(si)
            unit = self._unit(ir.Element(index), array.unit)
            name = machine.inputs[array.input].name
            yield FieldValue(name, topic, array.path, reported, None, unit)
        for index, raw in values.slots.items():
            if index not in turned:
                slot = machine.slots[index]
                unit = self._unit(ir.Read(index), slot.unit)
                value = self._value(slot, raw)
                yield FieldValue(
                    machine.inputs[slot.input].name, topic, slot.path, value, None, unit
                )

    def _value(self, slot: ir.Slot, raw: float) -> SettingValue:
        if math.isnan(raw):
            return None
        match slot.kind:
            case ir.FieldKind.FLAG:
                return raw != 0.0
            case ir.FieldKind.TEXT:
                return self.machine.texts[int(raw)] if raw >= 0.0 else other_text(self.machine)
            case ir.FieldKind.REAL:
                return raw * slot.scale + slot.offset

    def _turned(self, slot: int, topic: str, parts: tuple[float, ...]) -> Iterator[FieldValue]:
        found = self.machine.slots[slot]
        name = self.machine.inputs[found.input].name
        for angle, function in ANGLES.items():
            shown = round(_DEGREES.from_si(arithmetic.apply(function, parts)), _DIGITS) + 0.0
            value = _DEGREES.to_si(shown)
            yield FieldValue(name, topic, found.path[:-1], value, angle, _DEGREES.symbol)

    def _orientations(self) -> Iterator[tuple[int, ...]]:
        """The slots of each orientation from which the rules compute an angle."""
        found: dict[tuple[int, ...], None] = {}
        for signal in self.machine.signals:
            node = signal.node
            if isinstance(node, ir.Apply) and node.function in ANGLES.values():
                reads = [self.machine.signals[operand].node for operand in node.operands]
                slots = tuple(read.slot for read in reads if isinstance(read, ir.Read))
                if len(slots) == len(UPRIGHT):
                    found[slots] = None
        return iter(found)

    def _unit(self, read: ir.SignalNode, own: str) -> str:
        """The unit of a threshold of a field, or else the field's own unit."""
        for proposition in range(0 if self.is_plain else len(self.machine.propositions)):
            for edge in edges(self.machine, proposition):
                if self.machine.signals[edge.signal].node == read:
                    return self.machine.signals[edge.constant].unit or own
        return own


def _runs(times_ns: Sequence[int]) -> Iterator[_Run]:
    """Instants as repetitions with one period each, and as single instants."""
    waiting = list(times_ns)
    while waiting:
        gaps = [later - earlier for earlier, later in itertools.pairwise(waiting)]
        count = 1 + next((at for at, gap in enumerate(gaps) if gap != gaps[0]), len(gaps))
        if count < _FEWEST:
            yield waiting[0], waiting[0], None
            waiting = waiting[1:]
        else:
            yield waiting[0], waiting[count - 1], gaps[0]
            waiting = waiting[count:]
