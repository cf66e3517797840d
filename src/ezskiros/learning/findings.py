"""Findings of `check` about the skills in the files, from recorded runs."""

from __future__ import annotations

from collections.abc import Iterator

from dslkit.diagnostics import Diagnostic, Remark
from ezskiros.learning.errors import RuleTripped, SkillFailed
from ezskiros.learning.lessons import Lessons, Trip
from ezskiros.learning.report import Spell, places_text
from ezskiros.skills.interface import SkillInterface
from ezskiros.trees.library import Library

_MOST_PLACES = 3
"""The most places in a finding; places with the most runs come first."""


def findings(lessons: Lessons, library: Library) -> Iterator[Diagnostic]:
    """Findings from recorded runs about the checked skills, at their names."""
    found = (library.skill(each) for each in library.checked)
    skills = {each.name: each for each in found if each is not None}
    ontology = library.ontology()
    spell: Spell = ontology.model.short if ontology is not None else str
    for trip in lessons.trips:
        if trip.skill in skills:
            yield _tripped(trip, skills[trip.skill], spell)
    for failure in lessons.failures:
        if failure.skill in skills:
            said = SkillFailed(skill=failure.skill, share=str(failure.share), reason=failure.reason)
            yield said.at(skills[failure.skill].span)


def _tripped(trip: Trip, skill: SkillInterface, spell: Spell) -> Diagnostic:
    found = RuleTripped(
        skill=skill.name, rule=trip.rule, share=str(trip.share), evidence=trip.evidence
    )
    notes: list[Remark] = [
        found.Place(places=places_text(places, spell), share=str(share))
        for places, share in list(trip.at.items())[:_MOST_PLACES]
        if places and share.runs
    ]
    notes.append(found.WithHold() if skill.hold else found.WithoutHold())
    return found.at(skill.span, notes=notes)
