"""Starts a skill in SkiROS2, and prints its progress until the skill ends.

    python start_in_skiros2.py pick_and_place Object=cable Gripper=gripper PlacingLocation=shelf

Arguments name individuals by their labels.
"""

import sys
from queue import Queue

import rospy
from skiros2_common.core.abstract_skill import State
from skiros2_common.core.world_element import Element
from skiros2_skill.ros.skill_manager_interface import SkillManagerInterface
from skiros2_world_model.ros.world_model_interface import WorldModelInterface

ROBOT = "/heron"


def run(name: str, values: list[str]) -> State:
    """Start a skill, and print the messages of its tree until the skill has a result."""
    rospy.init_node("start_in_skiros2", anonymous=True)
    world, manager = WorldModelInterface(), SkillManagerInterface(ROBOT, rospy.get_name())
    skill = manager.get_skill(name)
    for value in values:
        parameter, _, label = value.partition("=")
        kind = skill.ph.getParam(parameter).value.type
        element = world.resolve_element(Element(kind, label))
        if element is None:
            sys.exit(f"the world has no {kind} with the label {label}")
        skill.ph.specify(parameter, element)
    reported: Queue = Queue()
    manager.set_monitor_cb(reported.put)
    manager.execute(skill_list=[skill])
    seen: dict[int, tuple] = {}
    result = State.Running
    while result is State.Running:
        for each in reported.get(timeout=60).progress:
            state, message = State(each.state), each.progress_message
            if seen.get(each.id) != (state, message) and message not in ("", "Start", "End"):
                print(f"{each.label}: {state.name}: {message.strip()}", flush=True)
            seen[each.id] = (state, message)
            if "Root" in each.type:
                result = state
    return result


if __name__ == "__main__":
    result = run(sys.argv[1], sys.argv[2:])
    print(f"{sys.argv[1]}: {result.name}")
    sys.exit(result is not State.Success)
