"""Packages for the messages of robots in the box, where the drivers of these robots are not."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from support.c_compiler import write
from support.workspace import files_of

_CMAKE = """\
cmake_minimum_required(VERSION 3.10)
project({name})
if("$ENV{{ROS_VERSION}}" STREQUAL "1")
  find_package(catkin REQUIRED COMPONENTS message_generation {used} {used_in_ros1})
  {calls}
  generate_messages(DEPENDENCIES {used} {used_in_ros1})
  catkin_package(CATKIN_DEPENDS message_runtime {used} {used_in_ros1})
else()
  find_package(ament_cmake REQUIRED)
  find_package(rosidl_default_generators REQUIRED)
  foreach(each {used})
    find_package(${{each}} REQUIRED)
  endforeach()
  rosidl_generate_interfaces(${{PROJECT_NAME}} {paths} DEPENDENCIES {used})
  ament_package()
endif()
"""
_MANIFEST = """\
<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>0.1.0</version>
  <description>Messages of a robot, for live tests</description>
  <maintainer email="nobody@example.org">nobody</maintainer>
  <license>Apache-2.0</license>
  <buildtool_depend condition="$ROS_VERSION == 1">catkin</buildtool_depend>
  <buildtool_depend condition="$ROS_VERSION == 2">ament_cmake</buildtool_depend>
  <build_depend condition="$ROS_VERSION == 1">message_generation</build_depend>
  <exec_depend condition="$ROS_VERSION == 1">message_runtime</exec_depend>
  <build_depend condition="$ROS_VERSION == 2">rosidl_default_generators</build_depend>
  <exec_depend condition="$ROS_VERSION == 2">rosidl_default_runtime</exec_depend>
  <member_of_group condition="$ROS_VERSION == 2">rosidl_interface_packages</member_of_group>
{depends}
  <export>
    <build_type condition="$ROS_VERSION == 2">ament_cmake</build_type>
  </export>
</package>
"""
_CALLS = {"msg": "add_message_files", "srv": "add_service_files", "action": "add_action_files"}
_USED = re.compile(r"^(\w+)/\w+", re.MULTILINE)


def write_packages(messages: Path, folder: Path) -> Sequence[Path]:
    """Write a package for each folder of definitions into a folder: where they are."""
    found = []
    for source in sorted(path for path in messages.iterdir() if path.is_dir()):
        definitions = files_of(source)
        target = folder / source.name
        write({**definitions, **_around(source.name, definitions)}, target)
        found.append(target)
    return found


def _around(name: str, definitions: dict[str, str]) -> dict[str, str]:
    """The files of a package beside its definitions."""
    named = {package for text in definitions.values() for package in _USED.findall(text)}
    used = sorted({"std_msgs", *named} - {name})
    kinds = sorted({path.partition("/")[0] for path in definitions})
    cmake = _CMAKE.format(
        name=name,
        used=" ".join(used),
        used_in_ros1="actionlib_msgs" if "action" in kinds else "",
        calls="\n  ".join(f"{_CALLS[kind]}(DIRECTORY {kind})" for kind in kinds),
        paths=" ".join(sorted(definitions)),
    )
    depends = "\n".join(f"  <depend>{each}</depend>" for each in used)
    if "action" in kinds:
        depends += '\n  <depend condition="$ROS_VERSION == 1">actionlib_msgs</depend>'
    return {"CMakeLists.txt": cmake, "package.xml": _MANIFEST.format(name=name, depends=depends)}
