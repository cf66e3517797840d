"""A package is not generated over another one, nor over the one for the other generation of ROS."""

from __future__ import annotations

from pathlib import Path

import pytest

from dslkit.diagnostics import Diagnostic
from rossmarie.driver import RulesError
from rossmarie.driver.build import build_files
from support.tree import tree

RULES = """
action stop { block /cmd_vel : geometry_msgs/Twist; }
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec;
rule fast: if speed > 1 m/s then { stop; };
"""
OF_THE_USER = """<?xml version="1.0"?>
<package format="3">
  <name>my_robot</name>
  <buildtool_depend>{}</buildtool_depend>
</package>
"""
OTHER = {"ros1": "ros2", "ros2": "ros1"}
CALLED = {"ros1": "ROS 1", "ros2": "ROS 2"}
BUILD_TOOL = {"ros1": "catkin", "ros2": "ament_cmake"}


@pytest.fixture
def rules(tmp_path: Path) -> Path:
    path = tmp_path / "tilt_stop.ross"
    path.write_text(RULES, encoding="utf-8")
    return path


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return tmp_path / "package"


def refused(rules: Path, target: str, folder: Path) -> Diagnostic:
    """The one finding; nothing is written."""
    before = tree(folder)
    with pytest.raises(RulesError) as caught:
        build_files(rules, target, folder)
    assert tree(folder) == before
    (found,) = caught.value.diagnostics
    assert found.primary.span.file.path == str(folder / "package.xml")
    return found


@pytest.mark.parametrize("target", OTHER)
def test_the_package_of_the_other_generation_is_refused(
    target: str, rules: Path, folder: Path
) -> None:
    build_files(rules, OTHER[target], folder)
    found = refused(rules, target, folder)
    assert found.code == "ROSS805"
    assert found.title == (
        f"`{folder}` holds a package for {CALLED[OTHER[target]]}, not for {CALLED[target]}"
    )
    assert BUILD_TOOL[OTHER[target]] in found.primary.span.text


@pytest.mark.parametrize("target", OTHER)
def test_a_package_of_the_user_is_refused(target: str, rules: Path, folder: Path) -> None:
    folder.mkdir()
    (folder / "package.xml").write_text(OF_THE_USER.format(BUILD_TOOL[target]), encoding="utf-8")
    found = refused(rules, target, folder)
    assert (found.code, found.primary.span.text) == ("ROSS806", "<name>my_robot</name>")
    assert "`my_robot`, which was not generated from tilt_stop.ross" in found.title


def test_the_package_of_other_rules_is_refused(rules: Path, folder: Path) -> None:
    build_files(rules, "ros2", folder)
    other = rules.rename(rules.with_name("arm.ross"))
    found = refused(other, "ros2", folder)
    assert (found.code, found.primary.span.text) == ("ROSS806", "<name>tilt_stop_safety</name>")


def test_a_package_that_names_no_build_system_is_another_one(rules: Path, folder: Path) -> None:
    folder.mkdir()
    (folder / "package.xml").write_text("<package/>", encoding="utf-8")
    assert refused(rules, "ros1", folder).code == "ROSS806"


@pytest.mark.parametrize(
    ("content", "line", "reason"),
    [
        (b"<package>\n  <name>a</nam>\n</package>", 2, "mismatched tag"),
        (b"", 1, "no element found"),
        (b"<package>\n  <name>\xff</name>\n</package>", 2, "from here on this is not UTF-8"),
    ],
)
def test_a_package_xml_that_cannot_be_read_is_refused(
    content: bytes, line: int, reason: str, rules: Path, folder: Path
) -> None:
    folder.mkdir()
    (folder / "package.xml").write_bytes(content)
    found = refused(rules, "ros2", folder)
    assert (found.code, found.primary.text) == ("ROSS807", reason)
    assert found.primary.span.begin.line == line


def test_the_same_package_is_generated_again(rules: Path, folder: Path) -> None:
    build_files(rules, "ros2", folder)
    (folder / "README.md").unlink()
    build_files(rules, "ros2", folder)
    assert (folder / "README.md").exists()


@pytest.mark.parametrize("target", ["c99", "python"])
def test_what_is_no_package_may_lie_in_one(target: str, rules: Path, folder: Path) -> None:
    folder.mkdir()
    (folder / "package.xml").write_text(OF_THE_USER.format("catkin"), encoding="utf-8")
    assert build_files(rules, target, folder).written
