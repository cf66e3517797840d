# mypy: ignore-errors
"""Starts a skill by its name in real SkiROS2, with individuals by their labels; ends when told
to.
"""

from __future__ import annotations

import sys

import rospy
from skiros2_common.core.world_element import Element
from skiros2_skill.ros.skill_manager_interface import SkillManagerInterface
from skiros2_world_model.ros.world_model_interface import WorldModelInterface


def main(robot: str, name: str, *values: str) -> None:
    """Start it, and wait."""
    rospy.init_node("starts_skills", anonymous=True)
    world, manager = WorldModelInterface(), SkillManagerInterface(robot, rospy.get_name())
    skill = manager.get_skill(name)
    for value in values:
        parameter, _, label = value.partition("=")
        kind = skill.ph.getParam(parameter).value.type
        skill.ph.specify(parameter, world.resolve_element(Element(kind, label)))
    manager.execute(skill_list=[skill])
    sys.stdout.write("started\n")
    sys.stdout.flush()
    rospy.spin()


if __name__ == "__main__":
    main(*sys.argv[1:])
