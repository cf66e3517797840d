"""`rossmarie_add_guard()`: rules are built with the package that they lie in."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from support.depth import is_deep
from support.guard_packages import AmentPackage, CatkinPackage, GuardPackage
from support.parts import ROS1, ROS2, needs

SPEED = """import "limits.ross";
action slow { limit /cmd_vel : geometry_msgs/Twist { linear.x in [-0.25, 0.25] m/s; }; }
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec;
rule fast: if speed > most then { slow; };
"""
LIMITS = "const most = 1 m/s;\n"
TILT = """action halt { block /cmd_vel : geometry_msgs/Twist; hook flash; }
input orientation = topic /imu/data : sensor_msgs/Imu .orientation timeout 0.2 sec;
rule fallen: if abs(orientation.pitch()) > 30 deg then { halt; } latched until reset;
"""
HOOKS = """#include "hooks.h"
namespace hooks {
void flash(Moment) {}
}
"""
RULES = {"speed__ross": SPEED, "limits__ross": LIMITS, "tilt__ross": TILT, "hooks__cpp": HOOKS}
GUARDS = (
    "rossmarie_add_guard(speed speed.ross)\nrossmarie_add_guard(tilt tilt.ross HOOKS hooks.cpp)"
)


@pytest.fixture(
    params=[
        pytest.param(CatkinPackage, marks=needs(ROS1), id="ros1"),
        pytest.param(AmentPackage, marks=needs(ROS2), id="ros2"),
    ]
)
def package(request: pytest.FixtureRequest, tmp_path: Path) -> GuardPackage:
    """The package of each generation, with nothing in it."""
    kind: Callable[[Path], GuardPackage] = request.param
    return kind(tmp_path)


def refusal(package: GuardPackage) -> str:
    """The error message of cmake, in one line."""
    done = package.configure()
    assert done.returncode != 0
    return " ".join((done.stdout + done.stderr).split())


def asked_for(package: GuardPackage) -> str:
    """The lines that package.xml lacks."""
    done = package.configure()
    assert done.returncode != 0
    _, _, reported = done.stderr.partition("Add these lines:")
    lines = reported.partition("Call Stack")[0].split()
    assert lines, done.stderr
    return "\n".join(lines)


@pytest.mark.deep
def test_a_build_tells_the_dependencies_that_are_missing_and_then_makes_all_guards(
    package: GuardPackage,
) -> None:
    package.write(GUARDS, **RULES)
    first = asked_for(package)
    assert {"<depend>nav_msgs</depend>", *package.always} <= set(first.split())
    package.write(GUARDS, needs=first, **RULES)
    second = asked_for(package)
    assert second == "<depend>sensor_msgs</depend>"
    package.write(GUARDS, needs=first + second, **RULES)
    done = package.configure()
    assert done.returncode == 0, done.stderr
    assert {each.name for each in package.guards.iterdir() if each.is_dir()} == {"speed", "tilt"}

    # A file that the rules import is a file that cmake watches.
    (package.source / "limits.ross").write_text("const most = 2.5 m/s;\n", encoding="utf-8")
    assert package.make("--target", "cmake_check_build_system").returncode == 0
    monitor = (package.guards / "speed" / "src" / "speed_monitor.c").read_text(encoding="utf-8")
    assert "2.5" in monitor

    (package.source / "limits.ross").write_text("const most = 2.5 m;\n", encoding="utf-8")
    done = package.make("--target", "cmake_check_build_system")
    assert done.returncode != 0
    assert re.search(r"error\[ROSS3\d\d\]", done.stdout + done.stderr)


MISTAKES = {
    "rossmarie_add_guard(speed speed.ross HOOK a.cpp)": "unknown arguments: HOOK;a.cpp",
    "rossmarie_add_guard(Speed speed.ross)": "`Speed` is no name of a package",
    "rossmarie_add_guard(speed speeed.ross)": "error[ROSS801]",
    f"add_library(speed_safety_core hooks.cpp)\n{GUARDS}": "there is a guard of this name",
    "rossmarie_add_guard(tilt tilt.ross)": "the rules call hooks (flash)",
    f"set(ROSSMARIE_EXECUTABLE NO CACHE FILEPATH x FORCE)\n{GUARDS}": "is not on the PATH",
}


def test_mistakes_are_reported(package: GuardPackage) -> None:
    package.write("rossmarie_add_guard(tilt tilt.ross)", **RULES)
    needed = asked_for(package)
    for guards, reason in list(MISTAKES.items())[:: 1 if is_deep() else 3]:
        package.write(guards, needs=needed, **RULES)
        assert reason in refusal(package)


@pytest.mark.deep
def test_a_package_with_two_guards_builds(package: GuardPackage) -> None:
    package.write(GUARDS, **RULES)
    first = asked_for(package)
    needed = f"{first}\n<depend>sensor_msgs</depend>"
    package.write(GUARDS, needs=needed, **RULES)
    assert package.configure().returncode == 0
    done = package.make("--parallel", "2")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "warning:" not in done.stderr
    found = {path.name for path in package.build.parent.rglob("*_safety") if path.is_file()}
    assert found == {"speed_safety", "tilt_safety"}
