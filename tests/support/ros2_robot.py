# mypy: ignore-errors
"""The robot of `robot.py` in ROS 2."""

import time

import rclpy
from ears import run
from geometry_msgs.msg import Twist
from rcl_interfaces.msg import SetParametersResult
from robot import NODE, Robot
from ros2_ears import LATCHED
from sensor_msgs.msg import LaserScan


class Robot2(Robot):
    """Its planner has parameters."""

    ACTION = "arm_msgs/Move"
    SWITCHED = ("activate_controllers", "deactivate_controllers")

    def _offer_planner(self):
        """A node whose `double_` is 3."""
        planner = rclpy.create_node("planner")
        planner.add_on_set_parameters_callback(self._set_parameters)
        planner.declare_parameter("double_", 3.0)
        planner.declare_parameter("int_", 0)
        self.node.executor.add_node(planner)

    def _set_parameters(self, parameters):
        time.sleep(self.delay)
        if any(one.name == "int_" and one.value > 10 for one in parameters):
            return SetParametersResult(successful=False, reason="10 is the most")
        for one in parameters:
            self.note("/planner/" + one.name, one.value)
        return SetParametersResult(successful=True)

    def answer(self, request):
        """Answer a request."""
        if "reliabilities" in request:
            return {topic: self._reliability(topic) for topic in request["reliabilities"]}
        if "keep" in request:
            getattr(self, "_keep_" + request["keep"])()
        return super().answer(request)

    def _keep_scan(self):
        """Says once that something is near, to those who come later, too."""
        self._scan = self.node.create_publisher(LaserScan, "/scan", LATCHED)
        self._scan.publish(LaserScan(ranges=[0.1]))

    def _keep_command(self):
        """The planner says 0.7 m/s once, to those who come later, too."""
        self.node.destroy_publisher(self._planner)
        self._planner = self.node.create_publisher(Twist, "/unfil_cmd_vel", LATCHED)
        message = Twist()
        message.linear.x = 0.7
        self._planner.publish(message)

    def _reliability(self, topic):
        """The one that the node asks for."""
        found = self.node.get_subscriptions_info_by_topic(topic)
        own = [one.qos_profile.reliability for one in found if one.node_name == NODE[1:]]
        return own[-1].name if own else None


if __name__ == "__main__":
    run(Robot2)
