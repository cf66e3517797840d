"""The result of the migration of one file, with the facts that other files need."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field

from dslkit.diagnostics import Diagnostic
from dslkit.source import SourceFile
from ezskiros.migrate.bases import BuiltClass, ClassId
from ezskiros.migrate.consequences import Follower, LeftSkill
from ezskiros.migrate.robots import Robots
from ezskiros.migrate.shared_keys import SharingTree
from ezskiros.migrate.skills import Skill, SkillId


@dataclass(frozen=True)
class Migrated:
    """A file after its migration. `text` is the original text if nothing has changed.

    `translated` and `left` are the classes that describe skills, `implemented` and `unimplemented`
    those that implement them, `bases` those that any class is built on. `built` are all classes,
    `obstacles` those for which others of the same base are left, with the codes for which they are.

    `skills` are what is described, `robots` what is said of their robots, `labels` what
    implementations call themselves, with the names of their classes, `sources` the modules that are
    imported, `wanted` the files that trees need besides, `trees` what their children share,
    `left_skills` the skills that are left, `followers` the implementations that are left for them.
    """

    file: SourceFile
    text: str
    translated: Sequence[str] = ()
    left: Sequence[str] = ()
    implemented: Sequence[str] = ()
    unimplemented: Sequence[str] = ()
    bases: Collection[str] = ()
    built: Sequence[BuiltClass] = ()
    obstacles: Mapping[ClassId, Sequence[str]] = field(default_factory=dict)
    skills: Sequence[Skill] = ()
    robots: Robots = field(default_factory=Robots)
    labels: Mapping[str, str] = field(default_factory=dict)
    sources: Collection[str] = ()
    wanted: Collection[str] = ()
    trees: Sequence[SharingTree] = ()
    followers: Sequence[Follower] = ()
    left_skills: Mapping[SkillId, LeftSkill] = field(default_factory=dict)
    diagnostics: Sequence[Diagnostic] = ()

    def needs(self, skills: Collection[SkillId]) -> bool:
        """Say whether the file describes one of some skills, or has trees with them."""
        named = {each.id for tree in self.trees for each in tree.skills}
        return any(each in named or each[0] == self.file.path for each in skills)
