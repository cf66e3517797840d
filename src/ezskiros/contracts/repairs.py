"""Repairs of a finding: a pre-condition, or a child to insert or to move."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from dslkit.diagnostics import Remark, listed
from ezskiros.check.clash import Clash
from ezskiros.check.inference import names as names_of
from ezskiros.check.spelled import spelled
from ezskiros.contracts.judge import Judge
from ezskiros.contracts.knowledge import How, KnownFacts, Renewed, WorldChange
from ezskiros.contracts.remarks import (
    AddElseInsert,
    AddPreCondition,
    Append,
    Insert,
    LetAChild,
    Move,
    MoveIfNeeded,
    OneAfterTheOther,
    OneOf,
    PassParameter,
    PassWithPreCondition,
    Restore,
    SayInPreConditions,
    StillStands,
)
from ezskiros.contracts.statements import conjuncts
from ezskiros.ontology.iris import split
from ezskiros.ontology.python_names import identifier
from ezskiros.ontology.statements import (
    AnyOf,
    Generated,
    HasProperty,
    OfType,
    Relation,
    Specified,
    Statement,
    Value,
    ValueComparison,
)
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.interface import SkillInterface


@dataclass(frozen=True)
class Repairs:
    """The repairs for the tree of one compound skill. `others` are the skills that could be
    children.
    """

    skill: SkillInterface
    judge: Judge
    others: tuple[SkillInterface, ...]
    calls: tuple[SkillCall, ...]
    ambiguous: frozenset[str]

    def of_unknown(self, said: Statement) -> Remark:
        """The repair of a condition of unknown truth value, which no child has ended."""
        text = self.pre_condition(said)
        inserted = self._giving(said)
        if text is not None:
            if inserted is None:
                return AddPreCondition(skill=self.skill.name, condition=text)
            return AddElseInsert(skill=self.skill.name, condition=text, child=inserted)
        unknown = [name for name in names_of(said) if self.skill.parameter(name) is None]
        own = self.skill.name
        if unknown:
            passed = PassWithPreCondition(skill=own, name=unknown[0])
            return _one_of(passed, Insert(child=inserted)) if inserted else passed
        return SayInPreConditions(skill=own)

    def of_lost(
        self, call: SkillCall, said: Statement, known: KnownFacts, change: WorldChange
    ) -> Remark:
        """The repair for a condition that another child may have ended."""
        other = change.origin.call
        if change.how is How.BESIDE:
            return OneAfterTheOther()
        options: list[Remark] = [*self._passing(call, said, known)]
        if inserted := self._giving(said):
            options.append(Insert(child=inserted))
        if not options and other is not None and other.skill is not call.skill:
            options.append(MoveIfNeeded(child=other.skill.__name__))
        fresh = self._fresh_in(change)
        if fresh and other is not None and other.skill is not call.skill:
            options.append(self._pass(other, fresh))
        return _one_of(*options) if options else Restore(child=call.skill.__name__)

    def _passing(self, call: SkillCall, said: Statement, known: KnownFacts) -> Iterator[Remark]:
        """Parameters of the compound to pass for names that an earlier child has inferred."""
        free = [name for name in names_of(said) if self.skill.parameter(name) is None]
        chosen = self.judge.choice(known, [said], free) if free else {}
        given = [f"{name}=params.{one}" for name, one in chosen.items() if name != one]
        if given and all(self.skill.parameter(one) for one in chosen.values()):
            written = f"{call.skill.__name__}({', '.join(given)}, ...)"
            yield StillStands(call=written, names=listed(free))

    def of_false(
        self, call: SkillCall, said: Statement, known: KnownFacts, clash: Clash
    ) -> Remark | None:
        """The repair for a condition that is false."""
        options: list[Remark] = []
        if inserted := self._giving(said):
            options.append(Insert(child=inserted))
        destroyers = [known.facts[each].call for each in known.facts if each in clash.said]
        other = next((each for each in destroyers if each is not None), None)
        if other is not None and other.span != call.span:
            options.append(Move(child=other.skill.__name__))
        return _one_of(*options) if options else None

    def at_end(self, said: Statement, change: WorldChange | None) -> Remark:
        """The repair for a post-condition that is not achieved."""
        other = change.origin.call if change else None
        fresh = self._fresh_in(change) if change else None
        if fresh and other is not None:
            return self._pass(other, fresh)
        inserted = self._giving(said)
        return Append(child=inserted) if inserted else LetAChild()

    def _pass(self, other: SkillCall, name: str) -> Remark:
        return PassParameter(child=other.skill.__name__, skill=self.skill.name, name=name)

    def pre_condition(self, said: Statement) -> str | None:
        """The pre-condition to add to the compound; None if its parameters cannot express the
        condition.
        """
        if any(self.skill.parameter(name) is None for name in names_of(said)):
            return None
        if any(identifier(split(iri)[1]) in self.ambiguous for iri in _properties(said)):
            return None
        return f"self.pre_conditions += {spelled(said, self.judge.model)}"

    # --- possible children ------------------------------------------------------------------------

    def _fresh_in(self, change: WorldChange) -> str | None:
        """A name in a change that only its child uses."""
        about = () if isinstance(change.made, Renewed) else names_of(change.made)
        return next((name for name in about if self.skill.parameter(name) is None), None)

    def _giving(self, said: Statement) -> str | None:
        """The call of a skill whose post-condition makes a statement true."""
        for skill in self.others:
            for clause in skill.post:
                for made in conjuncts(clause.statement):
                    names = _unified(made, said)
                    if names is not None and self._can_be(skill, names):
                        return self._call(skill, names)
        return None

    def _can_be(self, skill: SkillInterface, names: Mapping[str, str]) -> bool:
        """Say whether the individuals have the right classes and names in the compound."""
        if skill.name == self.skill.name:
            return False
        for parameter, name in names.items():
            own = self.skill.parameter(name)
            wanted = skill.parameter(parameter)
            if own is None or own.iri is None or wanted is None or wanted.iri is None:
                return False
            if not self.judge.model.is_a(own.iri, wanted.iri):
                return False
        return True

    def _call(self, skill: SkillInterface, names: Mapping[str, str]) -> str:
        given = [
            f"{parameter}=params.{name}" for parameter, name in names.items() if parameter != name
        ]
        return f"{skill.name}({', '.join(given)})"


def _one_of(*repairs: Remark) -> Remark:
    return OneOf(repairs="; or ".join(map(str, repairs)))


def _unified(made: Statement, said: Statement) -> Mapping[str, str] | None:
    """Names for the parameters of a post-condition that make it equal to a statement; None if there
    are none.
    """
    match made:
        case Relation():
            return _unified_relations(made, said) if isinstance(said, Relation) else None
        case ValueComparison():
            if isinstance(said, ValueComparison) and _compared(made) == _compared(said):
                return {made.subject: said.subject}
        case HasProperty(property=iri, is_true=is_true):
            if isinstance(said, HasProperty) and (iri, is_true) == (said.property, said.is_true):
                return {made.subject: said.subject}
        case OfType() | Specified() | Generated() | AnyOf():
            pass
    return None


def _unified_relations(made: Relation, said: Relation) -> Mapping[str, str] | None:
    here = (made.relation, made.is_true, made.is_abstract)
    if here != (said.relation, said.is_true, said.is_abstract):
        return None
    names = {made.subject: said.subject}
    if names.setdefault(made.object, said.object) != said.object:
        return None
    return names


def _compared(said: ValueComparison) -> tuple[str, str, Value, bool]:
    return said.property, said.operator, said.value, said.is_true


def _properties(said: Statement) -> Iterator[str]:
    """The relations and data properties that a statement names."""
    match said:
        case AnyOf(parts=parts):
            for part in parts:
                yield from _properties(part)
        case Relation(relation=iri):
            yield iri
        case ValueComparison(property=iri) | HasProperty(property=iri):
            yield iri
        case OfType() | Specified() | Generated():
            return


def in_order(skills: Iterable[SkillInterface]) -> tuple[SkillInterface, ...]:
    """The skills in order, those with the fewest needs first."""
    return tuple(sorted(skills, key=lambda each: (len(each.pre), each.name)))
