"""The tasks of the robot, as programs that only use topics and action servers."""

from heron.tasks.look_out import LookOut, LookOutParameters
from heron.tasks.navigation import Navigation, NavigationParameters
from heron.tasks.outcome import TaskStatus
from heron.tasks.place_navigation import PlaceNavigation
from heron.tasks.skill_context import SkillContextPublisher
from heron.tasks.skill_task import SkillTask
from heron.tasks.tree import SkillSpan, Status, TreeSkill

__all__ = [
    "LookOut",
    "LookOutParameters",
    "Navigation",
    "NavigationParameters",
    "PlaceNavigation",
    "SkillContextPublisher",
    "SkillSpan",
    "SkillTask",
    "Status",
    "TaskStatus",
    "TreeSkill",
]
