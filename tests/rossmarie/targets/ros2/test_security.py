"""The policy for SROS2, without ROS; tests/live/ros2/test_security.py compares it with the node."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import pytest

from rossmarie.driver.build import generate
from rossmarie.targets.ros2 import security
from support.live_cases import acting, vehicle

# What each node that is generated has.
OF_EACH = {
    "publish": {"/bond", "/diagnostics", "/parameter_events", "/rosout", "~/bypassed", "~/state",
                "~/transition_event", "~/verdicts"},
    "subscribe": {"/bond", "/clock", "/parameter_events"},
}  # fmt: skip


def enclaves(text: str) -> dict[str, dict[tuple[str, str], set[str]]]:
    """For each enclave the names by right and verdict."""
    found = {}
    for enclave in ET.fromstring(text).iter("enclave"):
        groups = [
            (next(iter(group.attrib.items())), group) for group in next(enclave.iter("profile"))
        ]
        found[enclave.attrib["path"]] = {
            key: {str(each.text) for each in group} for key, group in groups
        }
    return found


@pytest.mark.parametrize(
    ("effects", "right", "names"),
    [
        ("publish /siren : std_msgs/Bool { data = true; }", "publish", {"siren"}),
        ("call /lamp : std_srvs/Trigger", "request", {"lamp"}),
        (
            "set /planner.max_speed to 0.2",
            "request",
            {"planner/get_parameters", "planner/set_parameters"},
        ),
        ("cancel /arm within 1 sec", "call", {"arm"}),
    ],
)
def test_an_effect_has_the_rights_that_it_needs(effects: str, right: str, names: set[str]) -> None:
    (node,) = enclaves(security.policy(acting(effects))).values()
    assert node[right, "ALLOW"] - OF_EACH.get(right, set()) == names


def test_the_planner_has_the_topics_in_front_of_the_filter_and_not_those_behind() -> None:
    found = enclaves(security.policy(vehicle("ros2")))
    node, planner = found["/vehicle_safety"], found["/behind_vehicle_safety"]
    assert planner["publish", "DENY"] == {"cmd_vel", "arm_vel"}
    assert planner["publish", "DENY"] <= node["publish", "ALLOW"]
    front = planner["publish", "ALLOW"] - OF_EACH["publish"]
    assert front == {"unfil_cmd_vel", "unfil_arm_vel"}
    assert front <= node["subscribe", "ALLOW"]
    assert planner["call", "DENY"] == {"arm", "hand"}
    assert planner["call", "ALLOW"] == node["execute", "ALLOW"] == {"unfil_arm", "unfil_hand"}


def test_inputs_are_heard_and_operators_are_answered() -> None:
    node = enclaves(security.policy(vehicle("ros2")))["/vehicle_safety"]
    assert {"imu/data", "scan"} <= node["subscribe", "ALLOW"]
    assert {"~/reset", "~/exempt", "~/why"} <= node["reply", "ALLOW"]


def test_it_is_installed() -> None:
    files = generate(vehicle("ros2"), "ros2")
    assert "security/policy.xml" in files
    assert (
        "security/policy.xml\n  DESTINATION share/${PROJECT_NAME}/security"
        in files["runtime/ros2/guard.cmake"]
    )
