"""Additional pre-conditions of an implementation, besides those of its skill.

    class open_door(Open.SkillBase):
        def conditions(self, Door):
            self.pre_conditions += Door.Open == False

They correspond to SkiROS2's `modifyDescription`. If a child names no implementation, the first one
whose pre-conditions hold runs.
"""

from __future__ import annotations

import difflib
import inspect
from collections.abc import Sequence
from dataclasses import replace
from types import FunctionType
from typing import Any

from dslkit.diagnostics import Diagnostic, DidYouMean, Remark, Template, remarked
from ezskiros import session
from ezskiros.skills import errors, tree_errors
from ezskiros.skills.added import Added
from ezskiros.skills.describe import DescribedSkill
from ezskiros.skills.description import Conditions
from ezskiros.skills.explored import Adding, explored
from ezskiros.skills.implementation import SkillImplementation
from ezskiros.skills.interface import Clause, SkillInterface
from ezskiros.skills.no_such_parameter import no_such_parameter
from ezskiros.skills.parameters import signature_of
from ezskiros.skills.syntax import class_span, definition
from ezskiros.skills.tracing import Method

METHOD = "conditions"


def has_own_conditions(implementation: type[SkillImplementation]) -> bool:
    """Tell whether an implementation has the method `conditions`."""
    return isinstance(inspect.getattr_static(implementation, METHOD, None), FunctionType)


def refined(implementation: type[SkillImplementation], described: DescribedSkill) -> DescribedSkill:
    """The skill with the pre-conditions of this implementation. Mistakes in them are reported."""
    function = inspect.getattr_static(implementation, METHOD, None)
    skill = described.interface
    if function is not None and not isinstance(function, FunctionType):
        other = tree_errors.NoOwnConditions(implementation=implementation.__name__)
        session.report(other.at(class_span(implementation), help=_signature_help(skill)))
    if not isinstance(function, FunctionType):
        return described
    own, are_whole = _own(implementation, function, skill)
    interface = replace(skill, pre=(*skill.pre, *own))
    return DescribedSkill(interface, described.ontology, described.is_whole and are_whole)


def _own(
    implementation: type[SkillImplementation], function: FunctionType, skill: SkillInterface
) -> tuple[Sequence[Clause], bool]:
    """The clauses, and whether they are complete."""
    written = definition(function)
    unknown = [
        name
        for name, given in list(signature_of(function).parameters.items())[1:]
        if given.kind not in (given.VAR_POSITIONAL, given.VAR_KEYWORD)
        and skill.parameter(name) is None
        and name not in skill.unclear
    ]
    for name in unknown:
        found = no_such_parameter(skill, name, written.name_of(name))
        session.report(found if found.help else remarked(found, help=_signature_help(skill)))

    def undefined(spelled: str) -> tuple[Template, Remark | None]:
        names = [each.name for each in skill.parameters]
        if spelled in names:
            found = errors.UnknownParameter(spelled=spelled, skill=METHOD)
            return found, found.Signature(method=METHOD, parameter=spelled)
        near = difflib.get_close_matches(spelled, [*names, *function.__globals__], n=1)
        found = errors.UnknownParameter(spelled=spelled, skill=skill.name)
        return found, DidYouMean(near=near[0]) if near else None

    method = Method(
        implementation,
        function,
        f"`{METHOD}` of `{implementation.__name__}`",
        f"`{METHOD}` only declares conditions; move this to another method",
        undefined,
    )
    made: list[Adding] = []

    def make() -> Adding:
        made.append(_made(implementation))
        return made[-1]

    added, are_whole = explored(method, make, skill.parameters)
    is_replaced = any(each.instance.pre_conditions is not each.pre for each in made)
    if is_replaced:
        replaced = errors.ReplacedConditions(conditions="pre_conditions")
        session.report(replaced.at(written.whole))
    elif are_whole and not unknown and not added.pre:
        session.report(_adds_nothing(implementation, function))
    return added.pre, are_whole and not unknown and not is_replaced


def _signature_help(skill: SkillInterface) -> Remark:
    """The help for the signature of the method, with the first parameter of a skill."""
    individuals = [each.name for each in skill.parameters if each.is_individual]
    first = next(iter([*individuals, *(each.name for each in skill.parameters)]), "Parameter")
    return tree_errors.Signature(method=METHOD, parameter=first)


def _adds_nothing(implementation: type[SkillImplementation], function: FunctionType) -> Diagnostic:
    """The finding for a method without an effect, with the keyword that may be the cause."""
    found = tree_errors.NoOwnConditions(implementation=implementation.__name__)
    help: Remark | None = None
    if inspect.isgeneratorfunction(function) or inspect.isasyncgenfunction(function):
        help = found.Generator()
    elif inspect.iscoroutinefunction(function):
        help = found.Coroutine()
    return found.at(definition(function).whole, help=help)


def _made(implementation: type[SkillImplementation]) -> Adding:
    """An instance that collects conditions."""
    skill = implementation.description.__name__
    made: Any = implementation()
    made.pre_conditions = pre = Conditions("pre")
    made.hold_conditions = hold = _OfTheSkill("hold_conditions", skill)
    made.post_conditions = post = _OfTheSkill("post_conditions", skill)
    made.permits = permits = _OfTheSkill("permits", skill)
    made.uses = uses = _OfTheSkill("uses", skill)
    return Adding(made, pre, hold, post, permits, uses)


class _OfTheSkill(Added[Any]):
    """Conditions that belong to the skill: an implementation adds only pre-conditions."""

    def __init__(self, attribute: str, skill: str) -> None:
        super().__init__(attribute)
        self._skill = skill

    def __iadd__(self, _added: object) -> _OfTheSkill:
        self.are_whole = False
        found = tree_errors.OnlyPreConditions(spelled=self._attribute, skill=self._skill)
        session.report(found.at(session.here()))
        return self
