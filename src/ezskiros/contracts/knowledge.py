"""What is known at one point of a behavior tree: which conditions hold, and by whom."""

from __future__ import annotations

import enum
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

from dslkit.source import Span
from ezskiros.check.inference import names as names_of
from ezskiros.ontology.statements import Statement
from ezskiros.session import NOWHERE
from ezskiros.skills.nodes import SkillCall


@dataclass(frozen=True)
class Origin:
    """What makes something so: a condition, and the child that has it; None if the compound has it.

    `kind` is pre, hold, post or parameter.
    """

    span: Span
    kind: str
    call: SkillCall | None = None


SUPPOSED = Origin(NOWHERE, "pre")
"""Of what is supposed to see what follows."""


class How(enum.Enum):
    """Whether a change has happened."""

    DONE = "done"
    FAILED = "failed"
    """Its child has failed: it may have happened."""
    BESIDE = "beside"
    """Its child runs at the same time: it happens before or after."""


@dataclass(frozen=True)
class Renewed:
    """A name stands for another thing than before."""

    subject: str


@dataclass(frozen=True)
class Change:
    """What a child does to the world, or to a name."""

    made: Statement | Renewed
    origin: Origin
    how: How


@dataclass(frozen=True)
class Name:
    """What is known of a name of the tree: the class of its thing, one of these.

    Those of the compound's own parameters stand for different things.
    """

    classes: frozenset[str]
    is_own: bool


@dataclass(frozen=True)
class Known:
    """What is known at one point.

    `same` names names that stand for the thing of another; `changes` are all that have been on the
    way here; `trail` says which way that is. What is `dead` is never reached.
    """

    facts: Mapping[Statement, Origin]
    bound: frozenset[str]
    same: Mapping[str, str] = field(default_factory=dict)
    changes: tuple[Change, ...] = ()
    trail: tuple[str, ...] = ()
    is_dead: bool = False

    def one(self, name: str) -> str:
        """A name, or the one that stands for the same thing."""
        return self.same.get(name, name)

    def assuming(self, said: Mapping[Statement, Origin]) -> Known:
        """With more that holds."""
        return replace(self, facts={**said, **self.facts})

    def without(self, lost: Iterable[Statement]) -> Known:
        """With less that is known."""
        gone = set(lost)
        return replace(self, facts={k: v for k, v in self.facts.items() if k not in gone})

    def binding(self, names: Iterable[str]) -> Known:
        """With names that stand for something."""
        return replace(self, bound=self.bound.union(names))

    def unbinding(self, name: str) -> Known:
        """With a name of which nothing is known."""
        same = {k: v for k, v in self.same.items() if name not in (k, v)}
        gone = [each for each in self.facts if name in names_of(each)]
        return replace(self.without(gone), bound=self.bound - {name}, same=same)

    def by(self, *steps: str) -> Known:
        """On a way that is described further."""
        return replace(self, trail=(*self.trail, *steps))
