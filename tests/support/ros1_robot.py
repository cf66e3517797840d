# mypy: ignore-errors
"""A robot and its planner for live tests: a ROS node that is told what to do by lines of JSON.

Runs with the system's Python, which has rospy. Reads one request from each line, answers with one.
"""

import json
import math
import os
import sys
import time
from collections import deque

import actionlib
import rospy
from actionlib.msg import TestAction, TestGoal
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu, LaserScan
from std_msgs.msg import Bool, String
from std_srvs.srv import SetBool, SetBoolResponse
from vehicle_safety.msg import State, Verdict
from vehicle_safety.srv import Exempt, Reset, Why

NODE = "/vehicle_safety"


class Robot:
    """Publishes what it is told, and remembers what it hears."""

    def __init__(self):
        self.pitch = None  # degrees; None: the IMU is silent
        self.speed = None  # m/s, or "nan"; None: the planner is silent
        self.near = None  # whether something is near; None: the scanner is silent
        self.mode = "driving"
        self.clock = None  # simulated time in s; None: there is none
        self.moving = False  # whether the arm moves, goal or not
        self.frozen = False  # the stamps of the IMU stand still
        self.lamp = True  # whether the lamp answers with success
        self.heard = {"/lamp": deque(), "/arm": deque()}
        self._stamp = rospy.Time(1)
        self._imu = rospy.Publisher("/imu/data", Imu, queue_size=1)
        self._planner = rospy.Publisher("/unfil_cmd_vel", Twist, queue_size=1)
        self._scan = None  # nobody publishes it before something is to be near or not
        self._clock = rospy.Publisher("/clock", Clock, queue_size=1)
        self._mode = rospy.Publisher("/mode", String, queue_size=1)
        self._arm_moving = rospy.Publisher("/arm/moving", Bool, queue_size=1)
        self._arm = actionlib.SimpleActionServer("/arm", TestAction, self._move_arm, False)
        self._arm.start()
        self._client = actionlib.SimpleActionClient("/arm", TestAction)
        self._hear("/cmd_vel", Twist, lambda m: m.linear.x)
        self._hear("/horn", Bool, lambda m: m.data)
        self._hear(NODE + "/state", State, _plain)
        self._hear(NODE + "/verdicts", Verdict, _plain)
        self._hear("/diagnostics", DiagnosticArray, _plain)
        rospy.Service("/lamp", SetBool, self._switch_lamp)
        rospy.Timer(rospy.Duration(0.01), self._publish_sensors)
        rospy.Timer(rospy.Duration(0.02), self._publish_command)

    def _hear(self, topic, kind, read):
        self.heard[topic] = deque(maxlen=5000)
        note = self.heard[topic].append
        rospy.Subscriber(topic, kind, lambda m: note([rospy.get_time(), read(m)]), tcp_nodelay=True)

    def _publish_sensors(self, _):
        message = Imu()
        if not self.frozen:
            self._stamp = rospy.Time.now()
        message.header.stamp = self._stamp
        message.orientation.y = math.sin(math.radians(self.pitch or 0.0) / 2)
        message.orientation.w = math.cos(math.radians(self.pitch or 0.0) / 2)
        if self.pitch is not None:
            self._imu.publish(message)

        if self.near is not None:
            self._scan = self._scan or rospy.Publisher("/scan", LaserScan, queue_size=1)
            self._scan.publish(LaserScan(ranges=[2.0, 0.1 if self.near else 1.0]))
        if self.clock is not None:
            self.clock += 0.01
            self._clock.publish(rospy.Time.from_sec(self.clock))
        self._mode.publish(self.mode)
        self._arm_moving.publish(self.moving)

    def _publish_command(self, _):
        if self.speed is not None:
            message = Twist()
            message.linear.x = float(self.speed)
            self._planner.publish(message)

    def _move_arm(self, goal):
        """Goes on until it is cancelled."""
        self.heard["/arm"].append([rospy.get_time(), ["begins", goal.goal]])
        while not self._arm.is_preempt_requested() and not rospy.is_shutdown():
            rospy.sleep(0.01)
        self.heard["/arm"].append([rospy.get_time(), ["is cancelled", goal.goal]])
        self._arm.set_preempted()

    def _switch_lamp(self, request):
        self.heard["/lamp"].append([rospy.get_time(), request.data])
        return SetBoolResponse(self.lamp, "")

    def answer(self, request):
        """What a request asks for."""
        for name, value in request.get("set", {}).items():
            setattr(self, name, value)
        if "goal" in request:
            self._send_goal(request["goal"])
        if "heard" in request:
            return list(self.heard.get(request["heard"], ()))
        if "forget" in request:
            self.heard[request["forget"]].clear()
        if "call" in request:
            return self._call(request["call"], request["with"])
        return None

    def _send_goal(self, goal):
        """Waits for the server and for the node: it cannot send again what it has not heard."""
        self._client.wait_for_server()
        end = time.monotonic() + 5.0
        while self._client.action_client.pub_goal.get_num_connections() < 2:
            if time.monotonic() > end:
                break
            time.sleep(0.02)
        self._client.send_goal(TestGoal(goal))

    def _call(self, name, arguments):
        kind = {"reset": Reset, "why": Why, "exempt": Exempt}[name]
        service = NODE + "/" + name
        rospy.wait_for_service(service, timeout=5.0)
        if "time" in arguments:
            arguments["time"] = rospy.Duration(arguments["time"])
        return _plain(rospy.ServiceProxy(service, kind)(**arguments))


def _plain(value):
    """A message as JSON has it."""
    if hasattr(value, "__slots__") and not hasattr(value, "to_sec"):
        return {name: _plain(getattr(value, name)) for name in value.__slots__}
    if hasattr(value, "to_sec"):
        return value.to_sec()
    if isinstance(value, (list, tuple)):
        return [_plain(each) for each in value]
    return value


def main():
    rospy.init_node("robot", disable_signals=True)
    robot = Robot()
    for line in sys.stdin:
        sys.stdout.write(json.dumps(robot.answer(json.loads(line))) + "\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
    os._exit(0)  # rospy keeps threads that would not end
