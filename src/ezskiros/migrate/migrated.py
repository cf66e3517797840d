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
from ezskiros.migrate.skills import MigratedSkill, SkillId


@dataclass(frozen=True)
class Migrated:
    """A file after its migration. `text` is the original text if nothing has changed.

    `translated` and `left` are the names of description classes, `implemented` and `unimplemented`
    those of implementation classes, and `bases` those of base classes. `built` are all classes.
    `obstacles` are the classes because of which related classes stay unchanged, with the codes of
    their findings.

    `skills` are the described skills, and `robots` the uses of their robots. `labels` are the names
    that implementations give themselves, with their class names. `sources` are the imported
    modules, and `wanted` the files that trees additionally need. `trees` are the shared keys of
    trees. `left_skills` are the unchanged skills, and `followers` the implementations that stay
    unchanged because of them.
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
    skills: Sequence[MigratedSkill] = ()
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
