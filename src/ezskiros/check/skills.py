"""All checks of some skills, in one order."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from dslkit.diagnostics import Diagnostic, Label
from ezskiros import session
from ezskiros.check.consistency import check_consistency
from ezskiros.check.inference import check_inference
from ezskiros.check.outputs import check_outputs
from ezskiros.check.relations import check_relations
from ezskiros.skills import SkillDescription, errors
from ezskiros.skills.describe import describe
from ezskiros.skills.interface import SkillInterface

CHECKS = (check_relations, check_consistency, check_outputs)


def check_skills(skills: Iterable[type[SkillDescription]]) -> list[SkillInterface]:
    """The interfaces of skills; what is wrong is reported."""
    found: dict[str, SkillInterface] = {}
    for skill in skills:
        described = describe(skill)
        if described is None:
            continue
        interface = described.interface
        if interface.name in found:
            label = Label(found[interface.name].span, "the other one")
            session.report(errors.DuplicateSkill(skill=interface.name).at(interface.span, label))
        found.setdefault(interface.name, interface)
        if described.ontology is not None:
            # A condition that was not understood may be the one that leads to a parameter.
            checks = (*CHECKS, check_inference) if described.is_whole else CHECKS
            for check in checks:
                for diagnostic in check(interface, described.ontology):
                    session.report(_with_keys(diagnostic, interface))
    return list(found.values())


def _with_keys(found: Diagnostic, skill: SkillInterface) -> Diagnostic:
    """A finding that also says what SkiROS2 calls the parameters at which it points."""
    places = {found.primary.span, *(label.span for label in found.labels)}
    notes = (
        f"`{each.name}` has the key {each.key!r}"
        for each in skill.parameters
        if each.key != each.name and each.span in places
    )
    return replace(found, notes=(*found.notes, *notes))
