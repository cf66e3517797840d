"""All checks of some skills, in one order."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from dslkit.diagnostics import Diagnostic, remarked
from ezskiros import session
from ezskiros.check.consistency import check_consistency
from ezskiros.check.directions import check_directions
from ezskiros.check.individuals import Individuals
from ezskiros.check.inference import check_inference
from ezskiros.check.outputs import check_outputs
from ezskiros.check.relations import check_relations
from ezskiros.check.repeated import repeated
from ezskiros.ontology import Ontology
from ezskiros.skills import SkillDescription, tree_errors
from ezskiros.skills.calls import SkillClass
from ezskiros.skills.describe import DescribedSkill, describe
from ezskiros.skills.errors import HasKey
from ezskiros.skills.interface import SkillInterface
from ezskiros.skills.syntax import attributes_in, class_span
from ezskiros.trees.library import implementations

CHECKS = (check_relations, check_consistency, check_outputs)


def check_skills(
    skills: Iterable[SkillClass], scenes: Sequence[Path] = ()
) -> dict[SkillClass, DescribedSkill]:
    """The interfaces of skills. Mistakes are reported. `scenes` provide the individuals."""
    individuals = Individuals(scenes)
    found: dict[SkillClass, DescribedSkill] = {}
    names: dict[str, SkillClass] = {}
    for skill in skills:
        _report_implementing(skill)
        described = describe(skill)
        if described is None:
            continue
        interface = described.interface
        other = names.setdefault(interface.name, skill)
        if other is not skill:
            place = found[other].interface.span
            session.report(repeated(skill, interface.span, other, place))
        found[skill] = described
        if described.ontology is not None:
            for diagnostic in _findings(skill, described, described.ontology, individuals):
                session.report(_with_keys(diagnostic, interface))
    _report_directions(found.values())
    return found


def _report_directions(described: Iterable[DescribedSkill]) -> None:
    """Report relations that are reversed in a few conditions, among the skills of one ontology."""
    skills: dict[Ontology, list[SkillInterface]] = {}
    for each in described:
        if each.ontology is not None:
            skills.setdefault(each.ontology, []).append(each.interface)
    for ontology, those in skills.items():
        for diagnostic in check_directions(those, ontology.model):
            session.report(diagnostic)


def _report_implementing(skill: SkillClass) -> None:
    """Report a description that is written like an implementation."""
    for method in ("expandBT", "execute"):
        above = skill.__mro__[1]
        if method in vars(skill) and above is not SkillDescription:
            found = tree_errors.DescriptionImplemented(
                implementation=skill.__name__, method=method, skill=above.__name__
            )
            session.report(found.at(class_span(skill)))


def _findings(
    skill: SkillClass,
    described: DescribedSkill,
    ontology: Ontology,
    individuals: Individuals,
) -> Iterator[Diagnostic]:
    for check in CHECKS:
        yield from check(described.interface, ontology)
    # A condition that was not understood may be the one that determines a parameter.
    if described.is_whole:
        used = frozenset[str]().union(*map(attributes_in, implementations(skill).values()))
        yield from check_inference(described.interface, ontology, individuals, used)


def _with_keys(found: Diagnostic, skill: SkillInterface) -> Diagnostic:
    """A finding with the SkiROS2 names of the parameters at which it points."""
    places = {found.primary.span, *(label.span for label in found.labels)}
    notes = (
        HasKey(parameter=each.name, key=repr(each.key))
        for each in skill.parameters
        if each.key != each.name and each.span in places
    )
    return remarked(found, *notes)
