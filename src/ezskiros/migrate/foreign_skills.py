"""The names of the skills that trees in a file call, and the imports from other files."""

from __future__ import annotations

from collections.abc import Collection

import libcst as cst

from ezskiros.migrate.imports import WantedNames, bound_names, imported_names, used_names
from ezskiros.migrate.modules import import_of
from ezskiros.migrate.skills import MigratedSkill
from ezskiros.migrate.tree_context import WantedSkills


class ForeignSkills:
    """The skills in trees of the file `path`. `found` has them by their local names.

    The skills of the files `late` are imported inside the trees that need them.
    """

    def __init__(self, path: str, module: cst.Module, late: Collection[str]) -> None:
        self._path, self._late = path, late
        self._imported = imported_names(module)
        self._taken = used_names(module) | bound_names(module, ())
        self.found: dict[str, MigratedSkill] = {}

    def wanted(self) -> WantedSkills:
        """The skills of one tree, which count only if the tree is translated."""
        return WantedSkills(self._spell)

    def add(self, wanted: WantedSkills) -> None:
        """Add the skills of a translated tree."""
        self.found |= wanted.found

    def files(self) -> set[str]:
        """The other files with needed skills."""
        return {each.path for each in self.found.values()} - {self._path}

    def _spell(self, skill: MigratedSkill) -> str:
        """The name of a skill: the imported name, or its own name if it is free."""
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

    def late_import(self, name: str, skill: MigratedSkill) -> str | None:
        """The import of a skill inside the tree that needs it; None for other skills."""
        if skill.path not in self._late or skill.path == self._path:
            return None
        wanted = WantedNames(import_of(self._path, skill.path), {skill.name: name})
        return "\n".join(wanted.text())

    def imports(self) -> list[WantedNames]:
        """The additional names to import, by module."""
        by_module: dict[str, dict[str, str]] = {}
        for name, skill in self.found.items():
            is_there = skill.path in (self._path, *self._late)
            if not is_there and self._imported.get(name) != skill.name:
                source = import_of(self._path, skill.path)
                by_module.setdefault(source, {})[skill.name] = name
        return [WantedNames(source, names) for source, names in sorted(by_module.items())]
