"""S56 and S57: the points of clouds of any layout, and clouds that contradict themselves."""

from __future__ import annotations

import math
from random import Random
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rossmarie.ir.clouds import UnreadableCloudError, columns, is_cloud
from support.clouds import HUGE, LIES, MOST, READ, plain_cloud, random_cloud, truthful

PLACE = ("x", "y", "z")


def read(cloud: SimpleNamespace, names: tuple[str, ...] = READ) -> list[list[float]] | None:
    try:
        return [each.tolist() for each in columns(cloud, names, MOST)]
    except UnreadableCloudError:
        return None


def same(found: list[list[float]] | None, expected: list[list[float]] | None) -> bool:
    """Bit for bit, but for the bits of a NaN."""
    return repr(found) == repr(expected)


@given(st.integers(0, 2**64))
def test_s56_the_fields_of_any_layout(seed: int) -> None:
    made = random_cloud(Random(seed))
    assert same(read(made.cloud), made.expected())


@pytest.mark.parametrize("lie", LIES)
def test_s56_nothing_is_known_of_a_cloud_that_lies(lie: str) -> None:
    cloud = truthful()
    assert read(cloud) == [[1.0, 2.0, 3.0, 4.0], [0.0] * 4, [0.0] * 4]
    LIES[lie](cloud)
    assert read(cloud) is None


def test_s56_a_cloud_without_points_is_known() -> None:
    for rows, width in ((0, 0), (0, HUGE), (HUGE, 0), (1, 0)):
        cloud = truthful()
        cloud.height, cloud.width, cloud.data = rows, width, b""
        assert read(cloud) == [[], [], []]


def test_s56_a_field_that_is_not_read_may_be_anything() -> None:
    cloud = truthful()
    cloud.fields[3].count = HUGE
    assert read(cloud, PLACE) == [[1.0, 2.0, 3.0, 4.0], [0.0] * 4, [0.0] * 4]


def test_s57_a_point_without_a_place_is_none() -> None:
    nan = math.nan
    points = [{"x": 1.0}, {"x": nan}, {"x": 2.0, "y": nan}, {"z": nan}, {"x": 3.0, "i": nan}]
    cloud = plain_cloud(points, ("x", "y", "z", "i"))
    assert read(cloud, ("x",)) == [[1.0, 3.0]]
    assert same(read(cloud, ("i",)), [[0.0, nan]])


def test_s57_a_cloud_may_have_no_such_axis() -> None:
    cloud = plain_cloud([{"x": 1.0, "range": 2.0}, {"x": math.nan}], ("x", "range"))
    assert read(cloud, ("range",)) == [[2.0]]
    assert read(plain_cloud([{"range": 2.0}], ("range",)), ("range",)) == [[2.0]]


def test_data_may_be_of_any_kind_that_holds_bytes() -> None:
    cloud = truthful()
    for data in (bytearray(cloud.data), memoryview(cloud.data), np.frombuffer(cloud.data, np.int8)):
        cloud.data = data
        assert read(cloud, ("x",)) == [[1.0, 2.0, 3.0, 4.0]]


def test_a_cloud_is_known_by_its_fields() -> None:
    assert is_cloud(truthful())
    assert not is_cloud([truthful()])
    assert not is_cloud({"x": 1.0})
