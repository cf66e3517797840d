# mypy: ignore-errors
"""A robot and its planner for live tests: a ROS node that is told what to do by lines of JSON."""

import math
import time
from collections import deque

import actionlib
import rospy
from actionlib.msg import TestAction, TestGoal
from actionlib_msgs.msg import GoalStatusArray
from controller_manager_msgs.srv import SwitchController, SwitchControllerResponse
from diagnostic_msgs.msg import DiagnosticArray
from dynamic_reconfigure.cfg import TestConfig
from dynamic_reconfigure.server import Server
from geometry_msgs.msg import Twist, TwistStamped
from ros1_ears import Ears, plain, run
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu, LaserScan
from std_msgs.msg import Bool, String
from std_srvs.srv import SetBool, SetBoolResponse
from vehicle_safety.msg import State, Verdict
from vehicle_safety.srv import Exempt, Reset, Why

NODE = "/vehicle_safety"
RECOVERY = 99  # the goal of the rules


class Robot(Ears):
    """Publishes what it is told, and remembers what it hears."""

    def __init__(self):
        super().__init__()
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
        self._offered = []  # what holds the services
        self._stamp = rospy.Time(1)
        self._imu = rospy.Publisher("/imu/data", Imu, queue_size=1)
        self._planner = rospy.Publisher("/unfil_cmd_vel", Twist, queue_size=1)
        self._arm_planner = rospy.Publisher("/unfil_arm_vel", TwistStamped, queue_size=1)
        self._scan = None  # nobody publishes it before something is to be near or not
        self._clock = rospy.Publisher("/clock", Clock, queue_size=1)
        self._mode = rospy.Publisher("/mode", String, queue_size=1)
        self._arm_moving = rospy.Publisher("/arm/moving", Bool, queue_size=1)
        self._arm = actionlib.SimpleActionServer("/arm", TestAction, self._move_arm, False)
        self._arm.start()
        self._arm_status = rospy.Publisher("/arm/status", GoalStatusArray, queue_size=1)
        self._client = actionlib.SimpleActionClient("/arm", TestAction)
        self.hear("/cmd_vel", Twist, lambda m: m.linear.x)
        self.hear("/arm_vel", TwistStamped, lambda m: [m.header.frame_id, m.twist.linear.x])
        self.hear("/horn", Bool, lambda m: m.data)
        self.hear(NODE + "/state", State)
        self.hear(NODE + "/verdicts", Verdict)
        self.hear("/diagnostics", DiagnosticArray)
        rospy.Service("/lamp", SetBool, self._switch_lamp)
        rospy.Timer(rospy.Duration(0.01), self._publish_sensors)
        rospy.Timer(rospy.Duration(0.02), self._publish_command)

    def _publish_sensors(self, _):
        if not self.frozen:
            self._stamp = rospy.Time.now()
        self._publish_pitch(self.pitch, self._stamp)
        self._publish_pitch(self.belated, self._stamp - rospy.Duration(0.05))
        if self.near is not None:
            self._scan = self._scan or rospy.Publisher("/scan", LaserScan, queue_size=1)
            self._scan.publish(LaserScan(ranges=[2.0, 0.1 if self.near else 1.0]))
        if self.clock is not None:
            self.clock += 0.01
            self._clock.publish(rospy.Time.from_sec(self.clock))
        self._mode.publish(self.mode)
        self._arm_moving.publish(self.moving)

    def _publish_pitch(self, degrees, stamp):
        if degrees is None:
            return
        message = Imu()
        message.header.stamp = stamp
        message.orientation.y = math.sin(math.radians(float(degrees)) / 2)
        message.orientation.w = math.cos(math.radians(float(degrees)) / 2)
        self._imu.publish(message)

    def _publish_command(self, _):
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
        self._note("/arm", ["begins", goal.goal])
        end = {"succeeds": self._arm.set_succeeded, "aborts": self._arm.set_aborted}
        while not self._arm.is_preempt_requested() and not rospy.is_shutdown():
            rospy.sleep(0.01)
            if goal.goal == RECOVERY and self.recovery in end:
                self._note("/arm", [self.recovery, goal.goal])
                end[self.recovery]()
                return
        self._note("/arm", ["is cancelled", goal.goal])
        self._arm.set_preempted()

    def _offer_planner(self):
        """A node whose `double_` is 3."""
        rospy.set_param("/planner/double_", 3.0)
        self._offered.append(Server(TestConfig, self._reconfigure, namespace="/planner"))

    def _reconfigure(self, config, _level):
        rospy.sleep(self.delay)
        for name in ("double_", "int_"):
            self._note("/planner/" + name, config[name])
        return config

    def _offer_controllers(self):
        name = "/controller_manager/switch_controller"
        self._offered.append(rospy.Service(name, SwitchController, self._switch_controllers))

    def _switch_controllers(self, request):
        asked = [request.start_controllers, request.stop_controllers]
        self._note("/controllers", asked if request.strictness == request.STRICT else "not strict")
        return SwitchControllerResponse(self.switches)

    def _note(self, name, what):
        self.heard.setdefault(name, deque()).append([rospy.get_time(), what])

    def _switch_lamp(self, request):
        self._note("/lamp", request.data)
        return SetBoolResponse(self.lamp, "")

    def answer(self, request):
        """What a request asks for."""
        if "goal" in request:
            self._send_goal(request["goal"])
        if "lose_goals" in request:
            self._arm_status.publish(GoalStatusArray())
        if "offer" in request:
            getattr(self, "_offer_" + request["offer"])()
        if "call" in request:
            return self._call(request["call"], request["with"])
        return super().answer(request)

    def _send_goal(self, goal):
        """Waits for the server and for the node: it cannot send again what it has not heard."""
        self._client.wait_for_server()
        end = time.monotonic() + 5.0
        while self._client.action_client.pub_goal.get_num_connections() < 2:
            if time.monotonic() > end:
                break
            time.sleep(0.02)
        self._client.send_goal(TestGoal(goal), lambda *_: self._note("/goals", ["ends", goal]))

    def _call(self, name, arguments):
        kind = {"reset": Reset, "why": Why, "exempt": Exempt}[name]
        service = NODE + "/" + name
        rospy.wait_for_service(service, timeout=5.0)
        if "time" in arguments:
            arguments["time"] = rospy.Duration(arguments["time"])
        return plain(rospy.ServiceProxy(service, kind)(**arguments))


if __name__ == "__main__":
    run(Robot)
