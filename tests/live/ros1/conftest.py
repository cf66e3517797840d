"""These tests run on ROS 1 only."""

from __future__ import annotations

import pytest

from support.live import Ros
from support.ros1_live import Ros1


@pytest.fixture(scope="module")
def ros(ros1: Ros1) -> Ros:
    """The one generation."""
    return ros1
