"""ROS 1 as Debian packages it, for live tests: a master, catkin, generated nodes, a robot."""

from __future__ import annotations

import random
import shutil
import socket
import subprocess
import xmlrpc.client
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path
from typing import Any, cast

from rossmarie.driver.build import generate
from support.live import Ears, Faults, Process, Robot, Start, Wanted, talking, until
from support.live_cases import PACKAGES, vehicle
from support.ros1_build import VARIABLES, Workspace
from support.ros1_python import PYTHON, Python
from support.workspace import files_of

TOOLS = ("rosmaster", "catkin_make", "cmake", "g++")
_HERE = Path(__file__).parent


def missing() -> str | None:
    """What is not installed of ROS 1, None if all is."""
    lacking = [tool for tool in TOOLS if shutil.which(tool, path="/usr/bin") is None]
    if lacking:
        return f"not installed: {', '.join(lacking)}"
    # Not as the variables of a generation of ROS that is sourced say.
    done = subprocess.run([PYTHON, "-I", "-c", "import rospy"], capture_output=True)
    return "not installed: rospy" if done.returncode else None


def free_port() -> int:
    """One that nobody uses, and that the system gives to nobody who asks for any."""
    while True:
        port = random.randint(15000, 30000)
        with socket.socket() as found:
            if found.connect_ex(("127.0.0.1", port)) != 0:
                return port


def environment(folder: Path, port: int, workspace: Workspace) -> dict[str, str]:
    """The variables of ROS."""
    return {
        **VARIABLES,
        "HOME": str(folder),
        "ROS_MASTER_URI": f"http://127.0.0.1:{port}",
        "ROS_IP": "127.0.0.1",
        "ROS_LOG_DIR": str(folder / "log"),
        "ROS_PACKAGE_PATH": f"{workspace.sources}:/usr/share",
        "PYTHONPATH": str(workspace.devel / "lib/python3/dist-packages"),
        "CMAKE_PREFIX_PATH": f"{workspace.devel}:/usr",
    }


class Master(Process):
    """A new one. It is up after `wait`."""

    def __init__(self, variables: dict[str, str], python: Python) -> None:
        self.variables = variables
        port = variables["ROS_MASTER_URI"].rpartition(":")[2]
        command = ["/usr/bin/rosmaster", "--core", "-p", port]
        super().__init__(command, variables, Path(variables["HOME"]) / "master.log", python.start)

    def wait(self) -> None:
        """Wait until it is up."""
        until(self._answers, "the master is up")

    def _answers(self) -> bool:
        """Whether somebody answers at its port, and it is this one."""
        assert self.running.poll() is None, self.said()
        try:
            with master_of(self.variables) as master:
                return bool(master.getPid("/test")[2] == self.running.pid)
        except OSError:
            return False


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

    def __init__(self, folder: Path, workspace: Workspace | None = None) -> None:
        """The workspace may be one that others share."""
        self._folder = folder
        self.faults = Faults(folder)
        self._workspace = workspace or Workspace(folder / "workspace")
        self._python = Python(environment(folder, 0, self._workspace))
        self._master, self._next_master = self._new_master(), self._new_master()
        self._master.wait()

    @property
    def variables(self) -> dict[str, str]:
        """The environment of nodes."""
        return self._master.variables

    @cached_property
    def vehicle(self) -> Path:
        """The program of the node of the vehicle."""
        return self.prepare([vehicle()])[0]

    @contextmanager
    def without_master(self) -> Iterator[None]:
        """The master ends; after that there is a new one, at the same place."""
        self._master.end()
        try:
            yield
        finally:
            self._master = Master(self.variables, self._python)
            self._master.wait()

    def forget_all(self) -> None:
        """The next master, which knows nobody who was killed; it has started meanwhile.

        The one before would go on asking the ports of the dead. Whoever listens there next may
        wait for the rest of a query that it does not understand, and meanwhile accept nobody
        else: so does a node of rospy.
        """
        self._master.end()
        self._master, self._next_master = self._next_master, self._new_master()
        self._master.wait()

    def _new_master(self) -> Master:
        variables = environment(self._folder, free_port(), self._workspace)
        return Master(variables, self._python)

    def _script(self, log: str, *command: str) -> tuple[Sequence[str], dict[str, str], Path, Start]:
        """What starts a script with rospy. It listens at an address of its own, where nobody asks
        who looks for the dead of another master.
        """
        port = int(self.variables["ROS_MASTER_URI"].rpartition(":")[2])
        variables = {**self.variables, "ROS_IP": "127.{}.{}.1".format(*divmod(port, 256))}
        return command, variables, self._folder / log, self._python.start

    def robot(self, namespace: str = "") -> Robot:
        """A new robot. It lives in real time, the node need not."""
        set_parameters(self.variables, self.vehicle.name, {}, use_sim_time=False)
        script = str(_HERE / "ros1_robot.py")
        command, variables, log, start = self._script("robot.log", script)
        return Robot(command, {**variables, "ROBOT_NAMESPACE": namespace}, log, start)

    def ears(self, *arguments: str, script: str = "ears.py") -> Ears:
        """What hears the topics of the arguments, `TOPIC TYPE ...`; or another script."""
        return Ears(*self._script("ears.log", str(_HERE / script), *arguments))

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
        node = f"{namespace[1:]}/{program.name}" if namespace else program.name
        set_parameters(self.variables, node, parameters, use_sim_time=use_sim_time)
        variables = {**self.variables, "ROS_NAMESPACE": namespace}
        return Process(
            [str(program), *remapped], variables, self._folder / f"{program.name}.log", talking
        )

    def launch(
        self, folder: Path, parameters: Mapping[str, object], namespace: str = ""
    ) -> Process:
        """Launch the node with a planner that wants 0.7 m/s; `folder` is for files of the test."""
        planner = folder / "planner.launch"
        planner.write_text(_PLANNER, encoding="utf-8")
        node = f"{namespace[1:]}/{self.vehicle.name}" if namespace else self.vehicle.name
        set_parameters(self.variables, node, parameters, use_sim_time=False)
        command = ["/usr/bin/roslaunch", "vehicle_safety", "vehicle_safety.launch"]
        log = self._folder / "launch.log"
        arguments = [f"commands:={planner}", *([f"namespace:={namespace}"] if namespace else [])]
        return Process([*command, *arguments], self.variables, log)

    def node_process(self) -> int | None:
        """The process of the node of the vehicle, None if there is none."""
        return process_of(self.variables, "/vehicle_safety")

    def play(self, recording: Path, *part: float) -> Process:
        """Play a recording, or the part that begins at a second and lasts some, with simulated time
        that waits for the node.
        """
        command = [str(PYTHON), str(_HERE / "ros1_play.py"), str(recording), *map(str, part)]
        return Process(command, self.variables, self._folder / "play.log")

    def publish(
        self, rate: int, topic: str, ros_type: str, message: str, *, is_kept: bool = False
    ) -> Process:
        """Publish a message at a rate, in a process of its own. A kept one comes late, too."""
        kept = ["-l"] if is_kept else ["-r", str(rate)]
        command = ["/usr/bin/rostopic", "pub", *kept, topic, ros_type, message]
        return Process(*self._script("publish.log", *command))

    def ros_type(self, name: str) -> str:
        """How `sensor_msgs/Imu` is called."""
        return name

    def end(self) -> None:
        """End what was started for it."""
        self._master.end()
        self._next_master.end()
        self._python.end()

    def prepare(self, wanted: Sequence[Wanted]) -> list[Path]:
        """Build all of these at once: the programs of nodes, and where those of packages are."""
        packages = {each.name: files_of(each) for each in PACKAGES["ros1"].iterdir()}
        found = []
        for each in wanted:
            if isinstance(each, Path):
                packages[each.name] = files_of(each)
                found.append(self._workspace.programs(each.name))
            else:
                name = f"{each.name}_safety"
                packages[name] = dict(generate(each, "ros1"))
                found.append(self._workspace.programs(name) / name)
        self._workspace.build(packages)
        return found


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
        args="pub -r 20 cmd_vel geometry_msgs/Twist '{linear: {x: 0.7}}'"/>
</launch>
"""
