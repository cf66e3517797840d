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
from controller_manager_msgs.srv import SwitchController
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist, TwistStamped
from rcl_interfaces.msg import SetParametersResult
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
RECOVERY = 99  # the goal of the rules
SENSOR = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
KEPT = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Robot:
    """Publishes what it is told, and remembers what it hears."""

    def __init__(self, node, executor):
        self.pitch = None  # degrees, or "nan"; None: the IMU is silent
        self.belated = None  # degrees; what the IMU says again and again with an older stamp
        self.speed = None  # m/s, or "nan"; None: the planner is silent
        self.arm_speed = None  # m/s; None: nobody commands the arm
        self.near = None  # whether something is near; None: the scanner is silent
        self.mode = "driving"
        self.clock = None  # simulated time in s; None: there is none
        self.moving = False  # whether the arm moves, goal or not
        self.frozen = False  # the stamps of the IMU stand still
        self.lamp = True  # whether the lamp answers with success
        self.recovery = "goes on"  # what comes of the goal of the rules, or "succeeds", "aborts"
        self.delay = 0.0  # s, after which the planner answers
        self.switches = True  # whether the controller manager does what it is asked for
        self.heard = {}
        self._node = node
        self._executor = executor
        self._group = ReentrantCallbackGroup()
        self._stamp_s = 1.0
        self._imu = node.create_publisher(Imu, "/imu/data", SENSOR)
        self._planner = node.create_publisher(Twist, "/unfil_cmd_vel", 1)
        self._arm_planner = node.create_publisher(TwistStamped, "/unfil_arm_vel", 1)
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
        self._hear("/arm_vel", TwistStamped, lambda m: [m.header.frame_id, m.twist.linear.x])
        self._hear("/horn", Bool, lambda m: m.data)
        self._hear(NODE + "/state", State, _plain, KEPT)
        self._hear(NODE + "/verdicts", Verdict, _plain)
        self._hear("/diagnostics", DiagnosticArray, _plain)
        node.create_service(SetBool, "/lamp", self._switch_lamp, callback_group=self._group)
        node.create_timer(0.01, self._publish_sensors)
        node.create_timer(0.02, self._publish_command)

    def _hear(self, topic, kind, read, qos=10):
        self.heard[topic] = deque(maxlen=50000)
        note = self.heard[topic].append
        self._node.create_subscription(kind, topic, lambda m: note([time.time(), read(m)]), qos)

    def _publish_sensors(self):
        if self.clock is not None:
            self._clock = self._clock or self._node.create_publisher(Clock, "/clock", 1)
            self.clock += 0.01
            self._clock.publish(Clock(clock=_time(self.clock)))
        if not self.frozen:
            self._stamp_s = time.time() if self.clock is None else self.clock
        self._publish_pitch(self.pitch, self._stamp_s)
        self._publish_pitch(self.belated, self._stamp_s - 0.05)
        if self.near is not None:
            self._scan = self._scan or self._node.create_publisher(LaserScan, "/scan", SENSOR)
            self._scan.publish(LaserScan(ranges=[2.0, 0.1 if self.near else 1.0]))
        self._mode.publish(String(data=self.mode))
        self._arm_moving.publish(Bool(data=self.moving))

    def _publish_pitch(self, degrees, stamp_s):
        if degrees is None:
            return
        message = Imu()
        message.header.stamp = _time(stamp_s)
        message.orientation.y = math.sin(math.radians(float(degrees)) / 2)
        message.orientation.w = math.cos(math.radians(float(degrees)) / 2)
        self._imu.publish(message)

    def _publish_command(self):
        if self.speed is not None:
            message = Twist()
            message.linear.x = float(self.speed)
            self._planner.publish(message)
        if self.arm_speed is not None:
            stamped = TwistStamped()
            stamped.header.frame_id = "tool"
            stamped.twist.linear.x = self.arm_speed
            self._arm_planner.publish(stamped)

    def _move_arm(self, goal):
        """Goes on until it is cancelled."""
        wanted = goal.request.goal
        self._note("/arm", ["begins", wanted])
        end = {"succeeds": goal.succeed, "aborts": goal.abort}
        while not goal.is_cancel_requested and rclpy.ok():
            time.sleep(0.01)
            if wanted == RECOVERY and self.recovery in end:
                self._note("/arm", [self.recovery, wanted])
                end[self.recovery]()
                return Move.Result()
        self._note("/arm", ["is cancelled", wanted])
        goal.canceled()
        return Move.Result()

    def _send_goal(self, goal):
        self._client.wait_for_server(timeout_sec=5.0)
        sent = self._client.send_goal_async(Move.Goal(goal=goal))
        sent.add_done_callback(
            lambda done: (
                done.result()
                .get_result_async()
                .add_done_callback(lambda _: self._note("/goals", ["ends", goal]))
            )
        )

    def _offer_planner(self):
        """A node whose `double_` is 3."""
        self._planner_node = rclpy.create_node("planner")
        self._planner_node.add_on_set_parameters_callback(self._set_parameters)
        self._planner_node.declare_parameter("double_", 3.0)
        self._planner_node.declare_parameter("int_", 0)
        self._executor.add_node(self._planner_node)

    def _set_parameters(self, parameters):
        time.sleep(self.delay)
        if any(one.name == "int_" and one.value > 10 for one in parameters):
            return SetParametersResult(successful=False, reason="10 is the most")
        for one in parameters:
            self._note("/planner/" + one.name, one.value)
        return SetParametersResult(successful=True)

    def _offer_controllers(self):
        name = "/controller_manager/switch_controller"
        self._node.create_service(
            SwitchController, name, self._switch_controllers, callback_group=self._group
        )

    def _switch_controllers(self, request, response):
        asked = [list(request.activate_controllers), list(request.deactivate_controllers)]
        self._note("/controllers", asked if request.strictness == request.STRICT else "not strict")
        response.ok = self.switches
        return response

    def _note(self, name, what):
        self.heard.setdefault(name, deque()).append([time.time(), what])

    def _switch_lamp(self, request, response):
        self._note("/lamp", request.data)
        response.success = self.lamp
        return response

    def answer(self, request):
        """What a request asks for."""
        for name, value in request.get("set", {}).items():
            setattr(self, name, value)
        if "goal" in request:
            self._send_goal(request["goal"])
        if "reliabilities" in request:
            return {topic: self._reliability(topic) for topic in request["reliabilities"]}
        if "keep" in request:
            self._keep_scan()
        if "offer" in request:
            getattr(self, "_offer_" + request["offer"])()
        if "heard" in request:
            return list(self.heard.get(request["heard"], ()))
        if "forget" in request:
            self.heard.get(request["forget"], deque()).clear()
        if "call" in request:
            return self._call(request["call"], request["with"])
        return None

    def _keep_scan(self):
        """Says once that something is near, to those who come later, too."""
        self._scan = self._node.create_publisher(LaserScan, "/scan", KEPT)
        self._scan.publish(LaserScan(ranges=[0.1]))

    def _reliability(self, topic):
        """The one that the node asks for."""
        found = self._node.get_subscriptions_info_by_topic(topic)
        own = [one.qos_profile.reliability for one in found if one.node_name == NODE[1:]]
        return own[-1].name if own else None

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
    executor = MultiThreadedExecutor(6)
    robot = Robot(node, executor)
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    for line in sys.stdin:
        sys.stdout.write(json.dumps(robot.answer(json.loads(line))) + "\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
    os._exit(0)
