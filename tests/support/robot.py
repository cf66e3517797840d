# mypy: ignore-errors
"""A robot and its planner for live tests: a ROS node that takes commands as lines of
JSON.

What differs between the generations of ROS stands in `ros1_robot.py` and `ros2_robot.py`.
"""

import math
import time

from controller_manager_msgs.msg import ControllerState
from controller_manager_msgs.srv import ListControllers, SwitchController
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from ears import Client, Ears, Server
from geometry_msgs.msg import PoseStamped, Twist, TwistStamped
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu, JointState, LaserScan, PointCloud2, PointField
from std_msgs.msg import Bool, Float64MultiArray, String
from std_srvs.srv import SetBool
from vehicle_safety.msg import State, Verdict
from vehicle_safety.srv import Exempt, Reset, Why

NODE = "/vehicle_safety"
RECOVERY = 99  # the goal of the rules


class Robot(Ears):
    """Publishes the values that it is given, and remembers the messages that it hears.

    `ACTION` is the type of its goals; `SWITCHED` are the fields in which a controller manager
    names the controllers to start and to stop.
    """

    def __init__(self, *arguments):
        super().__init__(*arguments)
        self.pitch = None  # degrees, or "nan"; None: the IMU is silent
        self.belated = None  # degrees; what the IMU says again and again with an older stamp
        self.speed = None  # m/s, or "nan"; None: the planner is silent
        self.arm_speed = None  # m/s; None: nobody commands the arm
        self.near = None  # whether something is near; None: the scanner is silent
        self.torques = None  # of all joints, without their names
        self.efforts = None  # pairs of a joint and its torque in Nm, or None; None: all are silent
        self.parts = None  # pairs of a part and its level, "OK" or "ERROR"; None: all are silent
        self.place = [27.0, 1.0, "map"]  # x and y in m, outside of all places, and a frame
        self.cloud = None  # the fields of a cloud, its data in hexadecimals; None: it is silent
        self.laser = None  # the fields of a scan; None: that scanner is silent
        self.mode = "driving"
        self.clock = None  # simulated time in s; None: there is none
        self.moving = False  # whether the arm moves, goal or not
        self.frozen = False  # the stamps of the IMU stand still
        self.lamp = True  # whether the lamp answers with success
        self.recovery = "goes on"  # what comes of the goal of the rules, or "succeeds", "aborts"
        self.delay = 0.0  # s, after which the planner answers
        self.controllers = ["effort", "gravity", "position"]  # that the controller manager has
        self.switches = True  # whether the controller manager does what it is asked for
        self._stamp_s = 1.0
        self._imu = self.sensor("/imu/data", Imu)
        self._planner = self.publisher("/unfil_cmd_vel", Twist)
        self._arm_planner = self.publisher("/unfil_arm_vel", TwistStamped)
        self._scan = None  # nobody publishes it before something is to be near or not
        self._joints = None
        self._torques = None
        self._parts = None
        self._cloud = None
        self._laser = None
        self._place = self.sensor("/place", PoseStamped)
        self._clock = None
        self._mode = self.publisher("/mode", String)
        self._arm_moving = self.publisher("/arm/moving", Bool)
        self._arm = Server(self, "/arm", self.ACTION, "goal", self._end_of)
        servers = ("/arm", "/hand")  # of the hand: see `hand.py`
        self._clients = {name: Client(self, name, self.ACTION, "goal") for name in servers}
        self.hear("/cmd_vel", Twist, lambda m: m.linear.x)
        self.hear("/arm_vel", TwistStamped, lambda m: [m.header.frame_id, m.twist.linear.x])
        self.hear("/horn", Bool, lambda m: m.data)
        self.hear("/siren", Bool, lambda m: m.data)
        self.hear_latched(NODE + "/state", State)
        self.hear(NODE + "/verdicts", Verdict)
        self.hear("/diagnostics", DiagnosticArray)
        self.offer("/lamp", SetBool, self._switch_lamp)
        self.every(0.01, self._publish_sensors)
        self.every(0.02, self._publish_command)

    def _publish_sensors(self):
        if self.clock is not None:
            self._clock = self._clock or self.publisher("/clock", Clock)
            self.clock += 0.01
            self._clock.publish(Clock(clock=self.time_of(self.clock)))
        if not self.frozen:
            self._stamp_s = time.time() if self.clock is None else self.clock
        self._publish_pitch(self.pitch, self._stamp_s)
        # Much older, as the one before may be stale on a busy machine.
        self._publish_pitch(self.belated, self._stamp_s - 1.0)
        if self.near is not None:
            self._scan = self._scan or self.sensor("/scan", LaserScan)
            self._scan.publish(LaserScan(ranges=[2.0, 0.1 if self.near else 1.0]))
        if self.efforts is not None:
            self._joints = self._joints or self.sensor("/joint_states", JointState)
            names = [name for name, _ in self.efforts]
            torques = [float(torque) for _, torque in self.efforts if torque is not None]
            self._joints.publish(JointState(name=names, effort=torques))
        if self.torques is not None:
            self._torques = self._torques or self.sensor("/effort_states", Float64MultiArray)
            self._torques.publish(Float64MultiArray(data=list(map(float, self.torques))))
        if self.parts is not None:
            self._parts = self._parts or self.sensor("/parts", DiagnosticArray)
            levels = [(name, getattr(DiagnosticStatus, level)) for name, level in self.parts]
            statuses = [DiagnosticStatus(name=name, level=level) for name, level in levels]
            self._parts.publish(DiagnosticArray(status=statuses))
        if self.cloud is not None:
            self._cloud = self._cloud or self.sensor("/cloud", PointCloud2)
            fields = [PointField(**each) for each in self.cloud["fields"]]
            data = bytes.fromhex(self.cloud["data"])
            self._cloud.publish(PointCloud2(**{**self.cloud, "fields": fields, "data": data}))
        if self.laser is not None:
            self._laser = self._laser or self.sensor("/laser", LaserScan)
            self._laser.publish(LaserScan(**self.laser))
        place = PoseStamped()
        place.pose.position.x, place.pose.position.y, place.header.frame_id = self.place
        self._place.publish(place)
        self._arm_moving.publish(Bool(data=self.moving))
        self._mode.publish(String(data=self.mode))

    def _publish_pitch(self, degrees, stamp_s):
        if degrees is None:
            return
        message = Imu()
        message.header.stamp = self.time_of(stamp_s)
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

    def _end_of(self, goal):
        """Goals of the planner are pursued until they are cancelled."""
        return self.recovery if goal == RECOVERY else None

    def _offer_controllers(self):
        manager = "/controller_manager"
        self.offer(manager + "/list_controllers", ListControllers, self._list_controllers)
        self.offer(manager + "/switch_controller", SwitchController, self._switch_controllers)

    def _list_controllers(self, _request):
        return {"controller": [ControllerState(name=name) for name in self.controllers]}

    def _switch_controllers(self, request):
        asked = [list(getattr(request, field)) for field in self.SWITCHED]
        self.note("/controllers", asked if request.strictness == request.STRICT else "not strict")
        has_all = set().union(*asked) <= set(self.controllers)
        return {"ok": self.switches and has_all}

    def _switch_lamp(self, request):
        self.note("/lamp", request.data)
        return {"success": self.lamp}

    def answer(self, request):
        """Answer a request."""
        if "goal" in request:
            self._clients[request.get("of", "/arm")].send(request["goal"])
        if "offer" in request:
            getattr(self, "_offer_" + request["offer"])()
        if "deafen" in request:
            self.deafen(request["deafen"])
        if "call" in request:
            return self._call(request["call"], request["with"])
        return super().answer(request)

    def _call(self, name, arguments):
        kind = {"reset": Reset, "why": Why, "exempt": Exempt}[name]
        if "time" in arguments:
            arguments["time"] = self.duration_of(arguments["time"])
        return self.call(NODE + "/" + name, kind, arguments)
