"""ROS 1 as Debian packages it, for live tests: a master, catkin, the generated node, a robot."""

from __future__ import annotations

import json
import os
import shutil
import signal
import socket
import subprocess
import time
import xmlrpc.client
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

PYTHON = Path("/usr/bin/python3")
TOOLS = ("rosmaster", "catkin_make", "cmake", "g++")
_ROBOT = Path(__file__).with_name("ros1_robot.py")


def missing() -> str | None:
    """What is not installed of ROS 1, None if all is."""
    lacking = [tool for tool in TOOLS if shutil.which(tool, path="/usr/bin") is None]
    if lacking:
        return f"ROS 1 is not installed: no {', '.join(lacking)} (tools/setup_ros1.sh installs it)"
    done = subprocess.run([PYTHON, "-c", "import rospy"], capture_output=True)
    return "ROS 1 is not installed: no rospy" if done.returncode else None


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


def until(is_so: Callable[[], bool], what: str, seconds: float = 10.0) -> None:
    """Wait for something; fail if it does not come."""
    end = time.monotonic() + seconds
    while not is_so():
        assert time.monotonic() < end, f"not within {seconds} s: {what}"
        time.sleep(0.02)


class Process:
    """A program in a group of its own, so that nothing of it survives."""

    def __init__(self, command: list[str], variables: Mapping[str, str], log: Path) -> None:
        log.parent.mkdir(parents=True, exist_ok=True)
        self._log = log.open("ab")
        self.running = subprocess.Popen(
            command,
            env=variables,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._log,
            start_new_session=True,
            text=True,
        )

    def end(self, how: int = signal.SIGKILL) -> None:
        """End it, and wait until it is gone."""
        if self.running.poll() is None:
            os.killpg(self.running.pid, how)
        self.running.communicate(timeout=10)
        self._log.close()

    def end_gently(self) -> None:
        """Interrupt it, so that it ends what it has started; end it if it does not."""
        self.running.send_signal(signal.SIGINT)
        try:
            self.running.wait(20)
        finally:
            self.end()


class Robot(Process):
    """`ros1_robot.py`, and questions to it."""

    def __init__(self, variables: Mapping[str, str], log: Path) -> None:
        super().__init__([str(PYTHON), str(_ROBOT)], variables, log)

    def ask(self, **request: object) -> Any:
        assert self.running.stdin is not None
        assert self.running.stdout is not None
        self.running.stdin.write(json.dumps(request) + "\n")
        self.running.stdin.flush()
        return json.loads(self.running.stdout.readline())

    def set(self, **values: object) -> None:
        self.ask(set=values)

    def heard(self, topic: str) -> list[Any]:
        """What came on a topic since the last `forget`, without the times."""
        return [message for _, message in self.ask(heard=topic)]

    def commands(self, seconds: float) -> list[float]:
        """The speeds on /cmd_vel during the next seconds."""
        self.ask(forget="/cmd_vel")
        time.sleep(seconds)
        return [float(speed) for speed in self.heard("/cmd_vel")]

    def call(self, service: str, **arguments: object) -> Any:
        return self.ask(call=service, **{"with": arguments})

    def state(self) -> Any:
        """The last state that was told; None before the first."""
        return next(reversed(self.heard("/vehicle_safety/state")), None)


def set_parameters(
    variables: Mapping[str, str], values: Mapping[str, object], *, use_sim_time: bool
) -> None:
    """Give the node these parameters and no others."""
    with xmlrpc.client.ServerProxy(variables["ROS_MASTER_URI"]) as master:
        master.setParam("/test", "/vehicle_safety", dict(values))
        master.setParam("/test", "/use_sim_time", use_sim_time)


def is_up(port: int) -> bool:
    """Whether a master answers."""
    with socket.socket() as asked:
        return asked.connect_ex(("127.0.0.1", port)) == 0
