"""The values of a task as in SkiROS2: one blackboard for the skills of all levels.

Each parameter has a key on the blackboard. A value that is passed to a child renames a key of the
child and of all skills below it; SkiROS2 drops some of these renamings. A parameter with a default
or a given value never reads from the blackboard, but writes its own value there.

A value is in a cell, a list with at most one item, as in SkiROS2. Cells are shared, not copied: if
a primitive writes into its cell, all skills with the same cell see the value.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from ezskiros.engine.plans import ChildStart
from ezskiros.engine.values import WorldIndividual
from ezskiros.engine.world import World
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.interface import ROBOT, Parameter
from ezskiros.trees.tree import IndividualReference, ValueReference

Cell = list[Any]
"""A list with the value; empty without a value. For an unknown individual the value is None:
SkiROS2 has an element without a name there, which counts as a value.
"""


class Remaps:
    """The keys of a skill during renaming, in SkiROS2's order and with the keys that it drops."""

    def __init__(self, keys: Iterable[str]) -> None:
        self._own = {key: key for key in (*keys, ROBOT)}
        self._known: dict[str, str] = {}

    def add(self, key: str, other: str) -> None:
        """Rename a key, unless it was renamed before or the other key is used here."""
        if key in self._known:
            return
        other = self._known.get(other, other)
        if other in self._own:
            return
        if key in self._own:
            self._own[other] = self._own.pop(key)
        self._known[key] = other

    def add_all(self, above: Remaps) -> None:
        """Apply the renamings of the parent skill, as SkiROS2 does when it adds a child."""
        for key, other in above._known.items():
            self.add(key, other)

    def by_own(self) -> dict[str, str]:
        """The blackboard keys by the skill's own keys."""
        return {own: key for key, own in self._own.items()}


def remaps_of(call: SkillCall, plan: ChildStart, above: Remaps | None) -> Remaps:
    """The keys of a child: first its call renames them, then the skills above it."""
    parameters = {each.name: each.key for each in plan.skill.parameters}
    found = Remaps(parameters.values())
    for name, value in call.arguments.items():
        if isinstance(value, (IndividualReference, ValueReference)):
            found.add(parameters[name], value.parameter.key)
    if above is not None:
        found.add_all(above)
    return found


class Blackboard:
    """The cells of a task by key. A key has the type of the first value that was written to it."""

    def __init__(self) -> None:
        self._cells: dict[str, tuple[type, Cell]] = {}

    def read(self, key: str, kind: type) -> Cell | None:
        """The cell of a key; None if the key has no value of the type."""
        _, cell = self._cells.get(key, (kind, None))
        return cell if cell is not None and _is_of(cell, kind) else None

    def write(self, key: str, kind: type, cell: Cell) -> None:
        """Put a cell under a key, unless its value is of another type. An empty cell removes the
        key.
        """
        known = self._cells.get(key, (kind, cell))[0]
        if not cell:
            self._cells.pop(key, None)
        elif _is_of(cell, known):
            self._cells[key] = known, cell


class Cells:
    """The cells of the parameters of one skill."""

    def __init__(
        self, plan: ChildStart, keys: Mapping[str, str], blackboard: Blackboard, world: World
    ) -> None:
        self._parameters = [
            (each, keys[each.key], _kind(each), plan.fixed[each.name])
            for each in plan.skill.parameters
        ]
        self._blackboard, self._world = blackboard, world
        self._cells: dict[str, Cell] = {}

    def start(self) -> dict[str, Any]:
        """The values at the start of the skill: by default, by the call, or from the blackboard."""
        for parameter, _, _, fixed in self._parameters:
            is_empty = fixed is None and not parameter.is_individual
            self._cells[parameter.name] = [] if is_empty else [fixed]
        return self.read()

    def read(self) -> dict[str, Any]:
        """The values, updated from the blackboard. An individual that no longer exists becomes
        None.

        A parameter that has lost its key keeps its value.
        """
        for parameter, key, kind, fixed in self._parameters:
            found = self._blackboard.read(key, kind)
            if found is not None and (
                fixed is None or (parameter.is_individual and found == [fixed])
            ):
                self._cells[parameter.name] = found
            if parameter.is_individual:
                self._forget_what_is_gone(self._cells[parameter.name])
        return self.values()

    def values(self) -> dict[str, Any]:
        """The values in the cells."""
        return {name: cell[0] if cell else None for name, cell in self._cells.items()}

    def replace(self, values: Mapping[str, Any]) -> None:
        """Replace values, for example by inferred individuals."""
        for name, cell in self._cells.items():
            if values[name] is not None and cell != [values[name]]:
                self._cells[name] = [values[name]]

    def fill(self, values: Mapping[str, Any]) -> None:
        """Write the values that the skill has set into their cells, and remove the values that it
        has cleared.
        """
        for name, value in values.items():
            cell = self._cells[name]
            if value is None:
                if cell and cell[0] is not None:
                    self._cells[name] = []
            else:
                cell[:] = [value]

    def share(self) -> None:
        """Put all cells on the blackboard."""
        for parameter, key, kind, _ in self._parameters:
            self._blackboard.write(key, kind, self._cells[parameter.name])

    def _forget_what_is_gone(self, cell: Cell) -> None:
        if cell and cell[0] is not None and not self._world.exists(cell[0].iri):
            cell.clear()


def _kind(parameter: Parameter) -> type:
    """The type of the values of a parameter. For SkiROS2 all individuals have one type."""
    return WorldIndividual if parameter.is_individual else parameter.type


def _is_of(cell: Cell, kind: type) -> bool:
    return all(
        isinstance(each, kind) or (each is None and kind is WorldIndividual) for each in cell
    )
