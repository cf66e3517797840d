"""S77, S78 and S82 for elements of lists: points of scans and of clouds, poses and markers that are
seen from other frames.

The interpreter, the generated C and the generated Python hear the same messages, and say the same.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.engines.python_monitor import PythonMonitor
from rossmarie.interpreter import Interpreter
from rossmarie.native import load_native
from rossmarie.targets.c99 import generate_loadable
from rossmarie.targets.python import source
from support.c_compiler import needs_c
from support.compiled import machine_of
from support.depth import examples
from support.frames import Matrix, Placed, matrix, rotation, turn_of
from support.machines import Monitor, exactly

F, T, _, L = ir.TruthValue
NAN = math.nan
RULES = """
system robot {
    frame base in odom timeout 1 sec;
    frame laser in base;
    frame camera in base at [0.5, -0.25, 1] m turned [10, 20, 30] deg;
}
action slow;
input scan = topic /scan : sensor_msgs/LaserScan .points up to 8 from laser in odom timeout 2 sec;
input cloud = topic /points : sensor_msgs/PointCloud2 .points up to 8 from camera in odom timeout 2 sec;
input people = topic /people : geometry_msgs/PoseArray up to 8 from laser in base timeout 2 sec;
input marks = topic /marks : visualization_msgs/MarkerArray .markers up to 8 from base in odom timeout 2 sec;
input twists = topic /twists : nav_msgs/Odometry .twist.twist from base in odom timeout 2 sec;
zone room in odom { circle [1, 0] m radius 2 m; box [3, 4, -1, 1] m; }
zone front in base { polygon [0, -1], [2, -1], [2, 1], [0, 1] m; }
rule scan_x: if min(p in scan: p.x) > 0 m then { slow; };
rule scan_y: if max(p in scan: p.y) > 0 m then { slow; };
rule scan_z: if min(p in scan: p.z) > 0 m then { slow; };
rule scan_near: if min(p in scan: distance(p, room)) > 0.5 m then { slow; };
rule scan_in: if count(p in scan: p in room) >= 2 then { slow; };
rule cloud_x: if max(p in cloud: p.x) > 0 m then { slow; };
rule cloud_z: if min(p in cloud: p.z) > 0 m then { slow; };
rule cloud_far: if max(p in cloud: norm(p)) > 3 m then { slow; };
rule cloud_in: if any(p in cloud: p in room) then { slow; };
rule people_x: if min(p in people.poses: p.position.x) > 0 m then { slow; };
rule people_yaw: if max(p in people.poses: p.orientation.yaw()) > 0 rad then { slow; };
rule people_in: if all(p in people.poses: p in front) then { slow; };
rule marks_y: if min(m in marks: m.pose.position.y) > 0 m then { slow; };
rule marks_in: if any(m in marks: m.pose in room) then { slow; };
rule beside: if any(p in scan: p.x < 1 sec * twists.linear.x) then { slow; };
"""  # noqa: E501
MACHINE = machine_of(RULES)
CAMERA = Placed("base", "camera", (0.5, -0.25, 1.0), turn_of(*map(math.radians, (10, 20, 30))))
UPRIGHT = (0.0, 0.0, 0.0, 1.0)
BASE, LASER = (
    Placed("odom", "base", (0.0,) * 3, UPRIGHT),
    Placed("base", "laser", (0.0,) * 3, UPRIGHT),
)
Element = Mapping[str, Any]


@dataclass
class Heard:
    """The frames and the messages of one instant. Elements have their fields by their paths."""

    frames: Sequence[Placed] = ()
    lists: Mapping[str, tuple[str, Sequence[Element]]] = field(default_factory=dict)
    speed: tuple[str, float] | None = None

    def channels(self) -> dict[int, ir.ChannelValues]:
        return {
            number: found
            for number, channel in enumerate(MACHINE.channels)
            if (found := self._values(number, channel)) is not None
        }

    def _values(self, number: int, channel: ir.Channel) -> ir.ChannelValues | None:
        slots = [each for each in enumerate(MACHINE.slots) if _is_on(each[1], number)]
        arrays = [each for each in enumerate(MACHINE.arrays) if _is_on(each[1], number)]
        if channel.edge is not None:
            edge = channel.edge.parent, channel.edge.child
            placed = next((each for each in self.frames if (each.parent, each.child) == edge), None)
            if placed is None:
                return None
            return ir.ChannelValues({n: _of_transform(placed, slot.path) for n, slot in slots})
        if channel.topic == "/twists":
            if self.speed is None:
                return None
            frame, speed = self.speed
            return ir.ChannelValues({n: _of_twist(slot, frame, speed) for n, slot in slots})
        if channel.topic not in self.lists:
            return None
        frame, elements = self.lists[channel.topic]
        return ir.ChannelValues(
            {n: _text(frame) for n, _ in slots},
            {n: [_of_element(each, array) for each in elements] for n, array in arrays},
        )


def _is_on(part: ir.Slot | ir.Array, channel: int) -> bool:
    return MACHINE.inputs[part.input].channel == channel


def _of_transform(placed: Placed, path: ir.Path) -> float:
    which, axis = path
    numbers = placed.origin if which == "translation" else placed.turn
    return numbers["xyzw".index(str(axis))]


def _of_twist(slot: ir.Slot, frame: str, speed: float) -> float:
    if slot.kind is ir.FieldKind.TEXT:
        return _text(frame)
    return speed if slot.path[-2:] == ("linear", "x") else 0.0


def _of_element(element: Element, array: ir.Array) -> float:
    name = ".".join(map(str, array.path[array.path.index(ir.EACH) + 1 :]))
    return _text(element[name]) if array.kind is ir.FieldKind.TEXT else element[name]


def _text(text: str) -> float:
    return float(MACHINE.texts.index(text)) if text in MACHINE.texts else -1.0


class Engines:
    """The three engines, side by side."""

    def __init__(self) -> None:
        self.interpreter = Interpreter(MACHINE)
        native = load_native(MACHINE, generate_loadable(MACHINE))
        self._others: list[Monitor] = [PythonMonitor(MACHINE, source(MACHINE)), native]
        self._at_ns = 0

    def hear(self, heard: Heard, after_ns: int = 1) -> None:
        self._at_ns += after_ns
        channels = heard.channels()
        self._all(lambda monitor: monitor.update(self._at_ns, channels))

    def advance(self, after_ns: int) -> None:
        self._at_ns += after_ns
        self._all(lambda monitor: monitor.advance(self._at_ns))

    def _all(self, take: Callable[[Any], Sequence[ir.Event]]) -> None:
        wanted = [exactly(event) for event in take(self.interpreter)]
        for each in self._others:
            assert [exactly(event) for event in take(each)] == wanted
            assert tuple(each.active) == tuple(self.interpreter.active)
            assert each.next_wake() == self.interpreter.next_wake()

    def number(self, rule: str) -> float:
        """The number that a rule looks at."""
        found = next(each for each in MACHINE.rules if each.name == rule)
        return float(self.interpreter._memory.signals[found.signals[0]])

    def proposition(self, rule: str) -> ir.TruthValue | None:
        found = next(each for each in MACHINE.rules if each.name == rule)
        return self.interpreter._memory.truth_values[found.condition]

    def propositions(self, prefix: str) -> set[ir.TruthValue | None]:
        names = [each.name or "" for each in MACHINE.rules]
        return {self.proposition(name) for name in names if name.startswith(prefix)}


@pytest.fixture(scope="module")
def together(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Engines]:
    """One that lives as long as the tests do: what came before is no matter."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield Engines()


@pytest.fixture
def engines(together: Engines) -> Engines:
    """The same, to which all has come long ago."""
    together.advance(10**10)
    return together


# --- messages --------------------------------------------------------------------------------


def beam(distance: float, angle: float) -> Element:
    return {"range": distance, "angle": angle}


def point(x: float, y: float, z: float) -> Element:
    return {"x": x, "y": y, "z": z}


def pose(place: Sequence[float], turn: Sequence[float] = UPRIGHT) -> dict[str, Any]:
    position = {f"position.{a}": v for a, v in zip("xyz", place, strict=True)}
    return position | {f"orientation.{a}": v for a, v in zip("xyzw", turn, strict=True)}


def marker(place: Sequence[float], frame: str = "base") -> Element:
    found = {f"pose.{name}": value for name, value in pose(place).items()}
    return {**found, "header.frame_id": frame}


def scan(*beams: Element, frame: str = "laser") -> dict[str, tuple[str, Sequence[Element]]]:
    return {"/scan": (frame, beams)}


STANDING = Heard((BASE, LASER), speed=("base", 0.0))


# --- against matrices ------------------------------------------------------------------------

lengths = st.floats(-20.0, 20.0)
places = st.tuples(lengths, lengths, lengths)
turns = st.tuples(*[st.floats(-1.0, 1.0)] * 4).filter(lambda each: np.linalg.norm(each) > 0.1)
polar = st.tuples(st.floats(0.1, 20.0), st.floats(-math.pi, math.pi))


def seen(transform: Matrix, points: Sequence[Sequence[float]]) -> Matrix:
    """Points as rows, along a way."""
    found: Matrix = (np.column_stack([points, np.ones(len(points))]) @ transform.T)[:, :3]
    return found


def from_room(points: Matrix) -> Matrix:
    """The distance of each point from the zone `room`, in its plane."""
    x, y = points[:, 0], points[:, 1]
    from_circle = np.hypot(x - 1.0, y) - 2.0
    from_box = np.hypot(np.maximum.reduce([3.0 - x, x - 4.0, 0.0 * x]), np.maximum(abs(y) - 1.0, 0))
    found: Matrix = np.maximum(np.minimum(from_circle, from_box), 0.0)
    return found


@needs_c
@settings(max_examples=examples(20))
@given(
    base=st.tuples(places, turns),
    laser=st.tuples(places, turns),
    beams=st.lists(polar, min_size=1, max_size=8),
    points=st.lists(places, min_size=1, max_size=8),
    poses=st.lists(st.tuples(places, turns), min_size=1, max_size=8),
    speed=st.floats(-3.0, 3.0),
)
def test_s78_points_of_lists_go_the_way_that_matrices_say(
    together: Engines,
    base: tuple[tuple[float, ...], tuple[float, ...]],
    laser: tuple[tuple[float, ...], tuple[float, ...]],
    beams: list[tuple[float, float]],
    points: list[tuple[float, ...]],
    poses: list[tuple[tuple[float, ...], tuple[float, ...]]],
    speed: float,
) -> None:
    frames = (Placed("odom", "base", *base), Placed("base", "laser", *laser))
    up, mounted = map(matrix, frames)
    lists: dict[str, tuple[str, Sequence[Element]]] = {
        "/scan": ("laser", [beam(*each) for each in beams]),
        "/points": ("camera", [point(*each) for each in points]),
        "/people": ("laser", [pose(*each) for each in poses]),
        "/marks": ("", [marker(each) for each in points]),
    }
    together.hear(Heard(frames, lists, ("base", speed)))
    number = together.number
    flat = [(d * math.cos(a), d * math.sin(a), 0.0) for d, a in beams]
    found = seen(up @ mounted, flat)
    gaps = from_room(found)
    assert number("scan_x") == pytest.approx(found[:, 0].min(), abs=1e-9)
    assert number("scan_y") == pytest.approx(found[:, 1].max(), abs=1e-9)
    assert number("scan_z") == pytest.approx(found[:, 2].min(), abs=1e-9)
    assert number("scan_near") == pytest.approx(gaps.min(), abs=1e-9)
    if abs(gaps - 0.0)[gaps > 0].min(initial=1.0) > 1e-9:
        assert number("scan_in") == (gaps == 0).sum()
    in_cloud = seen(up @ matrix(CAMERA), points)
    assert number("cloud_x") == pytest.approx(in_cloud[:, 0].max(), abs=1e-9)
    assert number("cloud_z") == pytest.approx(in_cloud[:, 2].min(), abs=1e-9)
    assert number("cloud_far") == pytest.approx(np.linalg.norm(in_cloud, axis=1).max(), abs=1e-9)
    people = seen(mounted, [place for place, _ in poses])
    assert number("people_x") == pytest.approx(people[:, 0].min(), abs=1e-9)
    turned = [mounted[:3, :3] @ rotation(turn) for _, turn in poses]
    if all(math.hypot(each[0, 0], each[1, 0]) > 1e-3 for each in turned):
        yaws = [math.atan2(each[1, 0], each[0, 0]) for each in turned]
        if max(map(abs, yaws)) < math.pi - 1e-3:  # half a turn is that to the left or to the right
            assert number("people_yaw") == pytest.approx(max(yaws), abs=1e-6)
    assert number("marks_y") == pytest.approx(seen(up, points)[:, 1].min(), abs=1e-9)


# --- by hand ---------------------------------------------------------------------------------


@needs_c
def test_s82_points_that_are_seen_from_another_frame_lie_in_its_zones(engines: Engines) -> None:
    """The robot stands at (5, 0) and looks back: what is 3 m ahead of it is at (2, 0)."""
    half = math.pi / 2
    base = Placed("odom", "base", (5.0, 0.0, 0.0), turn_of(0.0, 0.0, math.pi))
    laser = Placed("base", "laser", (0.5, 0.0, 0.2), turn_of(0.0, 0.0, half))
    for distance, angle, proposition in (
        (2.5, -half, T),
        (2.5, half, F),
        (1.4, -half, T),
        (0.4, -half, F),
    ):
        engines.hear(Heard((base, laser), scan(beam(distance, angle), beam(distance, angle))))
        assert engines.proposition("scan_in") is proposition
    # A point that is not seen through the frames would be in the zone where it is not.
    engines.hear(Heard((base, laser), scan(beam(1.0, 0.0), beam(1.0, 0.0))))
    assert engines.proposition("scan_in") is F


@needs_c
def test_s77_elements_of_another_frame_are_stale(engines: Engines) -> None:
    beams = [beam(1.0, 0.0)]
    engines.hear(Heard((BASE, LASER), scan(*beams), ("base", 0.0)))
    assert L not in engines.propositions("scan")
    for frame in ("camera", "base", "", "laser2"):
        engines.hear(Heard(lists=scan(*beams, frame=frame)))
        assert engines.propositions("scan") == {L}
        assert engines.proposition("beside") is L
        engines.hear(Heard(lists=scan(*beams)))
        assert L not in engines.propositions("scan")


@needs_c
def test_s77_the_header_of_each_element_counts_where_the_message_has_none(
    engines: Engines,
) -> None:
    def hear(*markers: Element) -> set[ir.TruthValue | None]:
        engines.hear(Heard((BASE,), {"/marks": ("", markers)}))
        return {engines.proposition("marks_y"), engines.proposition("marks_in")}

    inside, outside = (1.0, 1.0, 0.0), (9.0, 1.0, 0.0)
    assert hear(marker(inside)) == {T}
    assert hear(marker(outside), marker(outside)) == {T, F}
    assert hear(marker(outside), marker(inside, "odom")) == {L}
    # One that is known to be in the zone decides; the least of all is not known.
    assert hear(marker(inside), marker(inside, "odom")) == {T, L}


@needs_c
def test_s78_without_the_frames_on_the_way_elements_are_stale(engines: Engines) -> None:
    lists = scan(beam(1.0, 0.0))
    engines.hear(Heard((BASE,), lists))  # the laser has come before, and stays
    assert L not in engines.propositions("scan_")
    engines.advance(999_999_999)
    assert L not in engines.propositions("scan_")
    engines.advance(1)
    assert engines.propositions("scan_") == {L}
    engines.hear(Heard(lists=lists))
    assert engines.propositions("scan_") == {L}
    engines.hear(Heard((BASE,)))  # elements are looked at when they come
    assert engines.propositions("scan_") == {L}
    engines.hear(Heard((BASE,), lists))
    assert L not in engines.propositions("scan_")


@needs_c
@pytest.mark.parametrize(
    "base",
    [
        Placed("odom", "base", (NAN, 0.0, 0.0), UPRIGHT),
        Placed("odom", "base", (math.inf, 0.0, 0.0), UPRIGHT),
        Placed("odom", "base", (1.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)),
        Placed("odom", "base", (1.0, 0.0, 0.0), (0.0, 0.0, NAN, 1.0)),
        Placed("odom", "base", (1.0, 0.0, 0.0), (0.0, 0.0, math.inf, 1.0)),
        Placed("odom", "base", (1.0, 0.0, 0.0), (1e200, 0.0, 0.0, 1e200)),
    ],
    ids=str,
)
def test_s78_by_a_frame_that_lies_elements_are_stale(engines: Engines, base: Placed) -> None:
    engines.hear(
        Heard((base, LASER), {**scan(beam(1.0, 0.0)), "/marks": ("", [marker((1, 2, 3))])})
    )
    for rule in ("scan_x", "scan_near", "scan_in", "marks_in"):
        assert engines.proposition(rule) is L, rule


@needs_c
def test_s78_a_turn_of_any_length_is_the_same_turn(engines: Engines) -> None:
    turn = turn_of(0.1, -0.2, 2.0)
    found = []
    for size in (1.0, 3.0, 1e-3, -1.0):
        base = Placed("odom", "base", (1.0, 2.0, 3.0), [size * each for each in turn])
        engines.hear(Heard((base, LASER), scan(beam(2.0, 0.3))))
        found.append([engines.number(f"scan_{axis}") for axis in "xyz"])
    for each in found:
        assert each == pytest.approx(found[0], abs=1e-12)


@needs_c
def test_s78_what_is_too_close_stays_unknown(engines: Engines) -> None:
    engines.hear(Heard((BASE, LASER), scan(beam(1.0, 0.0), beam(NAN, 1.0))))
    assert engines.proposition("scan_x") is L
    assert engines.proposition("scan_in") is L
