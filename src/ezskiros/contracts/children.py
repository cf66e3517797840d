"""A child of a tree: its conditions and changes, with the names of the tree."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from ezskiros.check.inference import names as names_of
from ezskiros.contracts.knowledge import (
    How,
    KnownFacts,
    Made,
    NameKnowledge,
    Origin,
    Renewed,
    WorldChange,
)
from ezskiros.contracts.statements import TreeCondition, asked
from ezskiros.ontology.statements import Generated, Specified
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.interface import Parameter, SkillInterface
from ezskiros.skills.markers import Option, ParameterKind
from ezskiros.trees.names import shared_names

SkillOf = Callable[[SkillCall], SkillInterface]


@dataclass(frozen=True)
class BoundChild:
    """A child, at a point where some names stand for the individuals of other names."""

    call: SkillCall
    skill: SkillInterface
    names: Mapping[str, str]
    """The names in the tree, by the parameters of the child."""

    @property
    def label(self) -> str:
        """The name of the child in messages."""
        return self.skill.name

    def asked(self, known: KnownFacts) -> list[TreeCondition]:
        """The conditions that must hold at the start, about names that have a value."""
        optional = (self.names[each.name] for each in self._of_kind(ParameterKind.OPTIONAL))
        absent = {name for name in optional if known.is_free(name)}
        return [each for each in self._conditions if absent.isdisjoint(names_of(each.statement))]

    @cached_property
    def _conditions(self) -> list[TreeCondition]:
        return [
            *asked(self.skill.pre, "pre", self.names),
            *asked(self.skill.hold, "hold", self.names),
        ]

    def inferred(self, known: KnownFacts) -> list[str]:
        """The names for which the child infers an individual at its start."""
        names = (self.names[each.name] for each in self._of_kind(ParameterKind.INFERRED))
        return [name for name in dict.fromkeys(names) if known.is_free(name)]

    def bound(self) -> Iterable[str]:
        """The names that have a value after the start of the child."""
        return (
            self.names[each.name]
            for kind in (ParameterKind.REQUIRED, ParameterKind.INFERRED)
            for each in self._of_kind(kind)
        )

    def outputs(self) -> Iterator[str]:
        """The names that have a new value after the child has succeeded."""
        return (self.names[each.name] for each in self._individuals() if each.is_output)

    def changes(self, how: How) -> list[WorldChange]:
        """The changes by a success of the child, in order."""
        return [WorldChange(made, origin, how) for made, origin in self._made]

    @cached_property
    def _made(self) -> list[tuple[Made, Origin]]:
        return list(self._all_made())

    def _all_made(self) -> Iterator[tuple[Made, Origin]]:
        for each in self._individuals():
            origin = Origin(each.span, "parameter", self.call)
            name = self.names[each.name]
            if each.is_output:
                yield Renewed(name), origin
            if Option.CONSUME in each.options:
                yield Generated(name, False), origin
            if Option.UNSPECIFY in each.options:
                yield Specified(name, False), origin
        for said in asked(self.skill.post, "post", self.names):
            yield said.statement, Origin(said.clause.span, "post", self.call)

    def _of_kind(self, kind: ParameterKind) -> Iterator[Parameter]:
        return (each for each in self._individuals() if each.kind is kind and not each.is_output)

    def _individuals(self) -> Iterator[Parameter]:
        return (
            each for each in self.skill.parameters if each.is_individual and each.name in self.names
        )


class TreeChildren:
    """The children of one tree. Each child is kept for the names that stand for the individuals of
    other names, because each tick needs it.
    """

    def __init__(self, skill_of: SkillOf) -> None:
        self._skill_of = skill_of
        self._known: dict[tuple[SkillCall, frozenset[tuple[str, str]]], BoundChild] = {}

    def of(self, call: SkillCall, known: KnownFacts) -> BoundChild:
        """The child of a call at a point of the tree."""
        key = call, frozenset(known.same.items())
        if key not in self._known:
            skill = self._skill_of(call)
            shared = shared_names(call, skill)
            names = {each.parameter.name: known.one(each.shared) for each in shared}
            self._known[key] = BoundChild(call, skill, names)
        return self._known[key]


def names_of_tree(
    compound: SkillInterface, calls: Iterable[SkillCall], skill_of: SkillOf
) -> dict[str, NameKnowledge]:
    """All names of individuals in a tree."""
    found = {
        each.name: NameKnowledge(frozenset({each.iri}), is_own=True)
        for each in compound.parameters
        if each.iri
    }
    for call in calls:
        for shared in shared_names(call, skill_of(call)):
            iri, known = shared.parameter.iri, found.get(shared.shared)
            if iri is None or (known and known.is_own):
                continue
            classes = known.classes if known else frozenset()
            found[shared.shared] = NameKnowledge(classes | {iri}, is_own=False)
    return found
