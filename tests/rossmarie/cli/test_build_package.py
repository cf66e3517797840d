"""`rossmarie build` of packages for ROS: what package.xml says, and parts of other packages."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from support import command_line
from support.tree import tree

RULES = """
import "limits.ross";
action stop { block /cmd_vel : geometry_msgs/Twist; hook flash; }
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec;
rule fast: if speed > most then { stop; };
"""
ADA = ("--maintainer", "Ada <ada@example.org>")
BOTH = (*ADA, "--license", "MIT")
ASKED = "package.xml names no license and no maintainer: give --license and --maintainer, or "


def run(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    return command_line.run("rossmarie", *arguments)


@pytest.fixture
def rules(tmp_path: Path) -> Path:
    (tmp_path / "limits.ross").write_text("const most = 1 m/s;\n", encoding="utf-8")
    path = tmp_path / "speed.ross"
    path.write_text(RULES, encoding="utf-8")
    return path


@pytest.fixture
def out(tmp_path: Path) -> Path:
    return tmp_path / "out"


@pytest.mark.parametrize("target", ["ros1", "ros2"])
def test_a_package_without_licence_and_maintainer_is_reported_of_in_a_line(
    target: str, rules: Path, out: Path
) -> None:
    done = run("build", rules, "--target", target, "--out", out)
    assert done.returncode == 0
    assert [line for line in done.stdout.splitlines() if line.startswith(ASKED)] != []


def test_options_say_whose_the_package_is(rules: Path, out: Path) -> None:
    done = run("build", rules, "--target", "ros2", "--out", out, *BOTH)
    assert "package.xml names no" not in done.stdout
    text = (out / "package.xml").read_text(encoding="utf-8")
    assert '<maintainer email="ada@example.org">Ada</maintainer>' in text
    assert "<license>MIT</license>" in text


@pytest.mark.parametrize(
    ("option", "form"),
    [("--maintainer", "Name <name@example.org>"), ("--license", "Apache-2.0")],
)
def test_a_bad_option_says_how_it_must_look(option: str, form: str, rules: Path, out: Path) -> None:
    done = run("build", rules, "--target", "ros2", "--out", out, option, " ")
    assert done.returncode == 2
    assert form in " ".join(done.stderr.replace("│", " ").split())
    assert not out.exists()


def test_a_bad_package_of_the_rules_is_a_finding(rules: Path, out: Path) -> None:
    rules.with_name("package.xml").write_text("<package><license/></package>", encoding="utf-8")
    done = run("build", rules, "--target", "ros1", "--out", out)
    assert (done.returncode, out.exists()) == (1, False)
    assert "error[ROSS808]" in done.stdout


def test_options_of_packages_are_for_packages(rules: Path, out: Path) -> None:
    for options in (ADA, BOTH[2:], ("--part-of", "robot")):
        done = run("build", rules, "--out", out, *options)
        assert done.returncode == 2
        assert done.stderr == f"rossmarie: {options[0]} needs --target ros1 or ros2\n"
    done = run("build", rules, "--target", "ros1", "--part-of", "robot", "--out", out, *ADA)
    assert done.stderr == (
        "rossmarie: leave out --maintainer with --part-of: edit the package.xml of robot\n"
    )
    assert not out.exists()


@pytest.mark.parametrize("option", ["--part-of", "--name"])
@pytest.mark.parametrize("name", ["", "My-Robot", "1st", "a b"])
def test_a_package_has_a_name_of_ros(option: str, name: str, rules: Path, out: Path) -> None:
    done = run("build", rules, "--target", "ros2", "--out", out, option, name)
    assert done.returncode == 2
    assert "is not a package name" in done.stderr


@pytest.mark.parametrize("target", ["ros1", "ros2"])
def test_a_part_of_a_package_is_what_its_build_includes(
    target: str, rules: Path, out: Path
) -> None:
    command = ("build", rules, "--target", target, "--out", out, "--part-of", "robot")
    done = run(*command, "--name", "slow")
    assert done.returncode == 0
    written = tree(out)
    assert {"needs.cmake", "src/slow_monitor.c", "msg/State.msg"} <= set(written)
    assert not {"package.xml", "CMakeLists.txt", "README.md"} & set(written)
    assert "<robot/" in written["src/rules.h"].decode()
    assert "set(_guard_hook_functions flash)" in written["needs.cmake"].decode()
    launches = [text.decode() for name, text in written.items() if name.startswith("launch/")]
    for text in ("slow_safety", "robot", "slow_safety.yaml"):
        assert text in "".join(launches)


def test_a_part_of_a_package_is_written_anew_with_the_files_that_a_user_may_copy(
    rules: Path, out: Path
) -> None:
    command = ("build", rules, "--target", "ros2", "--out", out, "--part-of", "robot")
    run(*command)
    text = rules.read_text(encoding="utf-8")
    rules.write_text(text.replace("flash", "blink"), encoding="utf-8")
    assert run(*command).returncode == 0
    assert "blink" in (out / "src" / "hooks.cpp").read_text(encoding="utf-8")


def test_the_files_that_rules_rest_on_are_listed(rules: Path, out: Path, tmp_path: Path) -> None:
    listed = tmp_path / "files.txt"
    run("build", rules, "--out", out, "--sources", listed)
    mark, *lines = listed.read_text(encoding="utf-8").splitlines()
    assert mark == "# Written by rossmarie."
    files = [Path(line) for line in lines]
    assert sorted(files) == [rules.with_name("limits.ross"), rules]
