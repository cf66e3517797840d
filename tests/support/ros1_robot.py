# mypy: ignore-errors
"""The robot of `robot.py` in ROS 1."""

import rospy
from actionlib_msgs.msg import GoalStatusArray
from dynamic_reconfigure.cfg import TestConfig
from dynamic_reconfigure.server import Server
from ears import run
from robot import Robot


class Robot1(Robot):
    """Its planner is reconfigured dynamically."""

    ACTION = "actionlib/Test"
    SWITCHED = ("start_controllers", "stop_controllers")

    def __init__(self):
        super().__init__()
        self._arm_status = self.publisher("/arm/status", GoalStatusArray)

    def _offer_planner(self):
        """A node whose `double_` is 3."""
        rospy.set_param("/planner/double_", 3.0)
        self._reconfigured = Server(TestConfig, self._reconfigure, namespace="/planner")

    def _reconfigure(self, config, _level):
        rospy.sleep(self.delay)
        for name in ("double_", "int_"):
            self.note("/planner/" + name, config[name])
        return config

    def answer(self, request):
        """Answer a request."""
        if "lose_goals" in request:
            self._arm_status.publish(GoalStatusArray())
        return super().answer(request)


if __name__ == "__main__":
    run(Robot1)
