"""The knowledge at one point of a behavior tree: the conditions that hold, and their origins."""

from __future__ import annotations

import enum
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TypeAlias

from dslkit.source import Span
from ezskiros.check.inference import names as names_of
from ezskiros.ontology.statements import Statement
from ezskiros.skills.calls import SkillCall


@dataclass(frozen=True)
class Origin:
    """The origin of a fact: a condition, and the child that has it; None if the compound has it.

    `kind` is pre, hold, post or parameter.
    """

    span: Span
    kind: str
    call: SkillCall | None = None


class How(enum.Enum):
    """The certainty of a change: certain or possible."""

    DONE = "done"
    FAILED = "failed"
    """The child has failed: the change may have happened."""
    BESIDE = "beside"
    """The child runs at the same time: the change happens before or after."""


@dataclass(frozen=True)
class Renewed:
    """A name that stands for another individual than before."""

    subject: str


Made: TypeAlias = "Statement | Renewed"
"""The effect of a change."""


@dataclass(frozen=True)
class WorldChange:
    """A change that a child makes to the world, or to a name."""

    made: Made
    origin: Origin
    how: How


@dataclass(frozen=True)
class NameKnowledge:
    """The knowledge of a name of the tree: the possible classes of its individual.

    The compound's own parameters stand for different individuals.
    """

    classes: frozenset[str]
    is_own: bool


@dataclass(frozen=True)
class KnownFacts:
    """The knowledge at one point.

    `bound` are names with a value, and `perhaps` are names that may have one, because a child that
    finds it may have failed or not have run. `same` maps names to other names of the same
    individual. `changes` are all changes on the path to this point, in order, and `trail` describes
    the path. A `dead` point is never reached.
    """

    facts: Mapping[Statement, Origin]
    bound: frozenset[str]
    perhaps: frozenset[str] = frozenset()
    same: Mapping[str, str] = field(default_factory=dict)
    changes: Mapping[WorldChange, None] = field(default_factory=dict)
    trail: tuple[str, ...] = ()
    is_dead: bool = False

    @cached_property
    def said(self) -> tuple[Statement, ...]:
        """The stated facts in their order; their consequences are derived from them."""
        return tuple(self.facts)

    @property
    def without_trail(self) -> tuple[object, ...]:
        """The knowledge that the next steps depend on, without the path so far."""
        facts, same = tuple(self.facts.items()), frozenset(self.same.items())
        return facts, self.bound, self.perhaps, same, self.is_dead

    def after(self, before: KnownFacts) -> KnownFacts:
        """The same knowledge, with more changes on the path so far."""
        changes = later(before.changes, self.changes)
        return replace(self, changes=changes, trail=(*before.trail, *self.trail))

    def one(self, name: str) -> str:
        """The representative of all names of an individual."""
        return self.same.get(name, name)

    def assuming(self, said: Mapping[Statement, Origin]) -> KnownFacts:
        """The knowledge with more facts."""
        return replace(self, facts={**said, **self.facts})

    def without(self, lost: Iterable[Statement]) -> KnownFacts:
        """The knowledge without some facts."""
        gone = set(lost)
        if not gone:
            return self
        return replace(self, facts={k: v for k, v in self.facts.items() if k not in gone})

    def binding(self, names: Iterable[str]) -> KnownFacts:
        """The knowledge with more names that have a value."""
        bound = self.bound.union(names)
        return self if bound == self.bound else replace(self, bound=bound)

    def is_free(self, name: str) -> bool:
        """Say whether a name certainly has no value yet."""
        return name not in self.bound and name not in self.perhaps

    def is_as_much_as(self, other: KnownFacts) -> bool:
        """Say whether the facts and the names are equal."""
        names, other_names = self.bound | self.perhaps, other.bound | other.perhaps
        is_same = self.facts.keys() == other.facts.keys() and self.bound == other.bound
        return is_same and names == other_names

    def perhaps_binding(self, names: Iterable[str]) -> KnownFacts:
        """The knowledge with more names that may have a value."""
        perhaps = self.perhaps.union(names)
        return self if perhaps == self.perhaps else replace(self, perhaps=perhaps)

    def unbinding(self, name: str) -> KnownFacts:
        """Forget everything about a name."""
        same = {k: v for k, v in self.same.items() if name not in (k, v)}
        gone = [each for each in self.facts if name in names_of(each)]
        return replace(
            self.without(gone), bound=self.bound - {name}, perhaps=self.perhaps - {name}, same=same
        )

    def by(self, *steps: str) -> KnownFacts:
        """The knowledge with a longer description of the path."""
        return replace(self, trail=(*self.trail, *steps))


def later(
    before: Mapping[WorldChange, None], changes: Iterable[WorldChange]
) -> Mapping[WorldChange, None]:
    """Changes followed by later ones. A repeated change is only at its last position."""
    found = dict(before)
    for each in changes:
        found.pop(each, None)
        found[each] = None
    return found
