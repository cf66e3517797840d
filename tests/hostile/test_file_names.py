"""A rules file may be called anything: no generated file takes a part of its name for code."""

from __future__ import annotations

import ast
import re
import xml.etree.ElementTree as ET
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path, PurePath
from tempfile import TemporaryDirectory

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.driver import compile_file
from rossmarie.driver.build import generate

RULES = """\
action slow {
    limit /cmd_vel : geometry_msgs/Twist { linear.x in [-0.2, 0.2] m/s; };
    hook flash;
}
input orientation = topic /imu/data : sensor_msgs/Imu .orientation timeout 0.2 sec;
rule steep: if abs(orientation.pitch()) > 10 deg then { slow; };
"""
SPECIAL = (
    "\n",
    "\r",
    "\u2028",
    "\\",
    "*/",
    "/*",
    "//",
    "-->",
    "??/",
    '"""',
    "'''",
    "#",
    "{{",
    "%}",
)
TARGETS = ("c99", "python", "ros1", "ros2")
_HIDDEN = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\])*"', re.DOTALL)

parts = st.sampled_from(SPECIAL) | st.text(
    st.characters(exclude_characters="/\0", exclude_categories=["Cs"]), max_size=5
)
names = st.lists(parts, max_size=8).map("".join).map(lambda name: name.replace("/", "")[:40])


def of_c(text: str) -> object:
    """The tokens outside of comments and strings, as the compiler joins lines."""
    return _HIDDEN.sub(" ", text.replace("\\\n", "")).split()


def of_python(text: str) -> object:
    """The syntax tree, without the contents of strings."""
    tree = ast.parse(text)
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            node.value = ""
    return ast.dump(tree)


def of_xml(text: str) -> object:
    """The elements with their attributes."""
    return [(element.tag, element.attrib) for element in ET.fromstring(text).iter()]


def after_hash(text: str) -> object:
    """The lines that are no comments."""
    return [line for line in text.split("\n") if not line.startswith("#")]


def of_markdown(text: str) -> object:
    """The beginning of each line, except the line with the name of the file."""
    return [line[:2] for line in text.split("\n")]


CODE: Mapping[str, Callable[[str], object]] = {
    **dict.fromkeys((".c", ".cpp", ".h"), of_c),
    **dict.fromkeys((".cmake", ".msg", ".srv", ".txt", ".yaml"), after_hash),
    **dict.fromkeys((".launch", ".xml"), of_xml),
    ".md": of_markdown,
    ".py": of_python,
    "": str,  # SHA256SUMS
}


def machine(name: str) -> ir.Machine:
    """The machine of the rules in a file with this name."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / f"{name}.ross"
        path.write_text(RULES, encoding="utf-8")
        return replace(compile_file(path).machine, name="watched")


@cache
def plain() -> ir.Machine:
    return machine("plain")


def code(called: ir.Machine, target: str) -> dict[str, object]:
    """All that is generated, without comments and texts."""
    files = generate(called, target)
    return {path: CODE[PurePath(path).suffix](text) for path, text in files.items()}


@pytest.mark.parametrize("target", TARGETS)
@given(name=names)
@example(name="evil\nimport os; os.system('touch gotcha')\n")
@example(name="evil\\")
@example(name="--><include file='evil.launch'")
@example(name="*!")
@example(name="no text: \udcff")
def test_a_name_is_no_code(target: str, name: str) -> None:
    assert code(machine(name), target) == code(plain(), target)
