"""Snapshots as messages of ROS 1 and of ROS 2, by stand-ins of their Python packages."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

from ezskiros.context.ros import NoRosError, connect, ros_library
from ezskiros.context.snapshot import (
    RunningSkill,
    SkillAhead,
    SkillArgument,
    SkillPermission,
    SkillProperty,
    Snapshot,
)
from support.engine import Clock

ROOT = Path(__file__).parents[3]
SNAPSHOT = Snapshot(
    "digest",
    (
        RunningSkill(
            "Push",
            "goal-1",
            2.0,
            (
                SkillArgument(
                    "Object",
                    "skiros:Product-1",
                    "skiros.Product",
                    properties=(SkillProperty("skiros.Weight", 1.5),),
                ),
                SkillArgument("Speed", "0.3", number=0.3),
            ),
            (SkillPermission("contact", "skiros.Product", math.nan),),
        ),
    ),
    (SkillAhead("Drive", (SkillArgument("Speed", "0.3", number=0.3),)),),
)


class Time1:
    def __init__(self, secs: int = 0, nsecs: int = 0) -> None:
        self.secs, self.nsecs = secs, nsecs


class Time2:
    def __init__(self) -> None:
        self.sec, self.nanosec = 0, 0


PLAIN: Mapping[str, Callable[[], Any]] = {"string": str, "float64": float, "bool": bool}
OTHERS: Mapping[str, Callable[[], Any]] = {
    "std_msgs/Header": lambda: SimpleNamespace(stamp=None),
    "time": lambda: None,
    "builtin_interfaces/Time": lambda: None,
}


def messages(generation: str) -> ModuleType:
    """The package of messages, of its definitions: objects that have these fields and no others."""
    found: Any = ModuleType("skill_context_msgs.msg")
    for path in (ROOT / "ros" / generation / "skill_context_msgs" / "msg").glob("*.msg"):
        lines = (line.partition("#")[0].split() for line in path.read_text().splitlines())
        fields = {words[1]: words[0] for words in lines if words}
        setattr(
            found, path.stem, partial(_made, type(path.stem, (), {"__slots__": (*fields,)}), fields)
        )
    return found  # type: ignore[no-any-return]


def _made(kind: type, fields: Mapping[str, str]) -> Any:
    made = kind()
    for name, its_type in fields.items():
        make = list if its_type.endswith("[]") else {**PLAIN, **OTHERS}[its_type]
        setattr(made, name, make())
    return made


@pytest.fixture
def modules(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Puts modules in the place of those of ROS; without one it is not installed."""

    def put(**known: Any) -> None:
        for name in ("rospy", "rosgraph", "rclpy", "skill_context_msgs", "skill_context_msgs.msg"):
            monkeypatch.setitem(sys.modules, name, known.get(name.replace(".", "_")))

    return put


def ros1(
    sent: list[Any], *, is_online: bool = True, begun: list[str] | None = None
) -> dict[str, Any]:
    def publisher(topic: str, _kind: Any, queue_size: int) -> Any:
        assert (topic, queue_size) == ("skill_context", 1)
        return SimpleNamespace(publish=sent.append)

    rospy: Any = ModuleType("rospy")
    rospy.core = SimpleNamespace(is_initialized=lambda: begun is None)
    rospy.init_node = lambda name, **_options: begun.append(name) if begun is not None else None
    rospy.Publisher = publisher
    rospy.Time = Time1
    rospy.Time.now = staticmethod(lambda: Time1(100, 250_000_000))
    rosgraph: Any = ModuleType("rosgraph")
    rosgraph.is_master_online = lambda: is_online
    return {
        "rospy": rospy,
        "rosgraph": rosgraph,
        "skill_context_msgs": ModuleType("skill_context_msgs"),
        "skill_context_msgs_msg": messages("ros1"),
    }


def test_the_message_of_ros_1_says_all_of_a_snapshot(modules: Any) -> None:
    sent, begun, clock = list[Any](), list[str](), Clock()
    modules(**ros1(sent, begun=begun))
    clock.seconds = 5.5
    publish = connect(clock)
    publish(SNAPSHOT)
    clock.seconds = 9.0
    publish(SNAPSHOT)
    assert begun == ["ezskiros_context"]
    first, second = sent
    assert (first.digest, first.header.stamp.secs) == ("digest", 100)
    (skill,) = first.running
    assert (skill.skill, skill.goal) == ("Push", "goal-1")
    assert (skill.since.secs, skill.since.nsecs) == (96, 750_000_000)
    assert second.running[0].since is skill.since, "the start of a skill does not move"
    individual, number = skill.arguments
    assert (individual.parameter, individual.value, individual.type) == (
        "Object",
        "skiros:Product-1",
        "skiros.Product",
    )
    assert math.isnan(individual.number)
    assert [(each.property, each.number) for each in individual.properties] == [
        ("skiros.Weight", 1.5)
    ]
    assert (number.type, number.number, number.properties) == ("", 0.3, [])
    (permission,) = skill.permits
    assert (permission.kind, permission.type) == ("contact", "skiros.Product")
    assert math.isnan(permission.limit)
    (ahead,) = first.ahead
    assert (ahead.skill, [each.number for each in ahead.arguments]) == ("Drive", [0.3])
    assert first.is_ahead_known is True


def test_a_node_that_there_is_is_used(modules: Any) -> None:
    sent = list[Any]()
    modules(**ros1(sent))
    connect()(Snapshot("digest", ()))
    assert [(each.running, each.ahead, each.is_ahead_known) for each in sent] == [([], [], False)]


@pytest.mark.parametrize(("version", "name"), [("1", "rospy"), ("2", "rclpy"), (None, "rospy")])
def test_of_both_that_is_taken_which_is_sourced(
    modules: Any, monkeypatch: pytest.MonkeyPatch, version: str | None, name: str
) -> None:
    modules(rospy=ModuleType("rospy"), rclpy=ModuleType("rclpy"))
    monkeypatch.delenv("ROS_VERSION", raising=False)
    if version is not None:
        monkeypatch.setenv("ROS_VERSION", version)
    assert ros_library()[0] == name


def test_the_message_of_ros_2(modules: Any) -> None:
    sent, clock = list[Any](), Clock()
    now = Time2()
    now.sec, now.nanosec = 1, 500_000_000
    node = SimpleNamespace(
        create_publisher=lambda *_arguments: SimpleNamespace(publish=sent.append),
        get_clock=lambda: SimpleNamespace(now=lambda: SimpleNamespace(to_msg=lambda: now)),
    )
    rclpy: Any = ModuleType("rclpy")
    rclpy.ok, rclpy.create_node = (lambda: True), lambda _name, **_namespace: node
    modules(
        rclpy=rclpy,
        skill_context_msgs=ModuleType("skill_context_msgs"),
        skill_context_msgs_msg=messages("ros2"),
    )
    clock.seconds = 10.0
    connect(clock)(SNAPSHOT)
    (skill,) = sent[0].running
    assert (skill.since.sec, skill.since.nanosec) == (0, 0), "no time is before 0"
    assert skill.permits[0].type == "skiros.Product"


def test_what_is_missing_is_reported(modules: Any) -> None:
    modules()
    with pytest.raises(NoRosError, match="the package `skill_context_msgs` is not installed"):
        connect()
    known = ros1([], is_online=False)
    modules(**{**known, "rospy": None})
    with pytest.raises(NoRosError, match="neither `rospy` nor `rclpy`"):
        connect()
    modules(**known)
    with pytest.raises(NoRosError, match="no ROS master answers"):
        connect()
