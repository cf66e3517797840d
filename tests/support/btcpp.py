"""BehaviorTree.CPP, where the C++ compiler finds it: a program that loads and ticks trees."""

from __future__ import annotations

import functools
import shutil
import subprocess
import tempfile
import xml.etree.ElementTree as ET
from pathlib import Path

SOURCE = Path(__file__).with_name("btcpp_player.cpp")
_EMPTY = """\
#if !__has_include(<behaviortree_cpp/bt_factory.h>)
#error
#endif
int main() {}
"""


def missing() -> str | None:
    """The reason why the player cannot be compiled; None if it can."""
    if shutil.which("g++") is None:
        return "no g++"
    command = ["g++", "-x", "c++", "-", "-lbehaviortree_cpp", "-o", "/dev/null"]
    done = subprocess.run(command, input=_EMPTY, capture_output=True, text=True, check=False)
    return "g++ does not find it" if done.returncode else None


@functools.cache
def _player() -> Path:
    """The program, compiled."""
    program = Path(tempfile.mkdtemp()) / "player"
    command = ["g++", "-std=c++17", str(SOURCE), "-lbehaviortree_cpp", "-o", str(program)]
    subprocess.run(command, check=True)
    return program


def played(xml: str, folder: Path, scripts: dict[str, str], ticks: int = 8) -> list[str]:
    """The events at each tick. Other actions succeed at once."""
    path = folder / "tree.xml"
    path.write_text(xml, encoding="utf-8")
    arguments = []
    for action in ET.fromstring(xml).iterfind("TreeNodesModel/Action"):
        name = action.attrib["ID"]
        ports = [f"{p.attrib['name']}:{p.attrib['type']}" for p in action if "name" in p.attrib]
        arguments.append(",".join([f"{name}={scripts.get(name, 'S')}", *ports]))
    command = [str(_player()), str(path), str(ticks), *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout.splitlines()
