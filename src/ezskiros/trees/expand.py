"""Expansion of a user's implementation to its behavior trees.

`expandBT` runs with references in place of parameters, once per path through its branches, like
descriptions (thesis, Paper IV, sections 4.2 and 7).
"""

from __future__ import annotations

import difflib
import inspect
from collections.abc import Iterator, Mapping
from types import FunctionType, MappingProxyType

from dslkit.diagnostics import DidYouMean, Remark, Template
from dslkit.source import Span
from ezskiros import session
from ezskiros.ontology.symbols import UNKNOWN, UnknownValue
from ezskiros.skills import tree_errors as errors
from ezskiros.skills.growing import Nowhere, growing
from ezskiros.skills.implementation import MAKERS, SkillImplementation
from ezskiros.skills.interface import SkillInterface
from ezskiros.skills.methods import written
from ezskiros.skills.no_such_parameter import no_such_parameter
from ezskiros.skills.nodes import Node
from ezskiros.skills.syntax import class_span, definition
from ezskiros.skills.tracing import Method, execution_paths
from ezskiros.skills.values import Decisions
from ezskiros.trees.library import known_skills
from ezskiros.trees.tree import Reference, Tree, reference


class References:
    """The parameters of the compound: `params.GraspPose`."""

    _skill: SkillInterface
    _known: Mapping[str, object]

    def __init__(self, skill: SkillInterface, known: Mapping[str, object]) -> None:
        vars(self).update(_skill=skill, _known=known)

    def __getattr__(self, name: str) -> Reference | UnknownValue:
        if name.startswith("__"):
            raise AttributeError(name)
        parameter = self._skill.parameter(name)
        if parameter is not None:
            return reference(parameter, self._known)
        if name in self._skill.unclear:
            return UNKNOWN
        session.report(no_such_parameter(self._skill, name, session.here()))
        return UNKNOWN

    def __setattr__(self, name: str, _value: object) -> None:
        raise AttributeError(
            f"`expandBT` cannot set a parameter: pass the value to the child, `Skill({name}=...)`"
        )

    def __getitem__(self, name: object) -> None:
        raise TypeError(f"write `params.{name}`")


class _Written:
    """An implementation, and the nodes of its `expandBT` without a parent, in order."""

    def __init__(self, implementation: type[SkillImplementation]) -> None:
        self.instance = implementation()
        self.loose: list[Node] = []


def expand(
    implementation: type[SkillImplementation],
    skill: SkillInterface,
    known: Mapping[str, object] = MappingProxyType({}),
) -> Iterator[Tree]:
    """The trees of a compound skill. Mistakes in their form are reported.

    Branches on `known` parameters follow one path, branches on others follow all paths.
    """
    function = inspect.getattr_static(implementation, "expandBT", None)
    if not isinstance(function, FunctionType):
        return
    if len(inspect.signature(function).parameters) != len(("self", "params")):
        found = errors.NoParams(implementation=implementation.__name__)
        session.report(found.at(definition(function).whole))
        return
    method = Method(
        implementation,
        function,
        f"`expandBT` of `{implementation.__name__}`",
        "`expandBT` only builds a tree; move this to a primitive skill",
        lambda spelled: _undefined(spelled, function),
        Nowhere(),
    )

    def run(written: _Written, expand_by: FunctionType) -> None:
        with growing() as tree:
            try:
                expand_by(written.instance, References(skill, known))
            finally:
                written.loose = tree.loose

    _report_identities(function)
    for path in execution_paths(method, lambda: _Written(implementation), run):
        if path.has_ended and path.instance is not None:
            branch = _branch(path.decisions)
            if path.instance.loose:
                *loose, root = path.instance.loose
                _report_loose(implementation, loose)
                given = _given(path.decisions)
                yield Tree(implementation, skill, root, class_span(implementation), branch, given)
            elif path.is_right:
                _report_empty(implementation, function, branch)


def _undefined(spelled: str, function: FunctionType) -> tuple[Template, Remark | None]:
    """The finding for an undefined name, with a similar skill."""
    found = errors.UnknownSkill(spelled=spelled)
    if spelled in MAKERS:
        return found, found.Processor(processor=spelled)
    modules = {each.__name__: each.__module__ for each in known_skills()}
    if spelled in modules:
        return found, found.Import(module=modules[spelled], skill=spelled)
    near = difflib.get_close_matches(spelled, [*function.__globals__, *modules], n=1)
    return found, DidYouMean(near=near[0]) if near else None


def _branch(decisions: Decisions) -> tuple[tuple[Span, bool], ...]:
    asked = (span for span, _ in decisions.asked)
    return tuple(zip(asked, decisions.taken, strict=True))


def _given(decisions: Decisions) -> frozenset[str]:
    """The parameters that were tested and have a value."""
    asked = (symbol for _, symbol in decisions.asked)
    answered = zip(asked, decisions.taken, strict=True)
    true = (symbol for symbol, answer in answered if answer)
    return frozenset(each.parameter.name for each in true if isinstance(each, Reference))


def _report_identities(function: FunctionType) -> None:
    """Report `params.Start is None`: the reference to a parameter is never identical to another
    object.
    """
    method = written(function)
    for span in method.compared_by_identity() if method else ():
        session.report(errors.ComparedByIdentity(spelled=span.text).at(span))


def _report_loose(implementation: type[SkillImplementation], loose: list[Node]) -> None:
    """Report nodes beside the tree. The last node is the tree."""
    for node in loose:
        session.report(errors.LooseSkill(implementation=implementation.__name__).at(node.span))


def _report_empty(
    implementation: type[SkillImplementation],
    function: FunctionType,
    branch: tuple[tuple[Span, bool], ...],
) -> None:
    empty = errors.EmptyTree(implementation=implementation.__name__)
    labels = (empty.Branch(answer=str(answer).lower()).at(span) for span, answer in branch)
    is_generator = inspect.isgeneratorfunction(function)
    help = empty.Generator() if is_generator else None
    session.report(empty.at(definition(function).whole, *labels, help=help))
