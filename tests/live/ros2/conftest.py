"""These tests run on ROS 2 only."""

from __future__ import annotations

import pytest

from support.live import Ros
from support.ros2_live import Ros2


@pytest.fixture(scope="module")
def ros(ros2: Ros2) -> Ros:
    """The one generation."""
    return ros2
