"""Conversion of a user's description class to a `SkillInterface`.

The module follows the patterns Early Dynamic Checking and Symbolic Tracing (thesis, Paper IV,
section 4.2): the method `description` runs with symbols in place of its parameters, once per path
through its branches.
"""

from __future__ import annotations

import difflib
import inspect
from collections.abc import Sequence
from dataclasses import dataclass, replace
from types import FunctionType

from dslkit.diagnostics import Diagnostic, DidYouMean, Remark, Template
from ezskiros import session
from ezskiros.ontology import Ontology
from ezskiros.ontology.symbols import OntologyClass
from ezskiros.skills import errors
from ezskiros.skills.calls import SkillClass
from ezskiros.skills.description import SkillDescription
from ezskiros.skills.explored import Adding, PathConditions, explored
from ezskiros.skills.interface import Parameter, SkillInterface
from ezskiros.skills.parameters import read_parameters, signature_of
from ezskiros.skills.syntax import class_span, definition, docs_of
from ezskiros.skills.tracing import Method


@dataclass(frozen=True)
class DescribedSkill:
    """A skill, and the ontology of its types; None if it has no individuals.

    After a mistake the skill may be incomplete: conditions may be missing.
    """

    interface: SkillInterface
    ontology: Ontology | None
    is_whole: bool


def describe(skill: SkillClass) -> DescribedSkill | None:
    """Describe a skill by running its description; None, after a finding, if it has no content."""
    method = inspect.getattr_static(skill, "description", None)
    if not isinstance(method, FunctionType):
        session.report(_no_description(skill))
        return None
    if not _has_self(method):
        session.report(errors.NoSelf().at(definition(method).whole))
        return None
    docs = docs_of(inspect.getdoc(skill) or "")
    parameters = [
        replace(each, doc=docs[each.name]) if each.name in docs and not each.doc else each
        for each in read_parameters(method)
    ]
    first, are_whole = _explored(skill, method, parameters)
    interface = SkillInterface(
        name=skill.__name__,
        span=class_span(skill),
        parameters=tuple(parameters),
        pre=first.pre,
        hold=first.hold,
        post=first.post,
        permits=first.permits,
        uses=first.uses,
        doc=inspect.cleandoc(skill.__doc__ or ""),
        unclear=_unclear(method, parameters),
    )
    types = [each.type for each in parameters if isinstance(each.type, OntologyClass)]
    types += [individual.owl_class for each in first.permits for individual in each.individuals]
    ontologies = [each.vocabulary for each in types]
    found = next((each for each in ontologies if isinstance(each, Ontology)), None)
    return DescribedSkill(interface, found, are_whole)


def _unclear(method: FunctionType, parameters: Sequence[Parameter]) -> frozenset[str]:
    """The names of the parameters in the source, without those that were understood."""
    written = list(signature_of(method).parameters)[1:]
    return frozenset(written) - {each.name for each in parameters}


def _no_description(skill: SkillClass) -> Diagnostic:
    """The finding for a skill without a description, with the method that may be meant."""
    methods = {
        name: each
        for name in dir(skill)
        if isinstance(each := inspect.getattr_static(skill, name), FunctionType)
    }
    found = errors.NoDescription(skill=skill.__name__)
    near = difflib.get_close_matches("description", methods, n=1, cutoff=0.7)
    if not near:
        return found.at(class_span(skill))
    is_old = near[0] == "createDescription"
    label = found.Near().at(definition(methods[near[0]]).whole)
    return found.at(class_span(skill), label, help=found.Migrate() if is_old else None)


def _has_self(method: FunctionType) -> bool:
    """Say whether the first parameter is the skill itself: it has no type."""
    first = next(iter(signature_of(method).parameters.values()), None)
    return first is not None and (first.name == "self" or first.annotation is first.empty)


def _made(skill: SkillClass) -> Adding:
    """An instance. The call of a skill class would make a child of a behavior tree."""
    made: SkillDescription = type.__call__(skill)
    return Adding(
        made,
        made.pre_conditions,
        made.hold_conditions,
        made.post_conditions,
        made.permits,
        made.uses,
    )


def _explored(
    skill: SkillClass, function: FunctionType, parameters: Sequence[Parameter]
) -> tuple[PathConditions, bool]:
    """The conditions of a description, and whether they are complete."""

    def undefined(spelled: str) -> tuple[Template, Remark | None]:
        known = [*(each.name for each in parameters), *function.__globals__]
        near = difflib.get_close_matches(spelled, known, n=1)
        found = errors.UnknownParameter(spelled=spelled, skill=skill.__name__)
        return found, DidYouMean(near=near[0]) if near else None

    method = Method(
        skill,
        function,
        f"the description of `{skill.__name__}`",
        "a description only declares parameters and conditions; move this to the implementation",
        undefined,
    )
    return explored(method, lambda: _made(skill), parameters)
