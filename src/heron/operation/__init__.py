"""The insertion in operation, on ROS 1 in real time. The arm is a node, and so is the policy that
commands it. The node that is generated from the rules stands between the two.
"""

from heron.operation.live_arm import LiveArm
from heron.operation.live_policy import LivePolicy

__all__ = ["LiveArm", "LivePolicy"]
