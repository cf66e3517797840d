# mypy: ignore-errors
"""A robot and its planner for live tests: a ROS 2 node that is told what to do by lines of JSON.

Runs with the Python of ROS 2. Reads one request from each line, answers with one; the same
requests as `ros1_robot.py` takes.
"""

import json
import math
import os
import sys
import threading
import time
from collections import deque

import rclpy
from arm_msgs.action import Move
from builtin_interfaces.msg import Duration, Time
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist
from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu, LaserScan
from std_msgs.msg import Bool, String
from std_srvs.srv import SetBool
from vehicle_safety.msg import State, Verdict
from vehicle_safety.srv import Exempt, Reset, Why

NODE = "/vehicle_safety"
SENSOR = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
KEPT = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Robot:
    """Publishes what it is told, and remembers what it hears."""

    def __init__(self, node):
        self.pitch = None  # degrees; None: the IMU is silent
        self.speed = None  # m/s, or "nan"; None: the planner is silent
        self.near = None  # whether something is near; None: the scanner is silent
        self.mode = "driving"
        self.clock = None  # simulated time in s; None: there is none
        self.moving = False  # whether the arm moves, goal or not
        self.frozen = False  # the stamps of the IMU stand still
        self.lamp = True  # whether the lamp answers with success
        self.heard = {"/lamp": deque(), "/arm": deque()}
        self._node = node
        self._group = ReentrantCallbackGroup()
        self._stamp = Time(sec=1)
        self._imu = node.create_publisher(Imu, "/imu/data", SENSOR)
        self._planner = node.create_publisher(Twist, "/unfil_cmd_vel", 1)
        self._scan = None  # nobody publishes it before something is to be near or not
        self._clock = None
        self._mode = node.create_publisher(String, "/mode", 1)
        self._arm_moving = node.create_publisher(Bool, "/arm/moving", 1)
        self._arm = ActionServer(
            node,
            Move,
            "/arm",
            self._move_arm,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
            callback_group=self._group,
        )
        self._client = ActionClient(node, Move, "/unfil_arm", callback_group=self._group)
        self._hear("/cmd_vel", Twist, lambda m: m.linear.x)
        self._hear("/horn", Bool, lambda m: m.data)
        self._hear(NODE + "/state", State, _plain, KEPT)
        self._hear(NODE + "/verdicts", Verdict, _plain)
        self._hear("/diagnostics", DiagnosticArray, _plain)
        node.create_service(SetBool, "/lamp", self._switch_lamp, callback_group=self._group)
        node.create_timer(0.01, self._publish_sensors)
        node.create_timer(0.02, self._publish_command)

    def _hear(self, topic, kind, read, qos=10):
        self.heard[topic] = deque(maxlen=5000)
        note = self.heard[topic].append
        self._node.create_subscription(kind, topic, lambda m: note([time.time(), read(m)]), qos)

    def _publish_sensors(self):
        if self.clock is not None:
            self._clock = self._clock or self._node.create_publisher(Clock, "/clock", 1)
            self.clock += 0.01
            self._clock.publish(Clock(clock=_time(self.clock)))
        message = Imu()
        if not self.frozen:
            self._stamp = _time(time.time() if self.clock is None else self.clock)
        message.header.stamp = self._stamp
        message.orientation.y = math.sin(math.radians(self.pitch or 0.0) / 2)
        message.orientation.w = math.cos(math.radians(self.pitch or 0.0) / 2)
        if self.pitch is not None:
            self._imu.publish(message)
        if self.near is not None:
            self._scan = self._scan or self._node.create_publisher(LaserScan, "/scan", SENSOR)
            self._scan.publish(LaserScan(ranges=[2.0, 0.1 if self.near else 1.0]))
        self._mode.publish(String(data=self.mode))
        self._arm_moving.publish(Bool(data=self.moving))

    def _publish_command(self):
        if self.speed is not None:
            message = Twist()
            message.linear.x = float(self.speed)
            self._planner.publish(message)

    def _move_arm(self, goal):
        """Goes on until it is cancelled."""
        target = goal.request.target
        self.heard["/arm"].append([time.time(), ["begins", target]])
        while not goal.is_cancel_requested and rclpy.ok():
            time.sleep(0.01)
        self.heard["/arm"].append([time.time(), ["is cancelled", target]])
        goal.canceled()
        return Move.Result()

    def _switch_lamp(self, request, response):
        self.heard["/lamp"].append([time.time(), request.data])
        response.success = self.lamp
        return response

    def answer(self, request):
        """What a request asks for."""
        for name, value in request.get("set", {}).items():
            setattr(self, name, value)
        if "goal" in request:
            self._client.wait_for_server(timeout_sec=5.0)
            self._client.send_goal_async(Move.Goal(target=request["goal"]))
        if "heard" in request:
            return list(self.heard.get(request["heard"], ()))
        if "forget" in request:
            self.heard[request["forget"]].clear()
        if "call" in request:
            return self._call(request["call"], request["with"])
        return None

    def _call(self, name, arguments):
        kind = {"reset": Reset, "why": Why, "exempt": Exempt}[name]
        client = self._node.create_client(kind, NODE + "/" + name, callback_group=self._group)
        client.wait_for_service(timeout_sec=5.0)
        if "time" in arguments:
            seconds = arguments["time"]
            whole = math.floor(seconds)
            arguments["time"] = Duration(sec=whole, nanosec=round((seconds - whole) * 1e9))
        return _plain(client.call(kind.Request(**arguments)))


def _time(seconds):
    whole = math.floor(seconds)
    return Time(sec=whole, nanosec=min(round((seconds - whole) * 1e9), 999_999_999))


def _plain(value):
    """A message as JSON has it."""
    if isinstance(value, (Time, Duration)):
        return value.sec + value.nanosec / 1e9
    if hasattr(value, "get_fields_and_field_types"):
        return {name: _plain(getattr(value, name)) for name in value.get_fields_and_field_types()}
    if isinstance(value, bytes):
        return value[0]
    if isinstance(value, (list, tuple)):
        return [_plain(each) for each in value]
    return value


def main():
    rclpy.init()
    node = rclpy.create_node("robot")
    robot = Robot(node)
    executor = MultiThreadedExecutor(4)
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    for line in sys.stdin:
        sys.stdout.write(json.dumps(robot.answer(json.loads(line))) + "\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
    os._exit(0)
