"""Relations that skills use in both directions between the same classes.

An ontology need not declare the domain and range of a relation, and SkiROS2's own does not. So the
other conditions show the usual direction.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from dslkit.diagnostics import Diagnostic
from ezskiros.check import errors
from ezskiros.check.relations import simple
from ezskiros.ontology.iris import split
from ezskiros.ontology.model import Model
from ezskiros.ontology.python_names import identifier
from ezskiros.ontology.statements import Relation
from ezskiros.skills.interface import Clause, SkillInterface

_Classes = tuple[str, str]
"""The classes of the subject and of the object of a relation."""


class _Use(NamedTuple):
    """A relation in a condition."""

    number: int
    relation: Relation
    clause: Clause


def check_directions(skills: Iterable[SkillInterface], model: Model) -> Iterator[Diagnostic]:
    """Relations that are reversed in most other conditions. If both directions are equally
    frequent, the later one is reported.

    Symmetric relations are left out, and so are relations between two classes if one is a subclass
    of the other.
    """
    uses: dict[str, dict[_Classes, list[_Use]]] = defaultdict(lambda: defaultdict(list))
    for number, (classes, relation, clause) in enumerate(_related(skills)):
        uses[relation.relation][classes].append(_Use(number, relation, clause))
    for iri, by_classes in uses.items():
        declared = model.relations.get(iri)
        if declared is not None and not declared.is_symmetric:
            yield from _swapped(by_classes, model)


def _related(skills: Iterable[SkillInterface]) -> Iterator[tuple[_Classes, Relation, Clause]]:
    for skill in skills:
        for clause in (*skill.pre, *skill.hold, *skill.post):
            for said in simple(clause.statement):
                if isinstance(said, Relation):
                    classes = skill.class_of(said.subject), skill.class_of(said.object)
                    yield classes, said, clause


def _swapped(by_classes: Mapping[_Classes, list[_Use]], model: Model) -> Iterator[Diagnostic]:
    for (subject, other), uses in by_classes.items():
        turned = by_classes.get((other, subject), [])
        if not turned or model.is_a(subject, other) or model.is_a(other, subject):
            continue
        if (len(turned), -turned[0].number) > (len(uses), -uses[0].number):
            for use in uses:
                yield _finding((subject, other), use, turned[0], model)


def _finding(classes: _Classes, use: _Use, other: _Use, model: Model) -> Diagnostic:
    name = identifier(split(use.relation.relation)[1])
    subject, other_class = (model.short(each).replace(":", ".") for each in classes)
    found = errors.BothDirections(
        relation=model.short(use.relation.relation).replace(":", "."),
        subject=subject,
        object=other_class,
        turned=f"{use.relation.object}.{name}({use.relation.subject})",
    )
    return found.at(use.clause.span, found.Other().at(other.clause.span))
