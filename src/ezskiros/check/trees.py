"""All checks of implementations, in one order."""

from __future__ import annotations

from collections.abc import Iterable
from types import MappingProxyType

from ezskiros import session
from ezskiros.check.bodies import check_bodies
from ezskiros.check.calls import check_calls
from ezskiros.check.dataflow import check_dataflow
from ezskiros.check.outcomes import Outcomes
from ezskiros.check.own_conditions import check_own_conditions
from ezskiros.check.parameters import check_parameters
from ezskiros.check.protocol import check_protocol
from ezskiros.check.reach import check_reach
from ezskiros.check.repeated import repeated
from ezskiros.check.sharing import check_sharing
from ezskiros.skills import tree_errors
from ezskiros.skills.calls import SkillClass
from ezskiros.skills.implementation import SkillImplementation
from ezskiros.skills.interface import SkillInterface
from ezskiros.skills.syntax import class_span
from ezskiros.trees.expand import expand
from ezskiros.trees.library import LaunchValues, Library
from ezskiros.trees.tree import Tree

CHECKS = (check_calls, check_sharing, check_dataflow)
NOTHING: LaunchValues = MappingProxyType({})


def check_implementations(
    implementations: Iterable[type[SkillImplementation]],
    library: Library,
    known: LaunchValues = NOTHING,
) -> list[Tree]:
    """The trees of compound skills. Mistakes in the trees and in primitives are reported."""
    found: list[Tree] = []
    implementations = list(implementations)
    _report_repeated([*library.descriptions(), *implementations])
    # All skills are read first, because trees call implementations of other files.
    skills = {each: _implemented(each, library) for each in _leaves(implementations)}
    for implementation, skill in skills.items():
        for diagnostic in check_protocol(implementation):
            session.report(diagnostic)
        for diagnostic in check_bodies(implementation):
            session.report(diagnostic)
        for diagnostic in check_own_conditions(implementation, library) if skill else ():
            session.report(diagnostic)
        for diagnostic in check_parameters(implementation, skill) if skill else ():
            session.report(diagnostic)
        for tree in expand(implementation, skill, known.get(skill.name, {})) if skill else ():
            found.append(tree)
            for check in CHECKS:
                for diagnostic in check(tree, library):
                    session.report(diagnostic)
    for diagnostic in check_reach(found, Outcomes(found, library)):
        session.report(diagnostic)
    return found


def _leaves(
    implementations: Iterable[type[SkillImplementation]],
) -> list[type[SkillImplementation]]:
    """Implementations without derived classes. Like SkiROS2, the engine runs only these."""
    found = list(implementations)
    bases = {base for each in found for base in each.__mro__[1:]}
    return [each for each in found if each not in bases]


def _implemented(
    implementation: type[SkillImplementation], library: Library
) -> SkillInterface | None:
    """The skill of an implementation; None, after a finding, if there is none."""
    description = getattr(implementation, "description", None)
    if not isinstance(description, SkillClass):
        found = tree_errors.NoSkillImplemented(implementation=implementation.__name__)
        session.report(found.at(class_span(implementation)))
        return None
    return library.refine(implementation)


def _report_repeated(classes: Iterable[type]) -> None:
    """Report implementations that have the name of another implementation or of a description."""
    seen: dict[str, type] = {}
    for each in classes:
        other = seen.setdefault(each.__name__, each)
        if other is not each and issubclass(each, SkillImplementation):
            session.report(repeated(each, class_span(each), other, class_span(other)))
