"""The memory cost of messages of a type."""

from __future__ import annotations

import pytest
from rosbags.typesys import Stores, TypesysError, get_types_from_msg, get_typestore

from rossmarie.recordings.limits import MOST_ELEMENTS
from rossmarie.recordings.message_sizes import Sizes

ROOT = "a/msg/Root"


def sizes_of(text: str, **parts: str) -> Sizes:
    types = get_types_from_msg(text, ROOT)
    for name, part in parts.items():
        types.update(get_types_from_msg(part, f"a/msg/{name}"))
    return Sizes(types)


@pytest.mark.parametrize(
    ("text", "parts", "reported"),
    [
        ("string[1001] a", {}, "1001 elements"),
        ("Part[1001] a", {"Part": "int8 b"}, "1001 elements"),
        ("Part[] a", {"Part": "int8[0] b"}, "messages without fields"),
        ("Root a", {}, "more than 50 deep"),
        ("Part[1000] a", {"Part": "Small[1000] b", "Small": "int8 c"}, "more than 100000 fields"),
    ],
)
def test_types_beyond_a_limit_are_refused(text: str, parts: dict[str, str], reported: str) -> None:
    with pytest.raises(TypesysError, match=reported):
        sizes_of(text, **parts).check(ROOT)


@pytest.mark.parametrize(
    ("text", "parts", "least"),
    [
        ("Part[] a", {"Part": "float64 b\nint16[3] c\nstring d\nint8[] e"}, 8 + 6 + 4 + 4),
        ("string[] a\nPart[] b", {"Part": "float64 b"}, 4),
        ("Part[2] a", {"Part": "bool b"}, 1),
    ],
)
def test_the_smallest_element_bounds_a_message(
    text: str, parts: dict[str, str], least: int
) -> None:
    assert sizes_of(text, **parts).largest_message(ROOT) == least * MOST_ELEMENTS


@pytest.mark.parametrize("text", ["float64[1000000] a", "uint8[] a", "string a", ""])
def test_a_message_without_arrays_of_parts_may_be_large(text: str) -> None:
    assert sizes_of(text).largest_message(ROOT) is None


@pytest.mark.parametrize("store", list(Stores), ids=lambda store: store.value)
def test_all_standard_messages_are_within_the_limits(store: Stores) -> None:
    defined = get_typestore(store).fielddefs
    sizes = Sizes(defined)
    for name in defined:
        sizes.check(name)


def test_a_large_point_cloud_is_within_the_limits() -> None:
    sizes = Sizes(get_typestore(Stores.ROS2_HUMBLE).fielddefs)
    most = sizes.largest_message("sensor_msgs/msg/PointCloud2")
    assert most is not None
    assert most > 50_000_000
