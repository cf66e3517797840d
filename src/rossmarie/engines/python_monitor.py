"""A generated monitor in Python, with the methods and events of `native`'s monitor.

The input is the machine and the text that the Python target wrote for it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from copy import copy, deepcopy
from types import CellType, FunctionType
from typing import Any

from rossmarie import ir
from rossmarie.ir import Change, ChannelValues, Event, InputState, TimeJump, TruthValue, Verdict

_NAN = float("nan")


class PythonMonitor:
    """A monitor. Instants are nanoseconds on one clock, between `ir.EARLIEST_NS` and
    `ir.LATEST_NS`. Every method with an instant raises `ValueError` outside this range.
    """

    def __init__(self, machine: ir.Machine, source: str) -> None:
        self._slots = _by_channel(machine, machine.slots)
        channels = range(len(machine.channels))
        self._arrays = [ir.arrays_of(machine, channel) for channel in channels]
        self._is_column = [array.list is not None for array in machine.arrays]
        self._has_watches = bool(machine.watches)
        self._has_margins = bool(ir.margins_of(machine))
        self._has_readings = bool(machine.readings)
        module: dict[str, Any] = {"__name__": "monitor"}
        exec(compile(source, "<generated monitor>", "exec"), module)
        self._jump = module["TimeJump"]
        self._make: Callable[[], Any] = module["start"]
        self._begin()

    def _begin(self) -> None:
        self._generated = self._make()
        self._waiting: list[Event] = []
        self.next_wake: Callable[[], int | None] = self._generated.next_wake

    def fresh(self) -> PythonMonitor:
        """Another monitor of the same machine in its initial state."""
        another = copy(self)
        another._begin()  # noqa: SLF001 - of this class
        return another

    @property
    def active(self) -> tuple[bool, ...]:
        """The rules that are active, by index."""
        active: tuple[bool, ...] = self._generated.active()
        return active

    @property
    def watches(self) -> tuple[TruthValue, ...]:
        """The values of the watched propositions, by index."""
        return tuple(map(TruthValue, self._generated.watches())) if self._has_watches else ()

    @property
    def margins(self) -> tuple[float, ...]:
        """The margins that rules declare, in SI units, in the order of the rules."""
        if not self._has_margins:
            return ()
        margins: tuple[float, ...] = self._generated.margins()
        return margins

    @property
    def readings(self) -> tuple[float, ...]:
        """The values of the signals that memories of poses use, by index; NaN if unknown."""
        return tuple(self._generated.readings()) if self._has_readings else ()

    def update(self, at_ns: int, messages: Mapping[int, ChannelValues]) -> list[Event]:
        """Process the messages that arrive at one instant, by channel index."""
        fields = {channel: self._fields(channel, values) for channel, values in messages.items()}
        return self._events_of(at_ns, self._generated.update, fields)

    def advance(self, at_ns: int) -> list[Event]:
        """Let time pass without a message. Timers that are due exactly at this instant fire."""
        return self._events_of(at_ns, self._generated.advance)

    def reset(self, at_ns: int, rule: int | None = None) -> list[Event]:
        """Reset one latched rule, or all latched rules if `rule` is None, for an operator. Latched
        rules with a false condition are cleared.
        """
        return self._events_of(at_ns, self._generated.reset, rule)

    def __deepcopy__(self, memo: object) -> PythonMonitor:
        """A copy with the same state. An ordinary copy would share the functions, and the state
        inside them.
        """
        another = self.fresh()
        another.load(self.save())
        another._waiting = list(self._waiting)  # noqa: SLF001 - of this class
        return another

    # --- state -------------------------------------------------------------------------------

    def save(self) -> object:
        """The whole state: the variables that the monitor's functions keep between calls."""
        return deepcopy({name: cell.cell_contents for name, cell in self._cells().items()})

    def load(self, saved: object) -> None:
        """Restore the state of another monitor of the same rules."""
        assert isinstance(saved, dict)
        for name, cell in self._cells().items():
            cell.cell_contents = deepcopy(saved[name])

    def _cells(self) -> dict[str, CellType]:
        """The variables that the generated functions share, without the functions among them."""
        found: dict[str, CellType] = {}
        waiting: list[Any] = list(self._generated)
        seen: set[Any] = set()
        while waiting:
            function = waiting.pop()
            if function in seen or not isinstance(function, FunctionType):
                continue
            seen.add(function)
            names = function.__code__.co_freevars
            for name, cell in zip(names, function.__closure__ or (), strict=True):
                content = cell.cell_contents
                inner = content if isinstance(content, tuple) else (content,)
                functions = [each for each in inner if isinstance(each, FunctionType)]
                waiting += functions
                if not functions:
                    found[name] = cell
        return found

    # --- fast calls --------------------------------------------------------------------------

    def update_call(self, channel: int) -> Callable[..., int]:
        """A function for one message on a channel: `(at_ns, *slots) -> number of new events`. Slots
        are in index order, in the units of the message. The result -1 means that the instant is out
        of range.

        Numbers are Python's own types, because some NumPy types compare differently. The events
        wait for `take_events`. Raises `ValueError` if the channel carries arrays.
        """
        if self._arrays[channel]:
            raise ValueError("a channel with arrays has no fast call")
        return self.message_call(channel)

    def message_call(self, channel: int) -> Callable[..., int]:
        """A similar function for any channel. The arrays follow the slots."""
        call: Callable[..., int] = self._generated[channel]
        return call

    def take_events(self) -> list[Event]:
        """The events of the fast calls since the last call of this method."""
        self._keep()
        taken, self._waiting = self._waiting, []
        return taken

    # --- calls -------------------------------------------------------------------------------

    def _events_of(self, at_ns: int, call: Callable[..., int], *arguments: object) -> list[Event]:
        self._keep()
        if call(at_ns, *arguments) < 0:
            raise ValueError(f"an instant of {at_ns} ns is out of range")
        return [self._event(reported) for reported in self._generated.take_events()]

    def _keep(self) -> None:
        """Store the events of fast calls until `take_events`."""
        self._waiting += [self._event(reported) for reported in self._generated.take_events()]

    def _event(self, reported: Any) -> Event:
        if isinstance(reported, self._jump):
            return TimeJump(*reported)
        return Verdict(
            rule=reported.rule,
            at_ns=reported.at_ns,
            change=Change(reported.change),
            truth_values=tuple(map(TruthValue, reported.truth_values)),
            since_ns=reported.since_ns,
            values=reported.values,
            inputs=tuple(map(InputState, reported.inputs)),
        )

    def _fields(self, channel: int, values: ChannelValues) -> list[object]:
        """The fields of one message: its slots, then its arrays."""
        slots = [values.slots.get(slot, _NAN) for slot in self._slots[channel]]
        return [*slots, *(self._elements(array, values) for array in self._arrays[channel])]

    def _elements(self, array: int, values: ChannelValues) -> list[float] | None:
        """The elements of an array; None for a column that is missing in the message."""
        if array not in values.arrays and self._is_column[array]:
            return None
        return list(values.arrays.get(array, ()))


def _by_channel(machine: ir.Machine, fields: Sequence[ir.Slot]) -> list[list[int]]:
    """The fields that each channel carries, by index."""
    carried: list[list[int]] = [[] for _ in machine.channels]
    for index, field in enumerate(fields):
        carried[machine.inputs[field.input].channel].append(index)
    return carried
