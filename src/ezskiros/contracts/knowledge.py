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
    """The certainty of a change: it has happened, or it may have."""

    DONE = "done"
    FAILED = "failed"
    """Its child has failed: it may have happened."""
    BESIDE = "beside"
    """Its child runs at the same time: it happens before or after."""


@dataclass(frozen=True)
class Renewed:
    """A name stands for another thing than before."""

    subject: str


Made: TypeAlias = "Statement | Renewed"
"""The effect of a change."""


@dataclass(frozen=True)
class Change:
    """A change that a child makes to the world, or to a name."""

    made: Made
    origin: Origin
    how: How


@dataclass(frozen=True)
class Name:
    """The knowledge of a name of the tree: the class of its thing, one of these.

    Those of the compound's own parameters stand for different things.
    """

    classes: frozenset[str]
    is_own: bool


@dataclass(frozen=True)
class Known:
    """The knowledge at one point.

    Names that are `bound` stand for something, those that are `perhaps` may: what children would
    find that have failed, or that may not have run. `same` names names that stand for the thing of
    another; `changes` are all that have been on the way here, in order; `trail` says which way that
    is. What is `dead` is never reached.
    """

    facts: Mapping[Statement, Origin]
    bound: frozenset[str]
    perhaps: frozenset[str] = frozenset()
    same: Mapping[str, str] = field(default_factory=dict)
    changes: Mapping[Change, None] = field(default_factory=dict)
    trail: tuple[str, ...] = ()
    is_dead: bool = False

    @cached_property
    def said(self) -> tuple[Statement, ...]:
        """The stated facts in their order; their consequences are derived from them."""
        return tuple(self.facts)

    @property
    def without_way(self) -> tuple[object, ...]:
        """The knowledge that the next steps depend on, without the path so far."""
        facts, same = tuple(self.facts.items()), frozenset(self.same.items())
        return facts, self.bound, self.perhaps, same, self.is_dead

    def after(self, before: Known) -> Known:
        """The same where more has been on the way here."""
        changes = later(before.changes, self.changes)
        return replace(self, changes=changes, trail=(*before.trail, *self.trail))

    def one(self, name: str) -> str:
        """A name, or the representative of its thing."""
        return self.same.get(name, name)

    def assuming(self, said: Mapping[Statement, Origin]) -> Known:
        """With more that holds."""
        return replace(self, facts={**said, **self.facts})

    def without(self, lost: Iterable[Statement]) -> Known:
        """With less that is known."""
        gone = set(lost)
        if not gone:
            return self
        return replace(self, facts={k: v for k, v in self.facts.items() if k not in gone})

    def binding(self, names: Iterable[str]) -> Known:
        """With names that stand for something."""
        bound = self.bound.union(names)
        return self if bound == self.bound else replace(self, bound=bound)

    def is_free(self, name: str) -> bool:
        """Say whether a name stands for nothing yet, for certain."""
        return name not in self.bound and name not in self.perhaps

    def is_as_much_as(self, other: Known) -> bool:
        """Say whether the same is known of facts and names."""
        names, other_names = self.bound | self.perhaps, other.bound | other.perhaps
        is_same = self.facts.keys() == other.facts.keys() and self.bound == other.bound
        return is_same and names == other_names

    def perhaps_binding(self, names: Iterable[str]) -> Known:
        """With names that may stand for something."""
        perhaps = self.perhaps.union(names)
        return self if perhaps == self.perhaps else replace(self, perhaps=perhaps)

    def unbinding(self, name: str) -> Known:
        """Forget everything about a name."""
        same = {k: v for k, v in self.same.items() if name not in (k, v)}
        gone = [each for each in self.facts if name in names_of(each)]
        return replace(
            self.without(gone),
            bound=self.bound - {name},
            perhaps=self.perhaps - {name},
            same=same,
        )

    def by(self, *steps: str) -> Known:
        """On a way that is described further."""
        return replace(self, trail=(*self.trail, *steps))


def later(before: Mapping[Change, None], changes: Iterable[Change]) -> Mapping[Change, None]:
    """Changes and those that come after them, each where it comes last."""
    found = dict(before)
    for each in changes:
        found.pop(each, None)
        found[each] = None
    return found
