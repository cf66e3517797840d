"""Checks of names that the children of a behavior tree share: clashes, and one individual for two
parameters.
"""

from __future__ import annotations

from collections.abc import Iterator

from dslkit.diagnostics import Diagnostic, Label, NamedHere
from dslkit.source import Span
from ezskiros.check import tree_errors as errors
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.interface import Parameter, SkillInterface
from ezskiros.skills.nodes import Flow, Node, Processor, calls, children
from ezskiros.skills.syntax import argument_places
from ezskiros.trees.library import Library
from ezskiros.trees.names import all_shared, shared_names
from ezskiros.trees.tree import Tree


def check_sharing(tree: Tree, library: Library) -> Iterator[Diagnostic]:
    """Report children that cannot share a name, and children with the same individual for two
    parameters.
    """
    yield from _clashes(tree, library)
    for call in calls(tree.root):
        skill = library.skill(call.skill)
        if skill is not None:
            yield from _aliases(call, skill)
            yield from _dropped(call, skill, tree, library)
    yield from _written_twice(tree.root, library)


def _clashes(tree: Tree, library: Library) -> Iterator[Diagnostic]:
    """Report names that the compound does not declare and that have different types in two
    children.
    """
    own = {each.name for each in tree.skill.parameters}
    first: dict[str, Parameter] = {}
    reported: set[tuple[Span, Span]] = set()
    for call in calls(tree.root):
        for shared in all_shared(call, library):
            parameter = shared.parameter
            known = first.setdefault(shared.shared, parameter)
            pair = (known.span, parameter.span)
            if shared.shared in own or _can_share(known, parameter, library) or pair in reported:
                continue
            reported.add(pair)
            found = errors.NameClash(
                shared=shared.shared, one=_spelled(known), other=_spelled(parameter)
            )
            labels = (_declared(known), _declared(parameter))
            yield found.at(call.span, *labels)


def _can_share(one: Parameter, other: Parameter, library: Library) -> bool:
    """Say whether one individual or value can fit both parameters."""
    if one.iri is None or other.iri is None:
        return one.type is other.type
    ontology = library.ontology()
    model = ontology.model if ontology else None
    return model is None or model.is_a(one.iri, other.iri) or model.is_a(other.iri, one.iri)


def _aliases(call: SkillCall, skill: SkillInterface) -> Iterator[Diagnostic]:
    """Report two parameters of a child that stand for the same individual."""
    seen: dict[str, str] = {}
    for shared in shared_names(call, skill):
        name = shared.parameter.name
        if not shared.is_passed or not shared.parameter.is_individual:
            continue
        if shared.shared in seen:
            other = seen[shared.shared]
            found = errors.SameIndividualTwice(
                skill=skill.name, one=other, other=name, shared=shared.shared
            )
            yield found.at(_value_place(call, name), *_labels(skill, other, name))
        seen.setdefault(shared.shared, name)


def _dropped(
    call: SkillCall, skill: SkillInterface, tree: Tree, library: Library
) -> Iterator[Diagnostic]:
    """Report an argument under a name that the child itself declares for another parameter.
    Arguments that fit no parameter are reported elsewhere.
    """
    for shared in shared_names(call, skill):
        name, other = shared.parameter.name, skill.parameter(shared.shared)
        given = tree.skill.parameter(shared.shared)
        if not shared.is_passed or other is None or other.name == name or given is None:
            continue
        if _can_share(shared.parameter, given, library):
            found = errors.OwnNamePassed(skill=skill.name, parameter=name, shared=shared.shared)
            yield found.at(_value_place(call, name), _declared(other))


def _written_twice(node: Node, library: Library) -> Iterator[Diagnostic]:
    """Report outputs that two children of a parallel set at the same time."""
    if isinstance(node, Processor) and node.flow in (Flow.PARALLEL_FF, Flow.PARALLEL_FS):
        writers: dict[str, tuple[Node, SkillCall]] = {}
        for child in node.children:
            for call in calls(child):
                for shared in all_shared(call, library):
                    if not shared.parameter.is_output:
                        continue
                    by, other = writers.setdefault(shared.shared, (child, call))
                    if by is not child:
                        found = errors.WrittenBesides(shared=shared.shared)
                        yield found.at(call.span, found.Other().at(other.span))
    for child in children(node):
        yield from _written_twice(child, library)


def _value_place(call: SkillCall, name: str) -> Span:
    places = argument_places(call.span)
    return places[name][1] if name in places else call.span


def _labels(skill: SkillInterface, *names: str) -> list[Label]:
    return [_declared(each) for name in names if (each := skill.parameter(name))]


def _declared(parameter: Parameter) -> Label:
    return NamedHere(name=parameter.name).at(parameter.span)


def _spelled(parameter: Parameter) -> str:
    return repr(parameter.type) if parameter.is_individual else parameter.type.__name__
