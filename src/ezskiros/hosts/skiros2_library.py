"""The checked skills of a library, and the selection that SkiROS2 may load.

A finding in a skill refuses the skill; a finding outside of skills refuses all skills of the file.
A skill that calls a refused skill is refused as well, because it could only fail.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import ModuleType
from typing import TypeVar

from dslkit.diagnostics import Collector, Diagnostic, Severity
from ezskiros import session
from ezskiros.check import check_implementations, check_skills
from ezskiros.contracts import check_contracts
from ezskiros.hosts import skiros2_errors as errors
from ezskiros.skills.calls import SkillClass
from ezskiros.skills.describe import DescribedSkill
from ezskiros.skills.description import SkillDescription
from ezskiros.skills.implementation import SkillImplementation
from ezskiros.skills.nodes import calls
from ezskiros.skills.syntax import class_body, class_span
from ezskiros.trees.library import Implementations, Library
from ezskiros.trees.tree import Tree

T = TypeVar("T")

_accepted: set[type] = set()
"""Descriptions and implementations of all libraries that SkiROS2 may load."""


class AcceptedLibrary(Library):
    """A library with only the skills that SkiROS2 may load."""

    def implementations(self, description: SkillClass) -> Implementations:
        """The implementations of a skill, by name."""
        known = super().implementations(description)
        return {name: each for name, each in known.items() if each in _accepted}


@dataclass(frozen=True)
class CheckedLibrary:
    """The accepted skills of some modules, and all findings, including those of refused skills."""

    described: Mapping[SkillClass, DescribedSkill]
    implementations: Sequence[type[SkillImplementation]]
    refused: Sequence[type]
    diagnostics: Sequence[Diagnostic]
    library: Library


def check_library(modules: Iterable[ModuleType], found: Collector) -> CheckedLibrary:
    """Check the skills that modules define. `found` has the findings of their import."""
    modules = list(modules)
    descriptions = [each for module in modules for each in own(module, SkillDescription)]
    implementing = [each for module in modules for each in own(module, SkillImplementation)]
    classes: list[type] = [*descriptions, *implementing]
    with session.collecting(found):
        described = check_skills(descriptions)
        library = Library(described)
        trees = check_implementations(implementing, library)
        found.extend(check_contracts(trees, library).diagnostics)
        refused = _with_errors(classes, found) | (set(descriptions) - set(described))
        _accepted.update(set(classes) - refused)
        _refuse_what_depends(implementing, trees)
    return CheckedLibrary(
        {each: what for each, what in described.items() if each in _accepted},
        [each for each in implementing if each in _accepted],
        [each for each in classes if each not in _accepted],
        found.sorted(),
        AcceptedLibrary(described),
    )


def _with_errors(classes: Sequence[type], found: Collector) -> set[type]:
    """The classes with errors. An error outside of classes counts for all classes of its file, or
    of the whole library if none of the classes is in that file.
    """
    places = {each: class_body(each) for each in classes}
    refused: set[type] = set()
    for diagnostic in found.sorted():
        if diagnostic.severity is not Severity.ERROR:
            continue
        span = diagnostic.primary.span
        in_file = {each for each in classes if places[each].file.path == span.file.path}
        inside = {each for each in in_file if places[each].start <= span.start <= places[each].end}
        refused |= inside or in_file or set(classes)
    return refused


def _refuse_what_depends(
    implementing: Sequence[type[SkillImplementation]], trees: Sequence[Tree]
) -> None:
    """Refuse implementations of refused skills, and compounds that call a refused skill."""
    is_changed = True
    while is_changed:
        before = len(_accepted)
        for each in implementing:
            if each in _accepted and each.description not in _accepted:
                spelled = each.description.__name__
                session.report(errors.DescriptionRefused(spelled=spelled).at(class_span(each)))
                _accepted.discard(each)
        for tree in trees:
            for diagnostic in _refused_calls(tree) if tree.owner in _accepted else ():
                session.report(diagnostic)
                _accepted.discard(tree.owner)
        is_changed = len(_accepted) < before


def _refused_calls(tree: Tree) -> Iterator[Diagnostic]:
    library = AcceptedLibrary({})
    for call in calls(tree.root):
        known = library.implementations(call.skill)
        wanted = call.implementation
        is_done = bool(known) if wanted is None else wanted in known
        if call.skill not in _accepted or not is_done:
            spelled = f"{call.skill.__name__}.{wanted}" if wanted else call.skill.__name__
            yield errors.CallsRefused(spelled=spelled).at(call.span)


def own(module: ModuleType, base: type[T]) -> Iterator[type[T]]:
    """The classes that a module itself derives from another class."""
    for each in vars(module).values():
        is_class = isinstance(each, type) and issubclass(each, base)
        if is_class and each.__module__ == module.__name__:
            yield each
