"""The functions that process the messages of one channel.

The input is a layout. A message is *calm* if four conditions hold: the last message on its channel
is still valid, no timer is due, every number is inside its guard, and every other comparison has
its old value. Then nothing can change, and the numbers are stored for later. A channel has no calm
messages if arrays are read from it, or samples are taken from it.
"""

from __future__ import annotations

from functools import cached_property

from rossmarie import ir
from rossmarie.targets.python import expressions, names
from rossmarie.targets.python.function import StartFunction
from rossmarie.targets.python.layout import PythonLayout, ValueLimits, number

_LARGEST_EXACT = 2.0**53
"""Every integer below this number is a double, so integers and doubles compare alike."""


def calm_channels(layout: PythonLayout) -> list[int]:
    """The channels that can have calm messages."""
    supports = layout.supports.signals
    sampled = [*layout.sampled, *(node.signal for _, node in layout.oscillations)]
    remembered = {channel for signal in sampled for channel in supports[signal].channels}
    channels = range(len(layout.machine.channels))
    return [c for c in channels if c not in remembered and not layout.arrays(c)]


def receive(layout: PythonLayout, channel: int) -> list[str]:
    """The function that converts the content of a message. If it fails, nothing changes (S7)."""
    parameters = _parameters(layout, channel)
    function = StartFunction(f"receive_{channel}({', '.join(parameters)})")
    _convert(layout, channel, function)
    function.line(f"return {names.tuple_of(parameters)}")
    return function.text()


def arrive(layout: PythonLayout, channel: int) -> list[str]:
    """The function that processes the result of `receive`."""
    function = StartFunction(
        f"arrive_{channel}({', '.join(['at_ns', *_parameters(layout, channel)])})"
    )
    _take(layout, channel, function)
    return function.text()


def update(layout: PythonLayout, channel: int) -> list[str]:
    """The function that users call with a message: its scalars, then its arrays."""
    function = StartFunction(
        f"update_{channel}({', '.join(['at_ns', *_parameters(layout, channel)])})"
    )
    if channel in calm_channels(layout):
        _Calm(layout, channel).write(function)
    _convert(layout, channel, function)
    function.line("reported = len(events)")
    function.line("if (not now <= at_ns <= wake or at_ns >= LATEST) and not catch_up(at_ns):")
    function.line("return -1", 1)
    _take(layout, channel, function)
    function.line(f"evaluate(at_ns, {1 << channel})")
    function.line("return len(events) - reported")
    return function.text()


def _convert(layout: PythonLayout, channel: int, function: StartFunction) -> None:
    calm = _Calm(layout, channel)
    for slot in layout.slots(channel):
        raw, declared = f"a{slot}", layout.machine.slots[slot]
        if not _is_plain(declared):
            function.line(f"{raw} = {_converted(declared, slot)}")
        elif not calm.is_only_compared(f"x{slot}"):
            function.line(f"{raw} = float({raw})")
        function.line(f"{raw} = {raw} if -MAX <= {raw} <= MAX else NAN")
    for array in layout.arrays(channel):
        converted = f"[float(e) for e in a_{array}]"
        if layout.machine.arrays[array].list is not None:
            converted = f"None if a_{array} is None else {converted}"
        function.line(f"a_{array} = {converted}")


def _take(layout: PythonLayout, channel: int, function: StartFunction) -> None:
    """S9: store the numbers of a message and set the states of its inputs."""
    for group in layout.groups:
        if group.channel == channel:
            function.assign(group.state, "1")
    if channel in layout.stamped:
        function.assign(f"stamp_{channel}", "at_ns")
    for slot in layout.slots(channel):
        function.assign(f"x{slot}", f"a{slot}")
    for array in layout.arrays(channel):
        columns = layout.beside(array)
        if layout.is_kept(array):
            function.assign(f"kept_{array}", f"a_{array}")
        elif array == columns[0]:
            function.line(f"look_{array}({', '.join(f'a_{column}' for column in columns)})")


def _parameters(layout: PythonLayout, channel: int) -> list[str]:
    slots = [f"a{slot}" for slot in layout.slots(channel)]
    return [*slots, *(f"a_{array}" for array in layout.arrays(channel))]


def _is_plain(slot: ir.Slot) -> bool:
    return (slot.scale, slot.offset) == (1.0, 0.0)


def _converted(declared: ir.Slot, slot: int) -> str:
    return f"a{slot} * {number(declared.scale)} + {number(declared.offset)}"


def _computed(layout: PythonLayout, channel: int) -> list[tuple[int, ir.Apply]]:
    """The functions of numbers of a channel."""
    nodes = ((index, layout.machine.signals[index].node) for index in layout.signals)
    supports = layout.supports.signals
    return [
        (index, node)
        for index, node in nodes
        if isinstance(node, ir.Apply) and channel in supports[index].channels
    ]


def _unguarded(layout: PythonLayout, channel: int) -> list[tuple[int, ir.PropositionNode]]:
    """The comparisons of numbers of a channel that have no fixed limits."""
    nodes = ((index, layout.machine.propositions[index].node) for index in layout.propositions)
    supports = layout.supports.propositions
    return [
        (index, node)
        for index, node in nodes
        if isinstance(node, ir.Compare | ir.Between | ir.Flag)
        and channel in supports[index].channels
        and index not in layout.guarded
    ]


class _Calm:
    """Writes the code for a calm message."""

    def __init__(self, layout: PythonLayout, channel: int) -> None:
        self._layout = layout
        self._channel = channel
        self._slots = layout.slots(channel)
        self._local: dict[str, str] = {}
        self._computed = _computed(layout, channel)
        self._unguarded = _unguarded(layout, channel)
        self._users: dict[str, list[tuple[int, ir.Apply]]] = {}
        for index, node in self._computed:
            for operand in set(node.operands):
                self._users.setdefault(layout.value(operand), []).append((index, node))
        compared = {s for _, node in self._unguarded for s in ir.compared_signals(node)}
        sampled = {*layout.sampled, *(node.signal for _, node in layout.oscillations)}
        looked_at = compared | sampled | layout.made_beside
        self._looked_at = {layout.value(signal) for signal in looked_at}

    def write(self, function: StartFunction) -> None:
        """The conditions, and the statements for a calm message."""
        conditions = [f"now <= at_ns < calm_{self._channel}"]
        self._arrivals(function)
        for slot in self._slots:
            conditions += self._is_inside(f"x{slot}")
        for index, node in self._computed:
            text = expressions.raw(node, self._value)
            self._local[f"s{index}"] = f"b{index}"
            function.line(f"b{index} = {text}")
            conditions += self._is_inside(f"s{index}")
        conditions += [self._is_as_before(leaf, node) for leaf, node in self._unguarded]
        function.line(f"if {' and '.join(conditions)}:")
        function.assign("now", "at_ns", 1)
        if self._channel in self._layout.stamped:
            function.assign(f"stamp_{self._channel}", "at_ns", 1)
        for slot in self._slots:
            function.assign(f"x{slot}", self._local[f"x{slot}"], 1)
        for index, _ in self._computed:
            if index in self._shown:
                function.assign(f"s{index}", f"b{index}", 1)
        function.line("return 0", 1)

    def _arrivals(self, function: StartFunction) -> None:
        for slot in self._slots:
            declared = self._layout.machine.slots[slot]
            self._local[f"x{slot}"] = f"c{slot}"
            if not _is_plain(declared):
                function.line(f"c{slot} = {_converted(declared, slot)}")
            elif self.is_only_compared(f"x{slot}"):
                self._local[f"x{slot}"] = f"a{slot}"
            else:
                function.line(f"c{slot} = float(a{slot})")

    def _value(self, signal: int) -> str:
        """A signal with the numbers of this message."""
        name = self._layout.value(signal)
        return self._local.get(name, name)

    # --- conditions --------------------------------------------------------------------------

    def _is_inside(self, name: str) -> list[str]:
        """The conditions that a number is known and, if it has a guard, inside its guard."""
        local = self._local[name]
        if (guard := self._layout.guard_of.get(name)) is not None:
            return [f"{guard.low} < {local} <= {guard.high}"]
        if any(self._shows(node, name) for _, node in self._users.get(name, ())):
            return []  # the condition on the result is enough
        return [f"{local} - {local} == 0.0"]

    def _shows(self, node: ir.Apply, name: str) -> bool:
        """Say whether a number is finite whenever this function of the number is finite."""
        named = (operand for operand in node.operands if self._layout.value(operand) == name)
        return any(expressions.is_shown(node, operand) for operand in named)

    def _is_as_before(self, leaf: int, node: ir.PropositionNode) -> str:
        return f"(1 if {expressions.holds(node, self._value)} else 0) == t{leaf}"

    @cached_property
    def _shown(self) -> set[int]:
        """The signals that can be reported without an evaluation before: those in verdicts of
        resets (S38), and margins with all their operands.
        """
        machine = self._layout.machine
        resets = {s for rule in machine.rules if rule.release is None for s in rule.signals}
        return resets | ir.below_margins(machine)

    def is_only_compared(self, name: str) -> bool:
        """Say whether only guards use a number or its absolute value. Then the number may stay an
        integer, because integers compare in the same way.
        """
        for index, node in self._users.get(name, ()):
            is_absolute = node.function is ir.Function.ABSOLUTE
            if not is_absolute or not self.is_only_compared(f"s{index}"):
                return False
        guard = self._layout.guard_of.get(name)
        return name not in self._looked_at and (guard is None or _is_narrow(guard))


def _is_narrow(guard: ValueLimits) -> bool:
    return all(abs(cut) < _LARGEST_EXACT for cut in guard.cuts)
