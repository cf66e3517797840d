"""A package of a user that builds its rules by `rossmarie_add_guard()`, for ROS 1 and ROS 2."""

from __future__ import annotations

import os
import subprocess
import sys
from abc import ABC, abstractmethod
from collections.abc import Mapping
from pathlib import Path

from support.ros1_build import VARIABLES
from support.ros1_python import PYTHON

_CMAKE = Path(__file__).parents[2] / "ros"
_ROSSMARIE = Path(sys.executable).with_name("rossmarie")
_PACKAGE = """<package format="3">
  <name>my_robot</name>
  <version>1.0.0</version>
  <description>a robot</description>
  <maintainer email="ada@example.org">Ada</maintainer>
  <license>MIT</license>
  <buildtool_depend>{tool}</buildtool_depend>
  <buildtool_depend>rossmarie_{flavor}</buildtool_depend>
{needs}
  <export><build_type>{tool}</build_type></export>
</package>
"""
_LISTS = """cmake_minimum_required(VERSION 3.20)
project(my_robot C CXX)
{begin}
{guards}
{end}
"""


class GuardPackage(ABC):
    """The package `my_robot`; `needs` are the lines of its package.xml that its guards ask for."""

    flavor: str
    tool: str
    begin: str
    end: str
    always: tuple[str, ...]

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self.source = folder / "src" / "my_robot"
        self.source.mkdir(parents=True)
        self.build = folder / "build"

    @property
    @abstractmethod
    def guards(self) -> Path:
        """The folder of the generated guards."""

    @property
    @abstractmethod
    def variables(self) -> Mapping[str, str]:
        """The environment of its build."""

    @abstractmethod
    def configure(self) -> subprocess.CompletedProcess[str]:
        """Run cmake."""

    def write(self, guards: str, *, needs: str = "", **files: str) -> None:
        """Write package.xml, CMakeLists.txt and further files; in names, `__` stands for a dot."""
        xml = _PACKAGE.format(tool=self.tool, flavor=self.flavor, needs=needs)
        lists = _LISTS.format(begin=self.begin, guards=guards, end=self.end)
        texts = {"package.xml": xml, "CMakeLists.txt": lists}
        texts.update({name.replace("__", "."): text for name, text in files.items()})
        for name, text in texts.items():
            (self.source / name).write_text(text, encoding="utf-8")

    def make(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        """Build, with the arguments of cmake."""
        return self.run("cmake", "--build", str(self.build), *arguments)

    def run(self, *command: str) -> subprocess.CompletedProcess[str]:
        """Run a command of the build."""
        return subprocess.run(
            command, env={**self.variables}, capture_output=True, text=True, check=False
        )


class CatkinPackage(GuardPackage):
    """In a workspace with `rossmarie_catkin`."""

    flavor = "catkin"
    tool = "catkin"
    begin = "find_package(catkin REQUIRED COMPONENTS rossmarie_catkin)"
    end = "catkin_package()"
    always = (
        "<build_depend>message_generation</build_depend>",
        "<exec_depend>message_runtime</exec_depend>",
    )

    def __init__(self, folder: Path) -> None:
        super().__init__(folder)
        toplevel = Path("/usr/share/catkin/cmake/toplevel.cmake")
        (folder / "src" / "CMakeLists.txt").symlink_to(toplevel)
        (folder / "src" / "rossmarie_catkin").symlink_to(_CMAKE / "rossmarie_catkin")

    @property
    def guards(self) -> Path:
        return self.build / "my_robot" / "rossmarie"

    @property
    def variables(self) -> Mapping[str, str]:
        return {
            **VARIABLES,
            "HOME": str(self._folder),
            "CMAKE_PREFIX_PATH": "/usr",
            "ROS_LANG_DISABLE": "geneus:genlisp:gennodejs:genpy",
        }

    def configure(self) -> subprocess.CompletedProcess[str]:
        sources, devel = self._folder / "src", self._folder / "devel"
        options = (f"-DPYTHON_EXECUTABLE={PYTHON}", f"-DCATKIN_DEVEL_PREFIX={devel}")
        folders = ("-S", str(sources), "-B", str(self.build))
        return self.run("cmake", *folders, f"-DROSSMARIE_EXECUTABLE={_ROSSMARIE}", *options)


class AmentPackage(GuardPackage):
    """With `rossmarie_ament` installed beside it."""

    flavor = "ament"
    tool = "ament_cmake"
    begin = "find_package(ament_cmake REQUIRED)\nfind_package(rossmarie_ament REQUIRED)"
    end = "ament_package()"
    always = (
        "<build_depend>rosidl_default_generators</build_depend>",
        "<exec_depend>rosidl_default_runtime</exec_depend>",
        "<exec_depend>launch_ros</exec_depend>",
        "<member_of_group>rosidl_interface_packages</member_of_group>",
    )

    def __init__(self, folder: Path) -> None:
        super().__init__(folder)
        self._prefix = folder / "install"
        build = str(folder / "rossmarie_ament")
        source = str(_CMAKE / "rossmarie_ament")
        for command in (
            ("cmake", "-S", source, "-B", build, f"-DCMAKE_INSTALL_PREFIX={self._prefix}"),
            ("cmake", "--install", build),
        ):
            done = self.run(*command)
            assert done.returncode == 0, done.stderr

    @property
    def guards(self) -> Path:
        return self.build / "rossmarie"

    @property
    def variables(self) -> Mapping[str, str]:
        prefixes = os.environ.get("CMAKE_PREFIX_PATH") or os.environ["AMENT_PREFIX_PATH"]
        return {**os.environ, "CMAKE_PREFIX_PATH": f"{self._prefix}:{prefixes}"}

    def configure(self) -> subprocess.CompletedProcess[str]:
        folders = ("-S", str(self.source), "-B", str(self.build))
        return self.run("cmake", *folders, f"-DROSSMARIE_EXECUTABLE={_ROSSMARIE}")
