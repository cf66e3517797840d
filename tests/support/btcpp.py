"""BehaviorTree.CPP, where the C++ compiler finds it: a program that loads and ticks trees."""

from __future__ import annotations

import functools
import shutil
import subprocess
import tempfile
import xml.etree.ElementTree as ET
from pathlib import Path

SOURCE = Path(__file__).with_name("btcpp_player.cpp")
MISSING = "BehaviorTree.CPP 4 is not installed (ros-$ROS_DISTRO-behaviortree-cpp)"


@functools.lru_cache(maxsize=1)
def player() -> Path | None:
    """The program; None where there is no compiler, or it does not find BehaviorTree.CPP."""
    compiler = shutil.which("g++")
    if compiler is None:
        return None
    program = Path(tempfile.mkdtemp()) / "player"
    command = [compiler, "-std=c++17", str(SOURCE), "-lbehaviortree_cpp", "-o", str(program)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return program if done.returncode == 0 else None


def played(xml: str, folder: Path, scripts: dict[str, str], ticks: int = 8) -> list[str]:
    """What happens at each tick; other actions succeed at once."""
    path = folder / "tree.xml"
    path.write_text(xml, encoding="utf-8")
    arguments = []
    for action in ET.fromstring(xml).iterfind("TreeNodesModel/Action"):
        name = action.attrib["ID"]
        ports = [f"{p.attrib['name']}:{p.attrib['type']}" for p in action if "name" in p.attrib]
        arguments.append(",".join([f"{name}={scripts.get(name, 'S')}", *ports]))
    command = [str(player()), str(path), str(ticks), *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout.splitlines()
