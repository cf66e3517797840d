"""ROS 2 where it is sourced, for live tests: colcon, generated nodes, a robot."""

from __future__ import annotations

import fcntl
import json
import os
import random
import shutil
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from contextlib import suppress
from functools import cached_property
from pathlib import Path

from rosbags.highlevel import AnyReader

from rossmarie.driver.build import generate
from support.live import LIMIT, Ears, Faults, Process, Robot, Wanted, talking
from support.live_cases import PACKAGES, vehicle
from support.ros2_build import Workspace, is_installed
from support.workspace import files_of

_HERE = Path(__file__).parent
_NEEDED = ("rclcpp_lifecycle", "rclcpp_components", "rclcpp_action", "rclpy", "launch_ros")


def missing() -> str | None:
    """What is not there of ROS 2, None if all is."""
    if os.environ.get("ROS_VERSION") != "2" or not os.environ.get("AMENT_PREFIX_PATH"):
        return "not sourced"
    lacking = [tool for tool in ("colcon", "ros2", "python3") if shutil.which(tool) is None]
    lacking += [package for package in _NEEDED if not is_installed(package)]
    return f"sourced, but lacks {', '.join(lacking)}" if lacking else None


class Domain:
    """A domain that no other run of tests on this machine uses meanwhile."""

    def __init__(self) -> None:
        for number in random.sample(range(1, 101), 100):
            lock = (Path(tempfile.gettempdir()) / f"rossmarie_domain_{number}.lock").open("a")
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                lock.close()
                continue
            self.number = number
            self._lock = lock
            return
        raise AssertionError("no domain is free")

    def leave(self) -> None:
        """Others may use it."""
        self._lock.close()


class Ros2:
    """A workspace with the node of the vehicle, and the environment to run it in."""

    name = "ros2"

    def __init__(self, folder: Path, workspace: Workspace) -> None:
        """The workspace may be one that others share."""
        self._folder = folder
        self.faults = Faults(folder)
        self._workspace = workspace
        self.prepare([])
        self.variables = self._sourced()
        self._has_daemon = False
        self._domain = Domain()
        self.variables["ROS_DOMAIN_ID"] = str(self._domain.number)

    @cached_property
    def vehicle(self) -> Path:
        """The program of the node of the vehicle."""
        return self.prepare([vehicle("ros2")])[0]

    def robot(self, namespace: str = "") -> Robot:
        """A new robot; it needs the messages of the node of the vehicle."""
        command = [str(shutil.which("python3")), str(_HERE / "ros2_robot.py")]
        variables = {**self.variables, "ROBOT_NAMESPACE": namespace}
        return Robot(command, variables, self._folder / "robot.log")

    def ears(self, *arguments: str, script: str = "ears.py") -> Ears:
        """What hears the topics of the arguments, `TOPIC TYPE ...`; or another script."""
        command = [str(shutil.which("python3")), str(_HERE / script), *arguments]
        return Ears(command, self.variables, self._folder / "ears.log")

    def start(
        self, parameters: Mapping[str, object], *, use_sim_time: bool = False, namespace: str = ""
    ) -> Process:
        """Start the node of the vehicle with these parameters and no others."""
        return self.begin(self.vehicle, parameters, use_sim_time=use_sim_time, namespace=namespace)

    def begin(
        self,
        program: Path,
        parameters: Mapping[str, object],
        *,
        use_sim_time: bool = False,
        namespace: str = "",
        remapped: Sequence[str] = (),
    ) -> Process:
        """Start a node with these parameters and no others, and with names remapped."""
        given = {**parameters, "use_sim_time": use_sim_time}
        rules = [text for item in given.items() for text in ("-p", _rule(*item))]
        names = [*([f"__ns:={namespace}"] if namespace else []), *remapped]
        renamed = [text for name in names for text in ("-r", name)]
        command = [str(program), "--ros-args", *rules, *renamed]
        log = self._folder / f"{program.parent.name}.log"
        return Process(command, self.variables, log, talking)

    def launch(
        self, folder: Path, parameters: Mapping[str, object], namespace: str = ""
    ) -> Process:
        """Launch the node with a planner that wants 0.7 m/s; `folder` is for files of the test."""
        arguments = {"namespace": namespace} if namespace else {}
        return self.launch_behind(_PLANNER, folder, parameters, **arguments)

    def launch_behind(
        self, planner: str, folder: Path, parameters: Mapping[str, object], **arguments: str
    ) -> Process:
        """Launch the node with this launch file of a planner, and further arguments."""
        behind, settings = folder / "planner.launch.py", folder / "parameters.yaml"
        behind.write_text(planner, encoding="utf-8")
        given = {"/**": {"ros__parameters": dict(parameters)}}
        settings.write_text(json.dumps(given), encoding="utf-8")
        command = ["ros2", "launch", "vehicle_safety", "vehicle_safety.launch.py"]
        all_arguments = {"commands": str(behind), "parameters": str(settings), **arguments}
        pairs = [f"{name}:={value}" for name, value in all_arguments.items()]
        return Process([*command, *pairs], self.variables, self._folder / "launch.log")

    def node_process(self) -> int | None:
        """The process of the node of the vehicle, None if there is none."""
        own = f"ROS_DOMAIN_ID={self.variables['ROS_DOMAIN_ID']}".encode()
        for process in Path("/proc").glob("[0-9]*"):
            with suppress(OSError):
                # Robots of other domains run the same program.
                is_node = (process / "exe").resolve() == self.vehicle.resolve()
                if is_node and own in (process / "environ").read_bytes().split(b"\0"):
                    return int(process.name)
        return None

    def command(self, *arguments: str) -> str:
        """What a command of ROS 2 says."""
        self._has_daemon = True
        done = subprocess.run(
            ["ros2", *arguments], env=self.variables, capture_output=True, text=True, timeout=LIMIT
        )
        return done.stdout + done.stderr

    def play(self, recording: Path) -> Process:
        """Play a recording with simulated time."""
        messages = self._folder / "messages.jsonl"
        with messages.open("w", encoding="ascii") as out, AnyReader([recording]) as read:
            for connection, at_ns, content in read.messages():
                line = (connection.topic, connection.msgtype, at_ns, bytes(content).hex())
                out.write(json.dumps(line) + "\n")
        command = [str(shutil.which("python3")), str(_HERE / "ros2_play.py"), str(messages)]
        return Process(command, self.variables, self._folder / "play.log")

    def publish(
        self, rate: int, topic: str, ros_type: str, message: str, *, is_kept: bool = False
    ) -> Process:
        """Publish a message at a rate, in a process of its own. A kept one comes late, too."""
        kept = ["--qos-durability", "transient_local"] if is_kept else []
        command = ["ros2", "topic", "pub", "--print", "0", *kept, "--rate", str(rate), topic]
        return Process(
            [*command, self.ros_type(ros_type), message],
            self.variables,
            self._folder / "publish.log",
        )

    def ros_type(self, name: str) -> str:
        """How `sensor_msgs/Imu` is called."""
        package, _, bare = name.partition("/")
        return f"{package}/msg/{bare}"

    def forget_all(self) -> None:
        """Another domain: in this one, who was killed counts as alive until its lease is over."""
        self.end()
        self._domain = Domain()
        self.variables["ROS_DOMAIN_ID"] = str(self._domain.number)

    def end(self) -> None:
        """Commands of ROS 2 leave a daemon behind."""
        if self._has_daemon:
            subprocess.run(["ros2", "daemon", "stop"], env=self.variables, capture_output=True)
        self._has_daemon = False
        self._domain.leave()

    def prepare(self, wanted: Sequence[Wanted]) -> list[Path]:
        """Build all of these at once: the programs of nodes, and where those of packages are."""
        own = (each for each in PACKAGES["ros2"].iterdir() if not is_installed(each.name))
        packages = {each.name: files_of(each) for each in own}
        found = []
        for each in wanted:
            if isinstance(each, Path):
                packages[each.name] = files_of(each)
                found.append(self._workspace.programs(each.name))
            else:
                name = f"{each.name}_safety"
                packages[name] = dict(generate(each, "ros2"))
                found.append(self._workspace.programs(name) / "safety_node")
        self._workspace.build(packages)
        return found

    def _sourced(self) -> dict[str, str]:
        """The environment with the workspace, on this machine only."""
        found = self._workspace.variables()
        found["ROS_LOG_DIR"] = str(self._folder / "log")
        found["ROS_HOME"] = str(self._folder / "home")
        found.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        return found


def _rule(name: str, value: object) -> str:
    """An argument that sets a parameter; YAML has its own word for NaN."""
    return f"{name}:={json.dumps(value)}".replace("NaN", ".nan")


_PLANNER = """\
from launch import LaunchDescription
from launch_ros.actions import Node

SCRIPT = '''
import rclpy
from geometry_msgs.msg import Twist

rclpy.init()
node = rclpy.create_node("planner")
publisher = node.create_publisher(Twist, "cmd_vel", 1)
message = Twist()
message.linear.x = 0.7
node.create_timer(0.05, lambda: publisher.publish(message))
rclpy.spin(node)
'''


def generate_launch_description():
    return LaunchDescription([Node(executable="python3", arguments=["-c", SCRIPT])])
"""
