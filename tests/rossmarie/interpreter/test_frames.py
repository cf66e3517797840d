"""S76 to S80: positions, orientations and vectors that are seen from other frames."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rossmarie.core import Function
from rossmarie.interpreter import Interpreter, arithmetic
from rossmarie.ir import ChannelValues, TruthValue
from support.compiled import machine_of
from support.frames import Placed, matrix, rotation, turn_of
from support.programs import program_of

F, T, _, L = TruthValue
NAN = math.nan
SYSTEM = """
system robot {
    frame base in odom timeout 1 sec;
    frame head in base timeout 1 sec;
    frame camera in head;
    frame tool in base at [0.5, -0.25, 1] m turned [10, 20, 30] deg;
}
action slow;
"""
HAND = "input hand = topic /hand : geometry_msgs/PoseStamped .pose"
UPRIGHT = (0.0, 0.0, 0.0, 1.0)
TOOL = Placed("base", "tool", (0.5, -0.25, 1.0), turn_of(*map(math.radians, (10, 20, 30))))

lengths = st.floats(-20.0, 20.0)
places = st.tuples(lengths, lengths, lengths)
turns = st.tuples(*[st.floats(-1.0, 1.0)] * 4).filter(lambda each: np.linalg.norm(each) > 0.1)


class Watched:
    """Rules on expressions, and the numbers that these have."""

    def __init__(self, inputs: str, *expressions: str) -> None:
        rules = "".join(
            f"rule r{place}: if {expression} > 0 {_unit(expression)} then {{ slow; }};"
            for place, expression in enumerate(expressions)
        )
        self.machine = machine_of(f"{SYSTEM}{inputs};{rules}")
        self._monitor = Interpreter(self.machine)

    def hear(self, at_ns: int, messages: Mapping[str, Mapping[str, float | str]]) -> None:
        """Messages by topic; of each the fields by their paths."""
        channels = {}
        for index, channel in enumerate(self.machine.channels):
            fields = messages.get(channel.topic)
            if fields is not None:
                channels[index] = ChannelValues(self._slots(index, fields))
        self._monitor.update(at_ns, channels)

    def _slots(self, channel: int, fields: Mapping[str, float | str]) -> dict[int, float]:
        machine, found = self.machine, {}
        for index, slot in enumerate(machine.slots):
            if machine.inputs[slot.input].channel == channel:
                value = fields[".".join(map(str, slot.path))]
                known = machine.texts.index(value) if value in machine.texts else -1
                found[index] = float(known) if isinstance(value, str) else value
        return found

    def advance(self, at_ns: int) -> None:
        self._monitor.advance(at_ns)

    @property
    def numbers(self) -> list[float]:
        """The signals that the rules look at."""
        memory = self._monitor._memory
        return [float(memory.signals[rule.signals[0]]) for rule in self.machine.rules]

    @property
    def propositions(self) -> list[TruthValue | None]:
        memory = self._monitor._memory
        return [memory.truth_values[rule.condition] for rule in self.machine.rules]


def _unit(expression: str) -> str:
    units = {"position": "m", "yaw": "rad", "linear": "m/s", "force": "N"}
    return next(unit for word, unit in units.items() if word in expression)


def transform(placed: Placed) -> dict[str, float | str]:
    origin = {f"translation.{a}": v for a, v in zip("xyz", placed.origin, strict=True)}
    turn = {f"rotation.{a}": v for a, v in zip("xyzw", placed.turn, strict=True)}
    return {**origin, **turn}


def pose(
    frame: str, place: Sequence[float], turn: Sequence[float] = UPRIGHT
) -> dict[str, float | str]:
    position = {f"pose.position.{a}": v for a, v in zip("xyz", place, strict=True)}
    orientation = {f"pose.orientation.{a}": v for a, v in zip("xyzw", turn, strict=True)}
    return {"header.frame_id": frame, **position, **orientation}


@given(places, turns)
def test_s76_a_vector_is_turned(vector: tuple[float, ...], turn: tuple[float, ...]) -> None:
    turned = (Function.TURNED_X, Function.TURNED_Y, Function.TURNED_Z)
    found = [arithmetic.apply(each, (*vector, *turn)) for each in turned]
    assert found == pytest.approx(list(rotation(turn) @ vector), abs=1e-12)


@given(turns, turns)
def test_s76_turns_come_one_behind_the_other(
    second: tuple[float, ...], first: tuple[float, ...]
) -> None:
    composed = [each for each in Function if each.value.startswith("composed")]
    found = [arithmetic.apply(each, (*second, *first)) for each in composed]
    np.testing.assert_allclose(rotation(found), rotation(second) @ rotation(first), atol=1e-12)


@pytest.mark.parametrize("turn", [(0.0,) * 4, (1e-80, 0.0, 0.0, 0.0), (0.0, 0.0, 1e90, 0.0)])
def test_s76_a_turn_that_was_not_measured_is_unknown(turn: tuple[float, ...]) -> None:
    assert math.isnan(arithmetic.apply(Function.TURNED_X, (1.0, 2.0, 3.0, *turn)))


def test_s76_no_turn_changes_no_bit() -> None:
    for function, expected in zip(
        (Function.TURNED_X, Function.TURNED_Y, Function.TURNED_Z), (0.1, -0.7, 1e9), strict=True
    ):
        assert arithmetic.apply(function, (0.1, -0.7, 1e9, 0.0, 0.0, 0.0, 0.3)) == expected


def test_s77_another_frame_than_declared_is_stale() -> None:
    watched = Watched(
        f"{HAND} from tool timeout 1 sec", "hand.position.x", "hand.orientation.yaw()"
    )
    watched.hear(1, {"/hand": pose("tool", (1.0, 2.0, 3.0))})
    assert watched.propositions == [T, F]
    watched.hear(2, {"/hand": pose("camera", (1.0, 2.0, 3.0))})
    assert watched.propositions == [L, L]


def test_s77_the_twist_of_an_odometry_is_in_the_frame_of_the_child() -> None:
    inputs = (
        "input moved = topic /odom : nav_msgs/Odometry .twist.twist from base timeout 1 sec;"
        "input place = topic /odom : nav_msgs/Odometry .pose.pose from odom timeout 1 sec"
    )
    watched = Watched(inputs, "moved.linear.x", "place.position.x")
    fields: dict[str, float | str] = {
        "twist.twist.linear.x": 1.0,
        "pose.pose.position.x": 1.0,
        "header.frame_id": "odom",
        "child_frame_id": "base",
    }
    watched.hear(1, {"/odom": fields})
    assert watched.propositions == [T, T]
    watched.hear(2, {"/odom": {**fields, "child_frame_id": "head"}})
    assert watched.propositions == [L, T]
    watched.hear(3, {"/odom": {**fields, "header.frame_id": "map"}})
    assert watched.propositions == [T, L]


@given(places, turns, places, turns, places, turns)
def test_s78_the_way_up_and_down(
    place: tuple[float, ...],
    turn: tuple[float, ...],
    head: tuple[float, ...],
    turned: tuple[float, ...],
    camera: tuple[float, ...],
    mounted: tuple[float, ...],
) -> None:
    """Transforms from the camera up to the base and down to the tool, compared with matrices."""
    watched = TRANSFORMED
    edges = (Placed("base", "head", head, turned), Placed("head", "camera", camera, mounted))
    watched.hear(
        next(instants),
        {
            "/tf (head in base)": transform(edges[0]),
            "/tf_static (camera in head)": transform(edges[1]),
            "/hand": pose("camera", place, turn),
        },
    )
    matrices = np.linalg.inv(matrix(TOOL)) @ matrix(edges[0]) @ matrix(edges[1])
    expected = matrices @ (*place, 1.0)
    whole = matrices[:3, :3] @ rotation(turn)
    yaw = math.atan2(whole[1, 0], whole[0, 0])
    *found, found_yaw = watched.numbers
    assert found == pytest.approx(list(expected[:3]), abs=1e-9)
    if math.hypot(whole[0, 0], whole[1, 0]) > 1e-3:
        assert abs(math.remainder(found_yaw - yaw, 2.0 * math.pi)) < 1e-6


TRANSFORMED = Watched(
    f"{HAND} from camera in tool timeout 1 sec",
    *(f"hand.position.{axis}" for axis in "xyz"),
    "hand.orientation.yaw()",
)
instants = iter(range(1, 10**9))


@given(places, turns)
def test_s78_a_vector_that_is_no_position_is_only_turned(
    force: tuple[float, ...], turn: tuple[float, ...]
) -> None:
    head = Placed("base", "head", (1.0, 2.0, 3.0), turn)
    fields = {f"wrench.force.{a}": v for a, v in zip("xyz", force, strict=True)}
    FORCE.hear(
        next(instants),
        {"/tf (head in base)": transform(head), "/ft": {"header.frame_id": "head", **fields}},
    )
    assert FORCE.numbers == pytest.approx(list(rotation(turn) @ force), abs=1e-9)


FORCE = Watched(
    "input ft = topic /ft : geometry_msgs/WrenchStamped .wrench from head in base timeout 1 sec",
    *(f"ft.force.{axis}" for axis in "xyz"),
)


def test_s79_a_frame_that_does_not_come_is_stale() -> None:
    watched = Watched(f"{HAND} from base in odom timeout 9 sec", "hand.position.x")
    hand = pose("base", (1.0, 0.0, 0.0))
    base = transform(Placed("odom", "base", (1.0, 0.0, 0.0), UPRIGHT))
    watched.hear(1, {"/hand": hand})
    assert watched.propositions == [L]
    watched.hear(2, {"/tf (base in odom)": base})
    assert watched.propositions == [T]
    assert watched.numbers == [2.0]
    watched.advance(1_000_000_001)
    assert watched.propositions == [T]
    watched.advance(1_000_000_002)
    assert watched.propositions == [L]


def test_s80_a_frame_that_stays_is_stale_only_until_it_has_come() -> None:
    watched = Watched(f"{HAND} from camera in head timeout 100000 sec", "hand.position.x")
    watched.hear(1, {"/hand": pose("camera", (1.0, 0.0, 0.0))})
    assert watched.propositions == [L]
    camera = transform(Placed("head", "camera", (1.0, 0.0, 0.0), UPRIGHT))
    watched.hear(2, {"/tf_static (camera in head)": camera})
    assert watched.propositions == [T]
    watched.advance(90_000 * 10**9)
    assert watched.propositions == [T]


def test_s80_what_is_mounted_comes_with_no_message() -> None:
    watched = Watched(f"{HAND} from tool in base timeout 1 sec", "hand.position.z")
    assert [each.topic for each in watched.machine.channels] == ["/hand"]
    watched.hear(1, {"/hand": pose("tool", (1.0, 2.0, 3.0))})
    assert watched.numbers == pytest.approx([float((matrix(TOOL) @ (1.0, 2.0, 3.0, 1.0))[2])])


def test_s79_a_frame_that_moves_may_be_as_old_as_its_timeout() -> None:
    """The reaction of a motion counts with it, and with what it travels fastest meanwhile."""
    motion = """
    input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.2 sec;
    input place = topic /odom : nav_msgs/Odometry .pose.pose from FROM in base timeout 0.2 sec;
    motion drive {
        position : place; speed : speed; brake : 1 m/s^2; acceleration : 0 m/s^2;
        fastest : 2 m/s; latency : 0.1 sec;
    }
    rule r: if stopping(drive) > 1 m then { slow; };
    """
    for frame, reaction_s, is_of_one in (("tool", 0.3, True), ("head", 1.1, False)):
        found = program_of(SYSTEM + motion.replace("FROM", frame)).motions["drive"]
        assert found.reaction_s == pytest.approx(reaction_s)
        assert found.is_of_one_message == is_of_one
