"""The memory of a monitor, and its changes with time (S10, S15, S17).

The input is a layout. Instants and durations are in nanoseconds.
"""

from __future__ import annotations

from collections.abc import Iterator

from rossmarie import ir
from rossmarie.core import sampling_row
from rossmarie.targets.python.channels import calm_channels
from rossmarie.targets.python.elements import inputs_of, results
from rossmarie.targets.python.expressions import applied
from rossmarie.targets.python.function import StartFunction
from rossmarie.targets.python.layout import InputGroup, PythonLayout


def variables(layout: PythonLayout) -> Iterator[tuple[str, str]]:
    """Each variable and its initial value."""
    # The range from now to wake is empty, so the first event is evaluated at its own instant.
    yield from (("now", "EARLIEST"), ("wake", "EARLIEST - 1"))
    yield from ((group.state, "0") for group in layout.groups)
    yield from ((f"calm_{channel}", "EARLIEST") for channel in calm_channels(layout))
    yield from ((f"stamp_{channel}", "0") for channel in sorted(layout.stamped))
    yield from ((f"x{slot}", "NAN") for slot in range(len(layout.machine.slots)))
    yield from _signals(layout)
    for array in range(len(layout.machine.arrays)):
        yield from (pair for pair in results(layout, array).items() if pair[0].startswith("q"))
        if layout.is_kept(array):
            yield f"kept_{array}", "()"
    for name, sampled in layout.memories.items():
        has_window = sampling_row(sampled.function).has_window
        yield name, f"Samples({sampled.window_ns if has_window else ''})"
    for index, node in layout.oscillations:
        settings = f"{node.count}, {node.window_ns}, {node.swing!r}"
        yield f"oscillation_{index}", f"Oscillation({settings})"
    for index, recurs in layout.recurring:
        yield f"recurrence_{index}", f"Recurrence({recurs.count}, {recurs.window_ns})"
    for index, held in layout.held:
        yield from ((f"due_{index}", "NEVER"), (f"before_{index}", str(int(held.initially))))
    yield from ((f"before_{index}", "0") for index in layout.sinces)
    for guard in layout.guards:
        yield from ((guard.low, "INF"), (guard.high, "INF"))
    yield from ((f"t{index}", "-1") for index in layout.kept)
    yield from ((f"d{index}", "0") for index in sorted(layout.terms))
    yield from ((f"active_{rule}", "False") for rule in range(len(layout.machine.rules)))


def _signals(layout: PythonLayout) -> Iterator[tuple[str, str]]:
    """Signals, initially unknown, except for those that depend only on a parameter of the node
    (S87).
    """
    given = {each.channel for each in ir.settings_of(layout.machine)}
    for index in layout.signals:
        node = layout.machine.signals[index].node
        if isinstance(node, ir.Constant | ir.Read):
            continue
        if isinstance(node, ir.Apply) and layout.supports.signals[index].channels & given:
            yield f"s{index}", applied(layout, node, layout.value)
        else:
            yield f"s{index}", "NAN"


# --- inputs that grow old --------------------------------------------------------------------


def expire(layout: PythonLayout, function: StartFunction) -> None:
    """S10: expire the inputs that reach their timeout, and forget their values."""
    for group in layout.groups:
        if group.timeout_ns is None:
            continue
        age = f"at_ns - stamp_{group.channel}"
        function.line(f"if {group.state} == 1 and {age} >= {group.timeout_ns}:")
        function.assign(group.state, "2", 1)
        for index, slot in enumerate(layout.machine.slots):
            if slot.input in group.inputs:
                function.assign(f"x{index}", "NAN", 1)
        for array in range(len(layout.machine.arrays)):
            for variable, unknown in results(layout, array).items():
                if inputs_of(layout, variable) & group.inputs:
                    function.assign(variable, unknown, 1)
        for name in _sampled(layout, group):
            function.line(f"{name}.forget()", 1)


def _sampled(layout: PythonLayout, group: InputGroup) -> list[str]:
    """S21: the samples that expire together with these inputs."""
    supports = layout.supports.signals
    memories = layout.memories.items()
    return [name for name, node in memories if supports[node.signal].inputs & group.inputs]


# --- timers ----------------------------------------------------------------------------------


def earliest(layout: PythonLayout) -> list[str]:
    """The function that computes the exact instant of the next timer (S15)."""
    function = StartFunction("earliest()")
    look_for_timers(layout, function)
    function.line("return first")
    return function.text()


def look_for_timers(layout: PythonLayout, function: StartFunction) -> None:
    """The code that computes the same within a function: `first` is the instant of the next
    timer.
    """
    function.line("first = NEVER")
    for group in layout.groups:
        if group.timeout_ns is not None:
            due = f"stamp_{group.channel} + {group.timeout_ns}"
            _sooner(function, f"{group.state} == 1", due)
    for index, _ in layout.held:
        function.line(f"if due_{index} < first and t{index} != 1:")
        function.line(f"first = due_{index}", 1)
    for index, age in layout.ages:
        _sooner(function, f"t{index} == 0", f"stamp_{layout.channel(age.input)} + {age.age_ns}")
    for index, name in _recent(layout):
        function.line(f"first = min(first, {name}.recent.wake_ns(t{index}, NEVER))")


def _recent(layout: PythonLayout) -> Iterator[tuple[int, str]]:
    """The propositions that count turning points or edges, each with the name of its memory."""
    yield from ((index, f"oscillation_{index}") for index, _ in layout.oscillations)
    yield from ((index, f"recurrence_{index}") for index, _ in layout.recurring)


def _sooner(function: StartFunction, condition: str, due: str) -> None:
    function.line(f"if {condition} and {due} < first:")
    function.line(f"first = {due}", 1)


# --- time that jumps -------------------------------------------------------------------------


def restart(layout: PythonLayout) -> list[str]:
    """The function that forgets everything measured by the clock (S17)."""
    function = StartFunction("restart(at_ns)")
    function.line("events.append(TimeJump(now, at_ns))")
    for channel in sorted(layout.stamped):
        # No limit of an age is above LONGEST, so the ages of older inputs are set to LONGEST.
        stamp = f"stamp_{channel}"
        function.assign(stamp, f"at_ns - min(now - {stamp}, LONGEST)")
    for name in layout.memories:
        function.line(f"{name}.forget()")
    for _, name in _recent(layout):
        function.line(f"{name}.forget(at_ns)")
    for index, _ in layout.held:
        function.assign(f"due_{index}", "NEVER")
        function.assign(f"before_{index}", "2")
    for guard in layout.guards:
        function.assign(guard.low, "INF")
    for index in layout.kept:
        function.assign(f"t{index}", "-1")
    return function.text()
