"""The rules of `examples/` that look at lists, names and the past, as one node; and a course of
events for each of them, with what goes wrong on robots.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

from rosbags.typesys import get_types_from_msg
from rosbags.typesys.store import Typestore

from support.made_messages import made
from support.recordings import START_NS, Reading

_EXAMPLES = Path(__file__).parents[2] / "examples"
VISION = _EXAMPLES / "perception" / "msg" / "vision_msgs"
_RULES = {
    "arm": _EXAMPLES / "arm" / "joints.ross",
    "cell": _EXAMPLES / "cell" / "cell.ross",
    "gripper": _EXAMPLES / "gripper" / "gripper.ross",
    "perception": _EXAMPLES / "perception" / "objects.ross",
}
_DECLARED = re.compile(r"^(?:action|const|entity|hazard|input|rule|system) (\w+)", re.MULTILINE)


def write(rules: Path) -> Path:
    """Write one file of all rules, so that one node has to be built. What a file declares has the
    name of the file before its own: `cell_door`. No rule is latched: from the first message on,
    before all inputs are there, some would be active for good.
    """
    texts = [_renamed(name, each.read_text("utf-8")) for name, each in _RULES.items()]
    text = "\n".join(texts).replace('"msg"', f'"{VISION.parent}"')
    rules.write_text(text.replace(" latched until reset", ""), "utf-8")
    return rules


def _renamed(file: str, text: str) -> str:
    """The text without its tests, in which what it declares has the name of the file before it."""
    text = re.split(r"^test ", text, maxsplit=1, flags=re.MULTILINE)[0]
    names = "|".join(_DECLARED.findall(text))
    return re.sub(rf'(?<![\w./"])({names})\b(?!")', rf"{file}_\1", text)


# --- what happens ----------------------------------------------------------------------------

_TICK_NS = 40_000_000
_CALM_NS = 4_400_000_000
_ALL_NS = _CALM_NS + 8_000_000_000

BEGIN_S = 4.1
"""The time from which the order of the first messages has no effect. A node waits for all of them;
a replay gets them one after the other.
"""


def drive(store: Typestore) -> Iterator[Reading]:
    """All of it, 25 times a second, for 8 s after a time in which nothing happens."""
    _know_vision(store)
    for tick in range(_ALL_NS // _TICK_NS):
        at_s = (tick * _TICK_NS - _CALM_NS) / 1e9
        for sensor in (_arm, _cell, _gripper, _perception):
            for topic, kind, message in sensor(partial(made, store), at_s):
                yield topic, START_NS + tick * _TICK_NS, kind.replace("/", "/msg/"), message


def _know_vision(store: Typestore) -> None:
    for path in (VISION / "msg").iterdir():
        name = f"vision_msgs/msg/{path.stem}"
        if name not in store.fielddefs:
            store.register(get_types_from_msg(path.read_text("utf-8"), name))


_Sent = Iterator[tuple[str, str, Any]]
_Make = Any
"""Makes a message of a type, with fields."""


def _during(at_s: float, begin: float, end: float) -> bool:
    return begin <= at_s < end


def _sent(make: _Make, topic: str, kind: str, **given: object) -> tuple[str, str, Any]:
    return topic, kind, make(kind, **given)


def _arm(make: _Make, at_s: float) -> _Sent:
    """Joints in changing orders; a NaN beside the elbow, then no elbow, two, and one too much; the
    driver pauses; the effort controller is told of a joint that is not there.
    """
    send = partial(_sent, make)
    joints = [("shoulder_joint", 1.0), ("elbow_joint", 2.0), ("wrist_3_joint", 0.5)]
    if _during(at_s, 0.5, 1.0):
        joints[0] = ("shoulder_joint", math.nan)
    if _during(at_s, 1.0, 1.5):
        del joints[1]
    if _during(at_s, 2.0, 2.5):
        joints.append(("elbow_joint", 2.0))
    turned = joints[:: -1 if round(at_s * 25) % 2 else 1]
    efforts = [effort for _, effort in turned] + [1.0] * _during(at_s, 3.0, 3.2)
    speeds = [2.0 if _during(at_s, 5.0, 5.1) and name[0] == "e" else 0.1 for name, _ in turned]
    if not _during(at_s, 4.0, 4.5):
        yield send(
            "/joint_states",
            "sensor_msgs/JointState",
            name=[name for name, _ in turned],
            position=[0.1] * len(turned),
            velocity=speeds,
            effort=efforts,
        )
    status = 4 if _during(at_s, 6.0, 6.2) else 1
    yield send("/arm_controller/status", "actionlib_msgs/GoalStatus", status=status)
    commanded = [0.0, 61.0 if _during(at_s, 6.5, 6.6) else 5.0, 0.0]
    commanded += [0.0] * _during(at_s, 7.0, 7.1)
    yield send("/effort_controller/commands", "std_msgs/Float64MultiArray", data=commanded)


def _cell(make: _Make, at_s: float) -> _Sent:
    """A door is opened and acknowledged; a stop is obeyed, another one late; somebody walks by."""
    send = partial(_sent, make)
    is_open, is_acknowledged = _during(at_s, 1.0, 1.5), not _during(at_s, 0.9, 3.0)
    yield send("/cell/door_open", "std_msgs/Bool", data=is_open)
    yield send("/cell/acknowledged", "std_msgs/Bool", data=is_acknowledged)
    is_pressed = _during(at_s, 2.0, 2.5) or _during(at_s, 5.0, 5.1)
    yield send("/cell/stop_pressed", "std_msgs/Bool", data=is_pressed)
    is_moving = _during(at_s, 0.0, 2.3) or _during(at_s, 3.0, 6.0)
    yield send("/odom", "nav_msgs/Odometry", twist__twist__linear__x=0.5 * is_moving)
    if not _during(at_s, 6.0, 6.8):
        ranges = [4.0, 1.2 if _during(at_s, 3.5, 3.6) else math.inf, 3.0, 4.0, 4.0]
        yield send(
            "/scan",
            "sensor_msgs/LaserScan",
            angle_min=-math.pi,
            angle_max=math.pi * 3 / 5,
            angle_increment=math.tau / 5,
            range_min=0.05,
            range_max=30.0,
            ranges=[] if at_s > 7.5 else ranges,
        )


def _gripper(make: _Make, at_s: float) -> _Sent:
    """Something is held, bounces, and slips; the switch chatters; the program changes."""
    send = partial(_sent, make)
    is_away = _during(at_s, 4.8, 6.6) and int(at_s * 5) % 2 == 0
    force = 0.0 if is_away else 0.5 if _during(at_s, 3.0, 3.6) else 8.0
    if _during(at_s, 7.2, 7.4):
        force = math.nan
    yield send("/gripper/wrench", "geometry_msgs/WrenchStamped", wrench__force__z=force)
    is_chattering = _during(at_s, 6.0, 6.5) and int(at_s * 20) % 2 == 0
    yield send("/gripper/closed", "std_msgs/Bool", data=not is_chattering)
    yield send("/gripper/program", "std_msgs/UInt8", data=1 if at_s < 7.0 else 2)


def _perception(make: _Make, at_s: float) -> _Sent:
    """Objects come near, there are none, there are too many; a path leads up; a motor fails."""
    send = partial(_sent, make)
    places = [(4.0, 0.0)]
    if _during(at_s, 1.0, 1.5):
        places.append((1.2, 0.3))
    if _during(at_s, 3.0, 3.5):
        places = []
    if _during(at_s, 4.0, 4.2):
        places *= 65
    if _during(at_s, 5.0, 5.1):
        places.append((0.5, math.nan))
    yield send(
        "/detections",
        "vision_msgs/Detection3DArray",
        detections=[_seen(make, *at) for at in places],
    )
    heights = [0.0] + [0.3] * (5 if _during(at_s, 2.0, 2.4) else 1)
    poses = [make("geometry_msgs/PoseStamped", pose__position__z=z) for z in heights]
    yield send("/plan", "nav_msgs/Path", poses=poses)
    motor = 2 if _during(at_s, 7.0, 7.1) else 0
    parts = [("camera", 2), ("motor", motor)]
    status = [make("diagnostic_msgs/DiagnosticStatus", name=n, level=level) for n, level in parts]
    yield send("/drives/status", "diagnostic_msgs/DiagnosticArray", status=status)


def _seen(make: _Make, x: float, y: float) -> Any:
    place = {"bbox__center__position__x": x, "bbox__center__position__y": y}
    return make("vision_msgs/Detection3D", **place, bbox__size__z=1.7)
