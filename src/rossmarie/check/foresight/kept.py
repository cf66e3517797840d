"""Requirements of rules: each rule keeps a motion below a speed, in a zone or in the locations of a
class.
"""

from __future__ import annotations

from rossmarie import core
from rossmarie.check.expressions.infer import infer
from rossmarie.check.foresight.errors import KeptGivesWay, UndeclaredMotion
from rossmarie.check.model import CheckedKeeps, CheckedMotion
from rossmarie.check.names.references import report_wrong_kind
from rossmarie.check.names.regions import places_of
from rossmarie.check.operations.stopping import wanted_speed
from rossmarie.check.scopes.context import Context
from rossmarie.check.skills.doing import find_class, known_skills
from rossmarie.syntax import ast
from rossmarie.types import Region


def check_kept(rule: ast.Rule, context: Context) -> CheckedKeeps | None:
    """The speed limit of a rule, and its locations. None if the rule has no requirement, or after
    reporting.
    """
    written = rule.keeps
    if written is None:
        return None
    _report_giving_way(rule, written, context)
    motion = _motion(written.motion, context)
    infer(written.speed, context)
    speed = wanted_speed(written.speed, motion, context)
    places = _places(written, context)
    if motion is None or speed is None or places is None:
        return None
    region, type_ = places
    return CheckedKeeps(motion, speed, region, type_.frame, written)


def _places(written: ast.Keeps, context: Context) -> tuple[core.Region, Region] | None:
    """The zone or the locations of the class in which a speed is kept; None after reporting."""
    name = written.place.text
    if isinstance(context.declarations.names.get(name), ast.Zone):
        context.used_names.add(name)
        return context.zones.get(name)
    skills = known_skills(written, context)
    owl_class = None if skills is None else find_class(written.place, skills, context)
    if skills is None or owl_class is None:
        return None
    return places_of(owl_class, written.place.span, skills, context)


def _report_giving_way(rule: ast.Rule, written: ast.Keeps, context: Context) -> None:
    own = "this rule" if rule.name is None else rule.name.text
    for other in rule.unless:
        finding = KeptGivesWay(rule=own, motion=written.motion.text, other=other.text)
        context.collector.add(finding.at(other.span))


def _motion(name: ast.Name, context: Context) -> CheckedMotion | None:
    declared = context.declarations.names.get(name.text)
    if isinstance(declared, ast.Motion):
        context.used_names.add(name.text)
        return context.motions.get(name.text)
    if declared is not None:
        report_wrong_kind(name, declared, "a motion", context)
    elif context.declarations.is_whole:
        known = [
            item.name.text for item in context.declarations.items if isinstance(item, ast.Motion)
        ]
        context.report_unknown(UndeclaredMotion(identifier=name.text), name, known)
    return None
