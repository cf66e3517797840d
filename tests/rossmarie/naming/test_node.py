"""The name of a node, and the topics on which it receives commands."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rossmarie.naming import node_name, unfiltered
from support.live_cases import vehicle


@pytest.mark.parametrize(
    ("topic", "source"),
    [
        ("/cmd_vel", "/unfil_cmd_vel"),
        ("/robot/cmd_vel", "/robot/unfil_cmd_vel"),
        ("cmd_vel", "unfil_cmd_vel"),
    ],
)
def test_commands_come_from_a_topic_beside(topic: str, source: str) -> None:
    assert unfiltered(topic) == source


@pytest.mark.parametrize(
    ("rules", "package"),
    [("std_msgs", "std_msgs_safety"), ("switch", "switch_safety"), ("2 Räder", "n2_rader_safety")],
)
def test_a_package_is_called_like_its_rules_but_like_no_other(rules: str, package: str) -> None:
    assert node_name(replace(vehicle(), name=rules)) == package
