"""What would repair a finding: a pre-condition, or a child to insert or to move."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from dslkit.diagnostics import listed
from ezskiros.check.clash import Clash
from ezskiros.check.inference import names as names_of
from ezskiros.check.spelled import spelled
from ezskiros.contracts.judge import Judge
from ezskiros.contracts.knowledge import Change, How, Known, Renewed
from ezskiros.contracts.statements import conjuncts
from ezskiros.ontology.iris import split
from ezskiros.ontology.python_names import identifier
from ezskiros.ontology.statements import (
    AnyOf,
    Comparison,
    Generated,
    HasProperty,
    OfType,
    Relation,
    Specified,
    Statement,
    Value,
)
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.interface import SkillInterface


@dataclass(frozen=True)
class Repairs:
    """For the tree of one compound skill; `others` are the skills that could be children."""

    skill: SkillInterface
    judge: Judge
    others: tuple[SkillInterface, ...]
    calls: tuple[SkillCall, ...]
    ambiguous: frozenset[str]

    def of_unknown(self, said: Statement) -> str:
        """For a condition of which nothing is known, and which nothing has ended."""
        text = self.pre_condition(said)
        inserted = self._giving(said)
        if text is not None:
            found = f"if it holds before `{self.skill.name}`, add `{text}` to its description"
            return f"{found}; else insert `{inserted}` before" if inserted else found
        unknown = [name for name in names_of(said) if self.skill.parameter(name) is None]
        own = self.skill.name
        if unknown:
            found = f"pass a parameter of `{own}` for `{unknown[0]}`, with this as a pre-condition"
            return f"{found}; or insert `{inserted}` before" if inserted else found
        return f"say so in the pre-conditions of `{own}`"

    def of_lost(self, call: SkillCall, said: Statement, known: Known, change: Change) -> str:
        """For a condition that another child may have ended."""
        other = change.origin.call
        if change.how is How.BESIDE:
            return "run them one after the other: `self.serialstar(...)`"
        options = [*self._passing(call, said, known)]
        if inserted := self._giving(said):
            options.append(f"insert `{inserted}` before")
        if not options and other is not None and other.skill is not call.skill:
            options.append(f"move it before `{other.skill.__name__}`, if it has to hold then")
        fresh = self._fresh_in(change)
        if fresh and other is not None and other.skill is not call.skill:
            own = self.skill.name
            options.append(f"pass `{other.skill.__name__}` a parameter of `{own}` for `{fresh}`")
        return "; or ".join(options) or f"restore it before `{call.skill.__name__}`"

    def _passing(self, call: SkillCall, said: Statement, known: Known) -> Iterator[str]:
        """Parameters of the compound for names that an earlier child has found things for."""
        free = [name for name in names_of(said) if self.skill.parameter(name) is None]
        chosen = self.judge.choice(known, [said], free) if free else {}
        given = [f"{name}=params.{one}" for name, one in chosen.items() if name != one]
        if given and all(self.skill.parameter(one) for one in chosen.values()):
            names = listed(free)
            yield (
                f"write `{call.skill.__name__}({', '.join(given)}, ...)`: {names} still stands for "
                "what an earlier child has found"
            )

    def of_false(self, call: SkillCall, said: Statement, known: Known, clash: Clash) -> str | None:
        """For a condition that is false."""
        options = []
        if inserted := self._giving(said):
            options.append(f"insert `{inserted}` before")
        destroyers = [known.facts[each].call for each in known.facts if each in clash.said]
        other = next((each for each in destroyers if each is not None), None)
        if other is not None and other.span != call.span:
            options.append(f"move it before `{other.skill.__name__}`")
        return "; or ".join(options) or None

    def at_end(self, said: Statement, change: Change | None) -> str:
        """For a post-condition that is not achieved."""
        other = change.origin.call if change else None
        fresh = self._fresh_in(change) if change else None
        if fresh and other is not None:
            return f"pass `{other.skill.__name__}` a parameter of `{self.skill.name}` for `{fresh}`"
        inserted = self._giving(said)
        first = f"append `{inserted}`" if inserted else "let a child see to it"
        return f"{first}, or leave the condition out"

    def pre_condition(self, said: Statement) -> str | None:
        """What to add to the compound; None if it has no words for it."""
        if any(self.skill.parameter(name) is None for name in names_of(said)):
            return None
        if any(identifier(split(iri)[1]) in self.ambiguous for iri in _properties(said)):
            return None
        return f"self.pre_conditions += {spelled(said, self.judge.model)}"

    # --- children that would do -------------------------------------------------------------------

    def _fresh_in(self, change: Change) -> str | None:
        """A name in a change that nobody but its child knows."""
        about = () if isinstance(change.made, Renewed) else names_of(change.made)
        return next((name for name in about if self.skill.parameter(name) is None), None)

    def _giving(self, said: Statement) -> str | None:
        """The call of a skill of which a post-condition makes a statement hold."""
        for skill in self.others:
            for clause in skill.post:
                for made in conjuncts(clause.statement):
                    names = _unified(made, said)
                    if names is not None and self._can_be(skill, names):
                        return self._call(skill, names)
        return None

    def _can_be(self, skill: SkillInterface, names: Mapping[str, str]) -> bool:
        """Whether the things are of the right classes, and have a name in the compound."""
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


def _unified(made: Statement, said: Statement) -> Mapping[str, str] | None:
    """Names for the parameters of a post-condition by which it says the same; None if none do."""
    match made:
        case Relation():
            return _unified_relations(made, said) if isinstance(said, Relation) else None
        case Comparison():
            if isinstance(said, Comparison) and _compared(made) == _compared(said):
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


def _compared(said: Comparison) -> tuple[str, str, Value, bool]:
    return said.property, said.operator, said.value, said.is_true


def _properties(said: Statement) -> Iterator[str]:
    """The relations and data properties that a statement names."""
    match said:
        case AnyOf(parts=parts):
            for part in parts:
                yield from _properties(part)
        case Relation(relation=iri):
            yield iri
        case Comparison(property=iri) | HasProperty(property=iri):
            yield iri
        case OfType() | Specified() | Generated():
            return


def in_order(skills: Iterable[SkillInterface]) -> tuple[SkillInterface, ...]:
    """The simplest first: those that need least."""
    return tuple(sorted(skills, key=lambda each: (len(each.pre), each.name)))
