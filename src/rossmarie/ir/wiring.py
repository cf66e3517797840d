"""The places of message fields in flat arrays: fields of inputs in observations, fields of commands
in actions.
"""

from __future__ import annotations

from dataclasses import dataclass

from rossmarie.ir.model import Machine
from rossmarie.ir.path import AXES, POINTS
from rossmarie.ir.support import columns_of


@dataclass(frozen=True)
class FieldPart:
    """The numbers of a field: `count` numbers from index `first` on, `step` apart; none if the
    arrays do not contain the field. A number x stands for `x * scale + offset` in the unit of the
    message; with `is_flag`, it stands for a flag.
    """

    first: int = 0
    count: int = 0
    step: int = 1
    scale: float = 1.0
    offset: float = 0.0
    is_flag: bool = False

    @property
    def places(self) -> range:
        """The indexes of its numbers."""
        return range(self.first, self.first + self.count * self.step, self.step)


@dataclass(frozen=True)
class CommandPart:
    """A field of a command that actions have."""

    command: int
    field: int
    part: FieldPart


@dataclass(frozen=True)
class Publication:
    """A command that a task publishes. Its numbers replace the numbers of the action while the task
    is in force, or once. They are in the order of the parts of the command.
    """

    task: int
    command: int
    is_lasting: bool
    numbers: tuple[float, ...]


@dataclass(frozen=True)
class PointColumns:
    """The arrays of a machine that are columns of one cloud, and the coordinates among them. A
    point with a NaN coordinate does not count (S57).
    """

    columns: tuple[int, ...]
    axes: tuple[int, ...]


@dataclass(frozen=True)
class Wiring:
    """The wiring for arrays of these sizes. `slots` and `arrays` have an entry for each slot and
    array of the machine. `arriving` are the channels with a message in each observation. `commands`
    are sorted by command. `clouds` are all clouds that the machine reads.
    """

    observed: int
    acted: int
    slots: tuple[FieldPart, ...]
    arrays: tuple[FieldPart, ...]
    arriving: frozenset[int]
    commands: tuple[CommandPart, ...]
    publications: tuple[Publication, ...]
    clouds: tuple[PointColumns, ...] = ()


def point_columns(machine: Machine) -> tuple[PointColumns, ...]:
    """The columns of all clouds that a machine reads."""
    found = []
    for index, each in enumerate(machine.lists):
        if POINTS in each.path:
            columns = columns_of(machine, index)
            axes = (column for column in columns if machine.arrays[column].path[-1] in AXES)
            found.append(PointColumns(columns, tuple(axes)))
    return tuple(found)
