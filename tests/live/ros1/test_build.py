"""Nodes are built without a warning as their users build them: optimized, file by file."""

from __future__ import annotations

from pathlib import Path

import pytest

from rossmarie.driver import compile_file
from support.live_cases import vehicle
from support.parts import ROS1, needs
from support.ros1_live import Ros1

ROOT = Path(__file__).parents[3]
RULES = (
    ROOT / "examples" / "husky" / "husky.ross",
    ROOT / "examples" / "thesis" / "arm.ross",
    ROOT / "examples" / "thesis" / "mobile_base.ross",
    ROOT / "src" / "heron" / "rules" / "navigation.ross",
)


@needs(ROS1)
@pytest.mark.deep
def test_nodes_are_built_as_users_build_them(tmp_path: Path) -> None:
    ros1 = Ros1(tmp_path)
    messages = ROOT / "examples" / "thesis" / "msg" / "heron_msgs"
    machines = [vehicle(), *(compile_file(rules).machine for rules in RULES)]
    try:
        *programs, _ = ros1.prepare([*machines, messages])
    finally:
        ros1.end()
    assert all(program.is_file() for program in programs)
