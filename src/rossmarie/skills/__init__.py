"""The skills of a robot, as `ezskiros export` describes them in a file.

This package knows nothing about rules. It reads the content of the file, checks its format, and
checks that the file still fits its sources.
"""

from rossmarie.skills.closed import Closure
from rossmarie.skills.model import (
    ChildSkill,
    Control,
    IndividualProperty,
    Location,
    Node,
    OntologyClass,
    Permission,
    PermissionLimit,
    Skill,
    SkillCondition,
    SkillConditions,
    SkillFile,
    SkillNode,
    SkillParameter,
    SkillSource,
    SourcePlace,
    Use,
    UseKind,
)
from rossmarie.skills.names import among
from rossmarie.skills.read import LARGEST_FILE, UnreadableSkills, parse_skills, read_text
from rossmarie.skills.sources import OutOfDate, changed_source, span_at

__all__ = [
    "LARGEST_FILE",
    "ChildSkill",
    "Closure",
    "Control",
    "IndividualProperty",
    "Location",
    "Node",
    "OntologyClass",
    "OutOfDate",
    "Permission",
    "PermissionLimit",
    "Skill",
    "SkillCondition",
    "SkillConditions",
    "SkillFile",
    "SkillNode",
    "SkillParameter",
    "SkillSource",
    "SourcePlace",
    "UnreadableSkills",
    "Use",
    "UseKind",
    "among",
    "changed_source",
    "parse_skills",
    "read_text",
    "span_at",
]
