"""A monitor in Python that was generated for a machine: the same methods and events as `native`'s.

Takes the machine and the text that the Python target wrote for it.
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
    `ir.LATEST_NS`; every method that takes one raises `ValueError` outside that range.
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
        """Another monitor of the same machine, that has seen nothing."""
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
        """The values of the signals that memories of poses ask, by index; NaN is unknown."""
        return tuple(self._generated.readings()) if self._has_readings else ()

    def update(self, at_ns: int, messages: Mapping[int, ChannelValues]) -> list[Event]:
        """The messages that arrive at one instant, by channel index."""
        fields = {channel: self._fields(channel, values) for channel, values in messages.items()}
        return self._events_of(at_ns, self._generated.update, fields)

    def advance(self, at_ns: int) -> list[Event]:
        """Time passes without a message; timers due at this very instant fire as well."""
        return self._events_of(at_ns, self._generated.advance)

    def reset(self, at_ns: int, rule: int | None = None) -> list[Event]:
        """An operator resets one latched rule, or all: those with a false condition clear."""
        return self._events_of(at_ns, self._generated.reset, rule)

    def __deepcopy__(self, memo: object) -> PythonMonitor:
        """Another one that knows the same: functions would be shared, with what they remember."""
        another = self.fresh()
        another.load(self.save())
        another._waiting = list(self._waiting)  # noqa: SLF001 - of this class
        return another

    # --- its memory --------------------------------------------------------------------------

    def save(self) -> object:
        """All that it knows: what its functions remember between calls."""
        return deepcopy({name: cell.cell_contents for name, cell in self._cells().items()})

    def load(self, saved: object) -> None:
        """Know what another monitor of the same rules has known."""
        assert isinstance(saved, dict)
        for name, cell in self._cells().items():
            cell.cell_contents = deepcopy(saved[name])

    def _cells(self) -> dict[str, CellType]:
        """The variables that the generated functions share, but for other functions."""
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

    # --- fast --------------------------------------------------------------------------------

    def update_call(self, channel: int) -> Callable[..., int]:
        """A function `(at_ns, *slots) -> number of new events` for one message on a channel, with
        its slots in index order, in the units of the message. -1: the instant is out of range.

        Its numbers are Python's own (numpy has some that compare otherwise). The events wait for
        `take_events`. Raises `ValueError` if the channel carries arrays.
        """
        if self._arrays[channel]:
            raise ValueError("a channel with arrays has no fast call")
        return self.message_call(channel)

    def message_call(self, channel: int) -> Callable[..., int]:
        """The same for any channel: its arrays stand behind its slots."""
        call: Callable[..., int] = self._generated[channel]
        return call

    def take_events(self) -> list[Event]:
        """The events of the fast calls since the last time."""
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
        """The events of fast calls wait."""
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
        """One message: its slots, then its arrays."""
        slots = [values.slots.get(slot, _NAN) for slot in self._slots[channel]]
        return [*slots, *(self._elements(array, values) for array in self._arrays[channel])]

    def _elements(self, array: int, values: ChannelValues) -> list[float] | None:
        """The elements of an array; of a column that the message lacks, None."""
        if array not in values.arrays and self._is_column[array]:
            return None
        return list(values.arrays.get(array, ()))


def _by_channel(machine: ir.Machine, fields: Sequence[ir.Slot]) -> list[list[int]]:
    """The fields that each channel carries, by index."""
    carried: list[list[int]] = [[] for _ in machine.channels]
    for index, field in enumerate(fields):
        carried[machine.inputs[field.input].channel].append(index)
    return carried
