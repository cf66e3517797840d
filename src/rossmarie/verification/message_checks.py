"""Checks of the functions that process messages.

The input is the definitions of a machine; the result is C functions. For each channel there are two
checks: its numbers have the right values, and the state of the monitor is right after the function.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from rossmarie.ir import model as ir
from rossmarie.verification import fields, opaque, supports
from rossmarie.verification.check import Check, Parts, WrittenCheck
from rossmarie.verification.definitions import Definitions
from rossmarie.verification.frames import FrameChecks
from rossmarie.verification.guard_checks import unlooked
from rossmarie.verification.invariants import remark_of
from rossmarie.verification.layout import ProofLayout
from rossmarie.verification.message_contracts import (
    ASKED,
    ASKED_ONCE,
    COMPUTED,
    HANDED,
    PREPARED,
    RECEIVED,
    STAGES,
)
from rossmarie.verification.message_numbers import MessageNumbers
from rossmarie.verification.program import ANY, obligation
from rossmarie.verification.stages import (
    COUNTED_PARTS,
    IN_RANGE,
    RESTS,
    WAITS,
    after,
    between,
    counts,
    stages,
)

ELEMENTS = 3
"""The largest number of array elements in a check."""

_ANY_OF_KIND = {
    ir.FieldKind.REAL: "nondet_double()",
    ir.FieldKind.FLAG: "nondet_number() % 2 != 0",
    ir.FieldKind.TEXT: "nondet_integer()",
}
"""Any value that a field of a kind may hold."""


class MessageChecks:
    """Writes these checks for one machine."""

    def __init__(
        self, layout: ProofLayout, definitions: Definitions, frames: FrameChecks, parts: Parts
    ) -> None:
        self._layout = layout
        self._frames = frames
        self._nothing_else = (*unlooked(parts), *COUNTED_PARTS)
        self._machine = layout.machine
        self._definitions = definitions
        self._beside = supports.beside(layout.machine)
        self._numbers_mean = MessageNumbers(layout, definitions)
        kept = [layout.machine.signals[signal].node for signal in layout.value_of_signal]
        self._opaque = opaque.functions_of(kept)
        follow: Parts = (("follow", "ignore_follow"),) if layout.oscillations else ()
        compute = ("compute", "ignore_compute")
        self._subfunctions = opaque.Subfunctions(self._opaque)
        self._same = self._subfunctions.parts()
        self._preparing: Parts = (("prepare", "ignore_prepare"),) if self._beside.signals else ()
        samples = opaque.parts_of_samples(self._machine)
        self._idle: Parts = (*follow, *self._preparing, compute, *samples)
        self._windows = opaque.parts_of_windows(layout)
        names = (opaque.name(*each) for each in self._opaque)
        self._parts = (*parts, *self._windows, *((name, f"any_{name}") for name in names))

    def text(self) -> str:
        """The contracts of the functions that receive a message, for checks of how a message is
        passed on.
        """
        channels = range(len(self._layout.places.channel_names))
        received = [*map(self._received, channels), *map(self._asked, channels)]
        contracts = [opaque.contract(*each) for each in self._opaque]
        contracts += opaque.contracts_of_samples(self._layout)
        contracts.append(self._subfunctions.text())
        prepared = [PREPARED] if self._beside.signals else []
        return "\n".join([*contracts, STAGES, *prepared, *received, COMPUTED])

    def written(self) -> Iterator[WrittenCheck]:
        """All checks of messages."""
        for function, count in self._opaque:
            about = f"{function.value} is unknown if an operand is unknown"
            check = Check(opaque.name(function, count), about, self._same)
            yield WrittenCheck(check, opaque.kept(function, count))
        yield from self._subfunctions.written()
        for channel, name in enumerate(self._layout.places.channel_names):
            topic = self._machine.channels[channel].topic
            about = f"the numbers of a message on {topic}"
            parts = (*self._windows, *self._same)
            numbers = Check(f"numbers_{name}", about, parts, is_arithmetic=True)
            yield WrittenCheck(numbers, self._numbers(channel, name))
            lines, arguments = self._message(channel)
            lines += [*self._given(channel), f"    is_reported[{channel}] = true;"]
            call = f"{self._layout.name}_update_{name}({arguments})"
            received: Parts = (
                (f"receive_{name}", f"received_{name}"),
                *(((f"fold_{name}", f"folded_{name}"),) if self._looked_at(channel) else ()),
                *((("prepare", "prepared"),) if self._beside.signals else ()),
                ("compute", "computed"),
            )
            about = f"a message on {topic} is passed on unchanged"
            handed = Check(f"handed_{name}", about, (*self._nothing_else, *received))
            yield WrittenCheck(handed, self._handed(channel, lines, call))
            guards = [self._layout.guards.index(g) for g in self._layout.guards_of(channel)]
            about = f"a message on {topic}"
            yield from self._paths(f"update_{name}", about, lines, call, received, guards)
        call = f"{self._layout.name}_step(m, t_ns, &v)"
        for channel, name in enumerate(self._layout.places.channel_names):
            about = f"the numbers of messages on {self._machine.channels[channel].topic} and more"
            parts = tuple(
                (part, "change_nothing" if part in ("catch_up", "evaluate") else contract)
                for part, contract in self._nothing_else
            )
            parts = (*parts, *self._windows, *self._same)
            numbers = Check(f"step_numbers_{name}", about, parts, is_arithmetic=True)
            yield WrittenCheck(numbers, self._step_numbers(channel, name, call))
        about = "messages on several topics"
        yield from self._paths("step", about, list(self._values()), call, self._idle)

    def _paths(
        self,
        name: str,
        about: str,
        lines: list[str],
        call: str,
        idle: Parts,
        guards: Sequence[int] = (),
    ) -> Iterator[WrittenCheck]:
        """The checks of the paths of a message. A message before any timer is due may take a short
        path; the long path is always right. The short path ends at the first guard that a number
        has left. Parts in `idle` do not matter after propositions are evaluated.
        """
        declared = "\n".join(lines)
        late = (*self._parts, ("is_calm", "never_calm"))
        yield from stages(f"{name}_late", f"{about}, the long path", call, late, declared, idle)
        calm = (*self._parts, ("is_calm", "assume_calm"), ("catch_up", "never_catch_up"))
        body = f"{ANY}\n{declared}\n{WAITS}\n    suppose_at_rest(m, t_ns);\n    (void){call};"
        short = f"{about}, the short path"
        if guards:
            yield from self._calm(f"{name}_calm", short, f"{body}\n{RESTS}", calm, guards)
        else:
            yield between(f"{name}_calm", short, f"{body}\n{RESTS}", calm)
        body = f"{ANY}\n{declared}\n{IN_RANGE}\n    (void){call};"
        yield after(f"{name}_calm", short, body, (*calm, *idle))
        counted = (*self._nothing_else, *idle)
        check = Check(f"{name}_counts", f"{about}: changes are counted", counted)
        yield WrittenCheck(check, f"{declared}\n{counts(call)}")

    def _calm(
        self, name: str, about: str, body: str, parts: Parts, guards: Sequence[int]
    ) -> Iterator[WrittenCheck]:
        """One check for each guard that a number may leave first, and one check where no number
        leaves any.
        """
        kept = tuple(pair for pair in parts if pair[0] != "is_inside")
        parts = (*kept, ("is_inside", "inside_until_left"))
        here = "\n".join(f"    is_here[{number}] = true;" for number in guards)
        yield between(f"{name}_inside", f"{about}, inside all guards", f"{here}\n{body}", parts)
        for number in guards:
            left = f"    first_left = {number};"
            remark = remark_of(self._layout.values[self._layout.guards[number].value])
            outside = f"{about}, `{remark}` leaves its guard first"
            yield between(f"{name}_left_{number}", outside, f"{here}\n{left}\n{body}", parts)

    # --- any message -------------------------------------------------------------------------

    def _message(self, channel: int) -> tuple[list[str], str]:
        """The declarations of an arbitrary message, and the arguments that pass it on."""
        lines, arguments = [], ["m", "t_ns"]
        for number, field in enumerate(self._fields(channel)):
            if field.slot is not None:
                kind = self._machine.slots[field.slot].kind
                declared = f"const {fields.SLOT_TYPES[kind]} field_{number}"
                lines.append(f"    {declared} = {self._any(field.slot)};")
                arguments.append(f"field_{number}")
            else:
                lines += _array(f"field_{number}")
                arguments.append(f"field_{number}")
            if field.count is not None:
                lines.append(f"    const size_t count_{number} = {self._any_count(field)};")
                arguments.append(f"count_{number}")
        return lines, ", ".join(arguments)

    def _values(self) -> Iterator[str]:
        """The declarations of arbitrary messages on some topics."""
        yield f"    {self._layout.name}_values v;"
        for channel, topic in enumerate(self._layout.places.channel_names):
            yield f"    v.has_{topic} = nondet_number() % 2 != 0;"
            yield f"    is_reported[{channel}] = v.has_{topic};"
            for number, field in enumerate(self._fields(channel)):
                member = f"v.{topic}.{field.name}"
                if field.slot is not None:
                    yield f"    {member} = {self._any(field.slot)};"
                    continue
                yield from _array(f"field_{channel}_{number}")
                yield f"    {member} = field_{channel}_{number};"
                if field.count is not None:
                    yield f"    v.{topic}.{field.count} = {self._any_count(field)};"

    def _any_count(self, field: fields.CField) -> str:
        """An arbitrary number of elements up to the limit of a check; for a list also too many
        elements.
        """
        assert field.array is not None, "only arrays have elements"
        count = f"nondet_number() % {ELEMENTS + 1}"
        its_list = self._machine.arrays[field.array].list
        if its_list is None:
            return count
        return f"nondet_number() % 2 ? {count} : {self._machine.lists[its_list].most + 1}"

    def _any(self, slot: int) -> str:
        return _ANY_OF_KIND[self._machine.slots[slot].kind]

    def _received(self, channel: int) -> str:
        """The contract of a receiving function: it counts its calls and asserts its arguments."""
        name = self._layout.places.channel_names[channel]
        parameters = ["monitor *m", "int64_t t_ns"]
        given, obligations = [], []
        for number, field in enumerate(self._fields(channel)):
            for declared, word in zip(
                fields.plain_parameters(field), fields.arguments(field), strict=True
            ):
                kept = f"given_{channel}_{number}{'' if word == field.name else '_count'}"
                kind = declared.removesuffix(word)
                parameters.append(f"{kind}{word}")
                given.append(f"static {kind}{kept};")
                same = f"spec_same({word}, {kept})" if kind == "double " else f"{word} == {kept}"
                obligations.append(obligation(same, f"{word} is passed on unchanged"))
        return RECEIVED.format(
            name=name,
            channel=channel,
            given="\n".join(given),
            parameters=", ".join(parameters),
            obligations="\n".join(obligations),
        )

    def _looked_at(self, channel: int) -> list[tuple[int, fields.CField]]:
        """The arrays of a channel whose elements are used beside numbers, with their places."""
        return [
            (number, field)
            for number, field in enumerate(self._fields(channel))
            if field.array is not None
            and supports.columns(self._machine, field.array)[0] in self._beside.arrays
        ]

    def _asked(self, channel: int) -> str:
        """The contract of the function that computes over elements beside numbers: it asserts its
        arguments.
        """
        if not self._looked_at(channel):
            return ""
        parameters, obligations = ["monitor *m"], list[str]()
        for number, field in self._looked_at(channel):
            declared = zip(fields.plain_parameters(field), fields.arguments(field), strict=True)
            for parameter, word in declared:
                kept = f"given_{channel}_{number}{'' if word == field.name else '_count'}"
                parameters.append(parameter)
                obligations.append(
                    obligation(f"{word} == {kept}", f"{word} is passed on to `fold`")
                )
        return ASKED.format(
            name=self._layout.places.channel_names[channel],
            channel=channel,
            parameters=", ".join(parameters),
            obligations="\n".join(obligations),
            before="PREPARED" if self._beside.signals else "STORED",
        )

    def _given(self, channel: int) -> Iterator[str]:
        """The arguments that the message must be passed on with."""
        for number, field in enumerate(self._fields(channel)):
            yield f"    given_{channel}_{number} = field_{number};"
            if field.count is not None:
                yield f"    given_{channel}_{number}_count = count_{number};"

    def _handed(self, channel: int, lines: list[str], call: str) -> str:
        text = HANDED.format(channel=channel, call=call)
        if self._looked_at(channel):
            text = f"    folded_{channel} = 0;\n{text}\n{ASKED_ONCE.format(channel=channel)}"
        return "\n".join([ANY, *lines, IN_RANGE, text])

    # --- numbers -----------------------------------------------------------------------------

    def _numbers(self, channel: int, name: str) -> str:
        lines, arguments = self._message(channel)
        names = [f"field_{number}" for number in range(len(self._fields(channel)))]
        counts = [name.replace("field", "count") for name in names]
        channels = range(len(self._machine.channels))
        arrived = ", ".join(str(int(each == channel)) for each in channels)
        lines.append(f"    const bool arrived[CHANNELS] = {{{arrived}}};")
        folded = [
            word
            for number, field in self._looked_at(channel)
            for word in (
                f"field_{number}",
                *(() if field.count is None else (f"count_{number}",)),
            )
        ]
        steps = [
            f"receive_{name}({arguments})",
            *(["prepare(m, arrived)"] if self._beside.signals else []),
            *([f"fold_{name}({', '.join(['m', *folded])})"] if folded else []),
            "compute(m, arrived, t_ns)",
        ]
        call = ";\n    ".join(steps)
        obligations = [
            *self._numbers_mean.meant(channel, names, counts),
            self._frames.received(channel),
        ]
        return self._called(lines, call, obligations)

    def _step_numbers(self, channel: int, name: str, call: str) -> str:
        names = [f"v.{name}.{field.name}" for field in self._fields(channel)]
        counts = [f"v.{name}.{field.count}" for field in self._fields(channel)]
        lines = [*self._values(), f"    v.has_{name} = true;", _IN_RANGE]
        return self._called(
            lines, f"(void){call}", self._numbers_mean.meant(channel, names, counts)
        )

    def _called(self, lines: Iterable[str], call: str, obligations: Iterable[str]) -> str:
        return "\n".join([_ANY_NUMBERS, *lines, _KEPT, f"    {call};", *obligations])

    def _fields(self, channel: int) -> tuple[fields.CField, ...]:
        return fields.fields_of(self._layout, channel)


_ANY_NUMBERS = f"""\
{ANY}
    __CPROVER_assume(t_ns > EARLIEST && m->now_ns <= t_ns);
    suppose_clock(m, t_ns);
    suppose_recent(m, t_ns);"""

_IN_RANGE = "    __CPROVER_assume(t_ns < LATEST);"

_KEPT = "    const monitor old = s;"


def _array(name: str) -> list[str]:
    lines = [f"    double {name}[{ELEMENTS}];"]
    return lines + [f"    {name}[{i}] = nondet_double();" for i in range(ELEMENTS)]
