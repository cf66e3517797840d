"""The context of a tree's translation: the file, its class, and the skills of all files."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field

import libcst as cst

from ezskiros.migrate.names import FileNames
from ezskiros.migrate.skills import KnownSkills, MigratedSkill
from ezskiros.migrate.values import KnownValues


@dataclass(frozen=True)
class PartPosition:
    """The position of a part in its file: the column, and the indentation of its line."""

    column: int
    indent: str


@dataclass
class WantedSkills:
    """The skills that a file names, by local name.

    `spell` gives the local name of a skill.
    """

    spell: Callable[[MigratedSkill], str]
    found: dict[str, MigratedSkill] = field(default_factory=dict)

    def name(self, skill: MigratedSkill) -> str:
        """The local name of a skill, which is needed from now on."""
        name = self.spell(skill)
        self.found[name] = skill
        return name


@dataclass(frozen=True)
class TreeContext:
    """The context in which a tree is translated.

    `path` is the file, `skills` are all described skills, `helpers` the methods of the class.
    `place` gives the position of a node, and `step` is the indentation step of the file. `late`
    gives the import of a skill that must be imported inside the tree, None for others. `states` are
    the names of SkiROS2's `State`. `names` are the names of the ontology and of EzSkiROS that the
    class uses, `known` the types of values.
    """

    path: str
    skills: KnownSkills
    wanted: WantedSkills
    helpers: Mapping[str, cst.FunctionDef]
    place: Callable[[cst.CSTNode], PartPosition]
    step: str
    late: Callable[[str, MigratedSkill], str | None]
    names: FileNames
    known: KnownValues
    states: Collection[str] = ()
