"""Random columns for a random machine, and the same as messages row by row.

table = draw(tables(machine))
monitor.run(table.times_ns, table.columns)  # is as one update for each of table.rows
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np
from hypothesis import strategies as st

from rossmarie import ir
from support.machines import instants, raw

Cell: TypeAlias = float | list[float]

_OTHER = "something else"


@dataclass
class Table:
    """Columns by name, and what they mean: the messages of each row, by channel."""

    times_ns: np.ndarray
    columns: dict[str, np.ndarray] = field(default_factory=dict)
    rows: list[dict[int, ir.ChannelValues]] = field(default_factory=list)


@st.composite
def tables(draw: st.DrawFn, machine: ir.Machine, most: int = 16) -> Table:
    """A table with a column for every field, and for some of the inputs without fields."""
    times = draw(instants(most))
    slots = [_column(draw, slot.kind, len(times)) for slot in machine.slots]
    widths = [draw(st.integers(0, each.most + 1)) for each in machine.lists]
    arrays = [
        _array(draw, len(times))
        if array.list is None
        else _array(draw, len(times), widths[array.list], array.kind)
        for array in machine.arrays
    ]
    table = Table(np.array(times, np.int64))
    slot_names, array_names = ir.field_names(machine)
    for names, slot, values in zip(slot_names, machine.slots, slots, strict=True):
        name = draw(st.sampled_from(sorted(names)))
        table.columns[name] = draw(_SHAPES[slot.kind])(machine, values)
    for names, array, rows in zip(array_names, machine.arrays, arrays, strict=True):
        column: np.ndarray = np.array(rows).reshape(len(times), -1)
        if array.kind is ir.FieldKind.TEXT:
            column = _as_strings(machine, column.reshape(-1).tolist()).reshape(column.shape)
        table.columns[draw(st.sampled_from(sorted(names)))] = column
    given = {name: used for name, used in ir.arrival_names(machine).items() if draw(st.booleans())}
    table.columns |= {name: np.full(len(times), np.nan) for name in given}
    table.rows = [_row(machine, set(given.values()), slots, arrays, i) for i in range(len(times))]
    return table


def _column(draw: st.DrawFn, kind: ir.FieldKind, rows: int) -> list[float]:
    if kind is ir.FieldKind.TEXT:  # a column of strings has no missing ones
        return draw(st.lists(st.sampled_from((0.0, 1.0, -1.0)), min_size=rows, max_size=rows))
    return draw(st.lists(raw(kind), min_size=rows, max_size=rows))


def _array(
    draw: st.DrawFn, rows: int, width: int | None = None, kind: ir.FieldKind = ir.FieldKind.REAL
) -> list[list[float]]:
    if width is None:
        width = draw(st.integers(0, 3))
    known = st.sampled_from((0.0, 1.0, -1.0))
    row = st.lists(
        known if kind is ir.FieldKind.TEXT else raw(kind), min_size=width, max_size=width
    )
    return draw(st.lists(row, min_size=rows, max_size=rows))


def _row(
    machine: ir.Machine,
    arriving: set[int],
    slots: list[list[float]],
    arrays: list[list[list[float]]],
    row: int,
) -> dict[int, ir.ChannelValues]:
    """One message on each channel that has a column."""
    inputs = machine.inputs
    found: dict[int, ir.ChannelValues] = {}
    for channel in range(len(machine.channels)):
        message = ir.ChannelValues(
            {i: slots[i][row] for i, x in enumerate(machine.slots)
             if inputs[x.input].channel == channel},
            {i: arrays[i][row] for i, x in enumerate(machine.arrays)
             if inputs[x.input].channel == channel},
        )  # fmt: skip
        if message.slots or message.arrays or channel in arriving:
            found[channel] = message
    return found


# --- the same values in several types --------------------------------------------------------

_Shape: TypeAlias = Callable[[ir.Machine, list[float]], np.ndarray]


def _as_doubles(_: ir.Machine, values: list[float]) -> np.ndarray:
    return np.array(values, np.float64)


def _as_every_other(_: ir.Machine, values: list[float]) -> np.ndarray:
    return np.repeat(np.array(values, np.float64), 2)[::2]


def _as_flags(_: ir.Machine, values: list[float]) -> np.ndarray:
    """As booleans if all are known."""
    column = np.array(values, np.float64)
    return column if np.isnan(column).any() else column.astype(np.bool_)


def _as_strings(machine: ir.Machine, values: list[float]) -> np.ndarray:
    strings = [_OTHER if value < 0 else machine.texts[int(value)] for value in values]
    return np.array(strings, np.str_)


def _as_objects(machine: ir.Machine, values: list[float]) -> np.ndarray:
    return _as_strings(machine, values).astype(object)


_SHAPES: dict[ir.FieldKind, st.SearchStrategy[_Shape]] = {
    ir.FieldKind.REAL: st.sampled_from((_as_doubles, _as_every_other)),
    ir.FieldKind.FLAG: st.sampled_from((_as_doubles, _as_flags)),
    ir.FieldKind.TEXT: st.sampled_from((_as_strings, _as_objects)),
}
