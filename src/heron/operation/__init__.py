"""The insertion in operation, on a live ROS 1 in real time: the arm is a node, and so is the policy
that commands it. Between the two stands the node that is generated from the rules.
"""

from heron.operation.live_arm import LiveArm
from heron.operation.live_policy import LivePolicy

__all__ = ["LiveArm", "LivePolicy"]
