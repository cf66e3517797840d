"""All checks of some skills, in one order."""

from __future__ import annotations

from collections.abc import Iterable

from dslkit.diagnostics import Label
from ezskiros import session
from ezskiros.check.consistency import check_consistency
from ezskiros.check.inference import check_inference
from ezskiros.check.relations import check_relations
from ezskiros.skills import SkillDescription, errors
from ezskiros.skills.describe import describe
from ezskiros.skills.interface import SkillInterface

CHECKS = (check_relations, check_consistency)


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
                    session.report(diagnostic)
    return list(found.values())
