"""The skills of a robot, as `ezskiros export` tells of them in a file.

Knows nothing of rules: what a file says, whether it is as its format demands, and whether it is
still true of the files that it was made from.
"""

from rossmarie.skills.closed import Closure
from rossmarie.skills.model import (
    Child,
    Condition,
    Conditions,
    Control,
    Limit,
    Location,
    Node,
    Parameter,
    Permission,
    Place,
    Property,
    Skill,
    SkillClass,
    SkillFile,
    Source,
    Step,
    Use,
    UseKind,
)
from rossmarie.skills.names import among
from rossmarie.skills.read import LARGEST_FILE, UnreadableSkills, parse_skills, read_text
from rossmarie.skills.sources import OutOfDate, changed_source, span_at

__all__ = [
    "LARGEST_FILE",
    "Child",
    "Closure",
    "Condition",
    "Conditions",
    "Control",
    "Limit",
    "Location",
    "Node",
    "OutOfDate",
    "Parameter",
    "Permission",
    "Place",
    "Property",
    "Skill",
    "SkillClass",
    "SkillFile",
    "Source",
    "Step",
    "UnreadableSkills",
    "Use",
    "UseKind",
    "among",
    "changed_source",
    "parse_skills",
    "read_text",
    "span_at",
]
