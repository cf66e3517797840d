"""The names of the skills that trees in a file call, and the imports from other files."""

from __future__ import annotations

from collections.abc import Collection

import libcst as cst

from ezskiros.migrate.imports import Wanted, bound_names, imported_names, used_names
from ezskiros.migrate.modules import import_of
from ezskiros.migrate.skills import Skill
from ezskiros.migrate.tree_context import Wanted as WantedSkills


class ForeignSkills:
    """The skills that the trees of the file `path` name; `found` has them by how it calls them.

    What is in the files `late` is imported where a tree needs it, and not before.
    """

    def __init__(self, path: str, module: cst.Module, late: Collection[str]) -> None:
        self._path, self._late = path, late
        self._imported = imported_names(module)
        self._taken = used_names(module) | bound_names(module, ())
        self.found: dict[str, Skill] = {}

    def wanted(self) -> WantedSkills:
        """For the skills of one tree, which count only if that is translated."""
        return WantedSkills(self._spell)

    def add(self, wanted: WantedSkills) -> None:
        """A tree is translated, and needs its skills."""
        self.found |= wanted.found

    def files(self) -> set[str]:
        """The other files that have skills which are needed."""
        return {each.path for each in self.found.values()} - {self._path}

    def _spell(self, skill: Skill) -> str:
        """As it is imported, or by its name if that is free."""
        if skill.path == self._path:
            return skill.name
        for name, original in self._imported.items():
            if original == skill.name:
                return name
        for name, other in self.found.items():
            if other == skill:
                return name
        name = skill.name
        while name in self._taken or name in self.found:
            name += "_"
        return name

    def late_import(self, name: str, skill: Skill) -> str | None:
        """The import of a skill that has to wait until a tree needs it; None for others."""
        if skill.path not in self._late or skill.path == self._path:
            return None
        wanted = Wanted(import_of(self._path, skill.path), {skill.name: name})
        return "\n".join(wanted.text())

    def imports(self) -> list[Wanted]:
        """The names that have to be imported besides, by modules."""
        by_module: dict[str, dict[str, str]] = {}
        for name, skill in self.found.items():
            is_there = skill.path in (self._path, *self._late)
            if not is_there and self._imported.get(name) != skill.name:
                source = import_of(self._path, skill.path)
                by_module.setdefault(source, {})[skill.name] = name
        return [Wanted(source, names) for source, names in sorted(by_module.items())]
