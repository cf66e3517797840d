"""The state of an interpreter after each evaluation of a trace, in columns: the propositions, and
the numbers that are compared with constants.
"""

from __future__ import annotations

from array import array
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rossmarie import ir
from rossmarie.interpreter import Interpreter


@dataclass(frozen=True)
class ElementHistory:
    """The values of an elementwise signal, concatenated. Sequence i belongs to row `rows[i]`, and
    reaches from `starts[i]` up to, not including, `ends[i]`.
    """

    values: NDArray[np.float64]
    starts: NDArray[np.int64]
    ends: NDArray[np.int64]
    rows: NDArray[np.int64]


@dataclass(frozen=True)
class History:
    """A row for each evaluation, in the order of the trace. `propositions` has a column for each
    proposition; propositions over single elements are always unknown in it. `ages_ns` contains the
    ages in ns of the inputs whose age a rule uses, -1 before the first message.
    """

    at_ns: NDArray[np.int64]
    propositions: NDArray[np.int8]
    signals: dict[int, NDArray[np.float64]]
    elements: dict[int, ElementHistory]
    ages_ns: dict[int, NDArray[np.int64]]


def backwards(at_ns: NDArray[np.int64]) -> NDArray[np.bool_]:
    """A mask of the rows before which the clock was set back."""
    return np.append(False, np.diff(at_ns) < 0)


class HistoryRecorder:
    """Keeps the history of one trace. The machine watches all its propositions. `signals` are the
    signals whose values are recorded.
    """

    def __init__(self, machine: ir.Machine, signals: Sequence[int]) -> None:
        arrays = ir.element_arrays(machine).signals
        self._columns = {index: array("d") for index in signals if arrays[index] is None}
        self._elements = {
            index: _Sequences(index, its) for index in signals if (its := arrays[index]) is not None
        }
        nodes = [proposition.node for proposition in machine.propositions]
        self._ages_ns = {
            node.input: array("q") for node in nodes if isinstance(node, ir.AgeReaches)
        }
        self._at_ns = array("q")
        self._propositions = bytearray()

    def keep(self, at_ns: int, interpreter: Interpreter) -> None:
        """Store the state of the interpreter after an evaluation at an instant."""
        self._at_ns.append(at_ns)
        self._propositions.extend(interpreter.watches)
        signals = interpreter.signals
        for index, column in self._columns.items():
            column.append(signals[index])
        for used, ages_ns in self._ages_ns.items():
            age_ns = interpreter.age_ns(used)
            ages_ns.append(-1 if age_ns is None else age_ns)
        for sequences in self._elements.values():
            sequences.keep(interpreter)

    def history(self) -> History:
        """All rows so far."""
        rows = len(self._at_ns)
        return History(
            at_ns=np.array(self._at_ns, dtype=np.int64),
            propositions=np.frombuffer(bytes(self._propositions), dtype=np.int8).reshape(rows, -1),
            signals={index: np.array(column) for index, column in self._columns.items()},
            elements={index: found.elements() for index, found in self._elements.items()},
            ages_ns={used: np.array(ages) for used, ages in self._ages_ns.items()},
        )


class _Sequences:
    """The values of one elementwise signal."""

    def __init__(self, signal: int, its_array: int) -> None:
        self._signal = signal
        self._array = its_array
        self._present: Sequence[float] | None = None
        self._values = array("d")
        self._starts = array("q")
        self._rows = array("q")

    def keep(self, interpreter: Interpreter) -> None:
        present = interpreter.arrays[self._array]
        if present is not self._present:  # changed by a message, or by a timeout
            self._present = present
            self._starts.append(len(self._values))
            self._values.extend(interpreter.elements(self._signal))
        self._rows.append(len(self._starts) - 1)

    def elements(self) -> ElementHistory:
        starts = np.array(self._starts, dtype=np.int64)
        return ElementHistory(
            values=np.array(self._values),
            starts=starts,
            ends=np.append(starts[1:], len(self._values)).astype(np.int64),
            rows=np.array(self._rows, dtype=np.int64),
        )
