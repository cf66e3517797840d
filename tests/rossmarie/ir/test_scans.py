"""S70 to S73: sectors, points and invalid beams of scans, and scans that contradict themselves."""

from __future__ import annotations

import math
from functools import cache
from random import Random
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rossmarie.check.operations.sectors import sector_between
from rossmarie.core import Function
from rossmarie.interpreter import Interpreter
from rossmarie.interpreter.arithmetic import apply
from rossmarie.ir import INVALID, RETURNS, Beams, ChannelValues, Machine, Sector
from rossmarie.ir.scans import UnreadableScanError, beams, is_scan, sector
from support.compiled import machine_of
from support.scans import HIGH, LIES, LOW, plain_scan, random_scan, truthful

INF, NAN = math.inf, math.nan


def between(first: float, last: float) -> Sector:
    found = sector_between(math.radians(first), math.radians(last))
    assert found is not None
    return found


def readings(scan: SimpleNamespace, first: float, last: float) -> list[float] | None:
    try:
        return list(map(float, sector(scan, between(first, last))))
    except UnreadableScanError:
        return None


def columns(
    scan: SimpleNamespace, kind: Beams, *fields: str, most: int = 720
) -> list[list[float]] | None:
    try:
        return [beams(scan, kind, field, most).tolist() for field in fields]
    except UnreadableScanError:
        return None


def same(found: object, expected: object) -> bool:
    """Bit for bit, but for the bits of a NaN."""
    return repr(found) == repr(expected)


# --- S70: scans that lie ---------------------------------------------------------------------


@pytest.mark.parametrize("lie", LIES)
def test_s70_nothing_is_known_of_a_scan_that_lies(lie: str) -> None:
    scan = truthful()
    assert readings(scan, -180, -90) is not None
    assert columns(scan, RETURNS, "range") == [[1.5]]
    assert columns(scan, INVALID, "angle") == [[]]
    LIES[lie](scan)
    assert readings(scan, -180, -90) is None
    assert columns(scan, RETURNS, "range") is None
    assert columns(scan, INVALID, "angle") is None


@pytest.mark.parametrize("beams_more", [-1, 1])
def test_s70_drivers_may_be_off_by_one_beam(beams_more: int) -> None:
    scan = truthful()
    scan.angle_max += beams_more * scan.angle_increment
    assert columns(scan, RETURNS, "range") == [[1.5]]


def test_s70_no_greatest_distance_is_infinite() -> None:
    scan = plain_scan([900.0, INF, 0.0, NAN], -2)
    scan.range_max = INF
    assert readings(scan, -2, 1) == [900.0, INF]


# --- S71: sectors ----------------------------------------------------------------------------


@given(st.integers(0, 2**64), st.integers(-360, 360), st.integers(1, 360))
def test_s71_a_sector_by_whole_degrees(seed: int, low: int, width: int) -> None:
    made = random_scan(Random(seed))
    found = readings(made.scan, low + 0.5, low + width + 0.5)
    assert same(found, made.expected(low, low + width))


def test_s71_both_ends_belong_to_it() -> None:
    scan = plain_scan([1.0, 2.0, 3.0, 4.0, 5.0], -2)
    assert readings(scan, -1, 1) == [2.0, 3.0, 4.0]
    assert readings(scan, -2, 2) == [1.0, 2.0, 3.0, 4.0, 5.0]


@pytest.mark.parametrize(("first", "count"), [(-180, 360), (-180, 361), (0, 360), (0, 361)])
def test_s71_a_full_turn_has_all_beams(first: int, count: int) -> None:
    scan = plain_scan([float(beam + 1) / 64 + 1 for beam in range(count)], first)
    assert readings(scan, -180, 180) == scan.ranges
    assert readings(scan, 0, 360) == scan.ranges


def test_s71_a_sector_passes_through_half_a_turn() -> None:
    scan = plain_scan([float(abs(beam - 180) / 64 + 1) for beam in range(360)], 0)
    found = readings(scan, 150, 210)
    assert found == [float(abs(beam) / 64 + 1) for beam in range(-30, 31)]
    assert readings(scan, -210, -150) == readings(scan, 150, -150) == found


def test_s71_what_a_reading_says() -> None:
    scan = plain_scan([LOW, HIGH, HIGH + 1, INF, -INF, NAN, 0.0, LOW / 2, -3.0], 0)
    assert readings(scan, 0, 8) == [LOW, HIGH, INF, INF, -INF]


def test_s71_a_sector_that_tells_nothing_is_not_known() -> None:
    scan = plain_scan([1.0, 0.0, 0.0, 0.0, 1.0], -2)
    assert readings(scan, -1, 1) is None
    assert readings(scan, -1, 2) == [1.0]


@pytest.mark.parametrize(("first", "last"), [(-92, 0), (0, 92), (-180, 180), (170, 190)])
def test_s71_a_scan_has_to_reach_over_the_sector(first: int, last: int) -> None:
    scan = plain_scan([1.0] * 181, -90)
    assert readings(scan, first, last) is None
    assert readings(scan, -91, 91) == [1.0] * 181  # to within one increment


def test_s71_a_scanner_that_is_upside_down() -> None:
    scan = plain_scan([1.0, 2.0, 3.0, 4.0, 5.0], 2, -1)
    assert readings(scan, 0, 2) == [1.0, 2.0, 3.0]


# --- S72 and S73: points, and beams that tell nothing ----------------------------------------


def test_s72_points_are_the_beams_that_return() -> None:
    scan = plain_scan([LOW, HIGH + 1, INF, NAN, 0.0, 2.0], 0)
    found = columns(scan, RETURNS, "range", "intensity")
    assert found == [[LOW, 2.0], [0.0, 50.0]]


def test_s72_what_is_too_close_is_a_point_of_unknown_distance() -> None:
    scan = plain_scan([-INF, 1.0], 30)
    found = columns(scan, RETURNS, "range", "angle")
    assert found is not None
    assert same(found[0], [NAN, 1.0])
    assert found[1] == pytest.approx([math.radians(30), math.radians(31)])


def test_s72_angles_are_within_half_a_turn() -> None:
    found = columns(plain_scan([1.0] * 360, 0), RETURNS, "angle")
    assert found is not None
    assert all(-math.pi <= angle < math.pi for angle in found[0])
    assert found[0][270] == pytest.approx(math.radians(-90), abs=1e-4)


def test_s72_a_scan_of_more_beams_than_the_bound_is_not_known() -> None:
    scan = plain_scan([1.0, INF, INF], 0)
    assert columns(scan, RETURNS, "range", most=3) == [[1.0]]
    assert columns(scan, RETURNS, "range", most=2) is None


def test_s72_intensities_are_one_for_each_beam() -> None:
    scan = plain_scan([1.0, 2.0], 0)
    scan.intensities = [1.0]
    assert columns(scan, RETURNS, "intensity") is None
    assert columns(scan, RETURNS, "range") == [[1.0, 2.0]]


@cache
def places() -> Machine:
    return machine_of(
        """
        action stop;
        input scan = topic /scan : sensor_msgs/LaserScan up to 9;
        rule x: if max(p in scan.points: p.x) > 1 m then { stop; };
        rule y: if max(p in scan.points: p.y) > 1 m then { stop; };
        rule z: if max(p in scan.points: p.z) > 1 m then { stop; };
        """
    )


@given(st.floats(-math.pi, math.pi), st.floats(0.0, 30.0))
def test_s72_x_and_y_are_computed_in_the_machine(angle: float, distance: float) -> None:
    machine = places()
    columns = {"range": [distance], "angle": [angle]}
    arrays = {index: columns[str(each.path[-1])] for index, each in enumerate(machine.arrays)}
    interpreter = Interpreter(machine)
    interpreter.update(0, {0: ChannelValues({}, arrays)})
    found = [interpreter.signals[rule.signals[0]] for rule in machine.rules]
    waves = [apply(each, (angle,)) for each in (Function.COSINE, Function.SINE)]
    assert found == [distance * waves[0], distance * waves[1], 0.0]
    assert math.hypot(*found) == pytest.approx(distance)


def test_s73_invalid_are_the_beams_that_are_left_out() -> None:
    scan = plain_scan([LOW, HIGH, HIGH + 1, INF, -INF, NAN, 0.0, LOW / 2, -3.0], 0)
    found = columns(scan, INVALID, "angle")
    assert found is not None
    assert found[0] == pytest.approx([math.radians(beam) for beam in (5, 6, 7, 8)])


@given(st.integers(0, 2**64))
def test_s73_each_beam_is_of_one_kind(seed: int) -> None:
    scan = random_scan(Random(seed)).scan
    points, invalid = columns(scan, RETURNS, "angle"), columns(scan, INVALID, "angle")
    assert points is not None
    assert invalid is not None
    nothing = sum(reading > HIGH for reading in scan.ranges)
    assert len(points[0]) + len(invalid[0]) + nothing == len(scan.ranges)


def test_a_scan_is_reported_by_its_fields() -> None:
    assert is_scan(truthful())
    assert not is_scan({"ranges": []})
