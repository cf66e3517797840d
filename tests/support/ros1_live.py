"""ROS 1 as Debian packages it, for live tests: a master, catkin, generated nodes, a robot."""

from __future__ import annotations

import shutil
import socket
import subprocess
import xmlrpc.client
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path
from typing import Any, cast

from rossmarie import ir
from rossmarie.driver.build import generate
from support.c_compiler import write
from support.live import Ears, Process, Robot, until
from support.live_cases import PACKAGES, vehicle

PYTHON = Path("/usr/bin/python3")
TOOLS = ("rosmaster", "catkin_make", "cmake", "g++")
_HERE = Path(__file__).parent


def missing() -> str | None:
    """What is not installed of ROS 1, None if all is."""
    lacking = [tool for tool in TOOLS if shutil.which(tool, path="/usr/bin") is None]
    if lacking:
        return f"not installed: {', '.join(lacking)}"
    done = subprocess.run([PYTHON, "-c", "import rospy"], capture_output=True)
    return "not installed: rospy" if done.returncode else None


def free_port() -> int:
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return int(found.getsockname()[1])


def environment(folder: Path, port: int) -> dict[str, str]:
    """The variables of ROS; Debian has no file that sets them."""
    return {
        "HOME": str(folder),
        "PATH": "/usr/bin:/bin:/usr/sbin:/sbin",
        "ROS_MASTER_URI": f"http://127.0.0.1:{port}",
        "ROS_IP": "127.0.0.1",
        "ROS_ETC_DIR": "/etc/ros",
        "ROS_ROOT": "/usr/share/ros",
        "ROS_DISTRO": "Debian",
        "ROS_VERSION": "1",
        "ROS_PYTHON_VERSION": "3",
        "ROS_LOG_DIR": str(folder / "log"),
        "ROS_PACKAGE_PATH": f"{folder / 'workspace' / 'src'}:/usr/share",
        "PYTHONPATH": str(folder / "workspace/devel/lib/python3/dist-packages"),
        "CMAKE_PREFIX_PATH": f"{folder / 'workspace/devel'}:/usr",
    }


class Master(Process):
    """The one of the variables."""

    def __init__(self, variables: Mapping[str, str], log: Path) -> None:
        port = variables["ROS_MASTER_URI"].rpartition(":")[2]
        super().__init__(["/usr/bin/rosmaster", "--core", "-p", port], variables, log)
        until(lambda: _is_up(int(port)), "the master is up", 30)


def _is_up(port: int) -> bool:
    """Whether a master answers."""
    with socket.socket() as asked:
        return asked.connect_ex(("127.0.0.1", port)) == 0


def master_of(variables: Mapping[str, str]) -> Any:
    """The master, to be asked by XML-RPC."""
    return xmlrpc.client.ServerProxy(variables["ROS_MASTER_URI"])


def process_of(variables: Mapping[str, str], node: str) -> int | None:
    """The process of a node that the master knows, None if there is none."""
    try:
        with master_of(variables) as master:
            found, _, address = master.lookupNode("/test", node)
        if found != 1:
            return None
        with xmlrpc.client.ServerProxy(address) as asked:
            _, _, process = cast("list[Any]", asked.getPid("/test"))
            return int(process)
    except OSError:
        return None


class Ros1:
    """A master, and a workspace with the node of the vehicle."""

    name = "ros1"

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._workspace = folder / "workspace"
        self.variables = environment(folder, free_port())
        self._master = self._new_master()
        for package in PACKAGES["ros1"].iterdir():
            shutil.copytree(package, self._workspace / "src" / package.name)

    @cached_property
    def vehicle(self) -> Path:
        """The program of the node of the vehicle."""
        return self.build(vehicle())

    @contextmanager
    def without_master(self) -> Iterator[None]:
        """The master ends; after that there is a new one, at the same place."""
        self._master.end()
        try:
            yield
        finally:
            self._master = self._new_master()

    def forget_all(self) -> None:
        """A new master, which knows nobody who was killed.

        It would go on asking the ports of the dead. Whoever listens there next may wait for the
        rest of a question that it does not understand, and meanwhile accept nobody else: so does
        a node of rospy.
        """
        with self.without_master():
            pass

    def _new_master(self) -> Master:
        return Master(self.variables, self._folder / "master.log")

    def robot(self) -> Robot:
        """A new robot. It lives in real time, the node need not."""
        set_parameters(self.variables, self.vehicle.name, {}, use_sim_time=False)
        command = [str(PYTHON), str(_HERE / "ros1_robot.py")]
        return Robot(command, self.variables, self._folder / "robot.log")

    def ears(self, *arguments: str, script: str = "ears.py") -> Ears:
        """What hears the topics of the arguments, `TOPIC TYPE ...`; or another script."""
        command = [str(PYTHON), str(_HERE / script), *arguments]
        return Ears(command, self.variables, self._folder / "ears.log")

    def start(self, parameters: Mapping[str, object], *, use_sim_time: bool = False) -> Process:
        """Start the node of the vehicle with these parameters and no others."""
        return self.begin(self.vehicle, parameters, use_sim_time=use_sim_time)

    def begin(
        self, program: Path, parameters: Mapping[str, object], *, use_sim_time: bool = False
    ) -> Process:
        """Start a node with these parameters and no others."""
        set_parameters(self.variables, program.name, parameters, use_sim_time=use_sim_time)
        return Process([str(program)], self.variables, self._folder / f"{program.name}.log")

    def launch(self, folder: Path, parameters: Mapping[str, object]) -> Process:
        """Launch the node with a planner that wants 0.7 m/s; `folder` is for files of the test."""
        planner = folder / "planner.launch"
        planner.write_text(_PLANNER, encoding="utf-8")
        set_parameters(self.variables, self.vehicle.name, parameters, use_sim_time=False)
        command = ["/usr/bin/roslaunch", "vehicle_safety", "vehicle_safety.launch"]
        log = self._folder / "launch.log"
        return Process([*command, f"commands:={planner}"], self.variables, log)

    def node_process(self) -> int | None:
        """The process of the node of the vehicle, None if there is none."""
        return process_of(self.variables, "/vehicle_safety")

    def play(self, recording: Path, *options: str) -> Process:
        """Play a recording with simulated time; the options are those of rosbag."""
        command = ["/usr/bin/rosbag", "play", "--quiet", "--clock", "--hz=500"]
        arguments = ["--wait-for-subscribers", *options, str(recording)]
        return Process([*command, *arguments], self.variables, self._folder / "play.log")

    def publish(self, rate: int, topic: str, ros_type: str, message: str) -> Process:
        """Publish a message at a rate, in a process of its own."""
        command = ["/usr/bin/rostopic", "pub", "-r", str(rate), topic, ros_type, message]
        return Process(command, self.variables, self._folder / "publish.log")

    def ros_type(self, name: str) -> str:
        """How `sensor_msgs/Imu` is called."""
        return name

    def end(self) -> None:
        """End the master."""
        self._master.end()

    def build(self, machine: ir.Machine) -> Path:
        """Build the node of a machine; its program."""
        name = f"{machine.name}_safety"
        write(generate(machine, "ros1"), self._workspace / "src" / name)
        return self._make(name) / name

    def build_package(self, source: Path) -> Path:
        """Build a package of this repository, called like its folder; where its programs are."""
        shutil.copytree(source, self._workspace / "src" / source.name, dirs_exist_ok=True)
        return self._make(source.name)

    def _make(self, package: str) -> Path:
        """Build all packages of the workspace, without a warning; where the programs of one are."""
        command = ["catkin_make", "-j2", f"-DPYTHON_EXECUTABLE={PYTHON}"]
        done = subprocess.run(
            command, cwd=self._workspace, env=self.variables, capture_output=True, text=True
        )
        assert done.returncode == 0, done.stdout + done.stderr
        assert "warning:" not in done.stderr, done.stderr
        return self._workspace / "devel" / "lib" / package


def set_parameters(
    variables: Mapping[str, str], node: str, values: Mapping[str, object], *, use_sim_time: bool
) -> None:
    """Give a node these parameters and no others."""
    with master_of(variables) as master:
        master.setParam("/test", f"/{node}", dict(values))
        master.setParam("/test", "/use_sim_time", use_sim_time)


_PLANNER = """\
<launch>
  <node pkg="rostopic" type="rostopic" name="planner"
        args="pub -r 20 /cmd_vel geometry_msgs/Twist '{linear: {x: 0.7}}'"/>
</launch>
"""
