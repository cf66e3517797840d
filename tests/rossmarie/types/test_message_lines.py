"""Lines of .msg files mean the same to us and to rosbags, except where rosbags differs from ROS."""

from __future__ import annotations

from itertools import product

import pytest
from rosbags.typesys import TypesysError, get_types_from_msg

from rossmarie.types.definitions import DefinedField, MessageDefinition, from_rosbags, normalized
from rossmarie.types.message_lines import read_line

FIELDS = [
    " ".join(parts)
    for parts in product(
        (
            f"{base}{array}"
            for base, array in product(
                ("float64", "string", "wstring", "string<=5", "Header", "time", "a_b/Point", "P"),
                ("", "[]", "[3]", "[<=3]"),
            )
        ),
        ("x", "MAX_1", "x_"),
        ("", "# c", "5", "0.5 # d", "[1, 2]", "text"),
    )
]
CONSTANTS = [
    f"{base} {name}{value}"
    for base, name, value in product(
        ("float64", "uint8", "bool"),
        ("X", "MAX_1"),
        ("=5", " = -0x1F", "=017", "= 1.5e3", "=true", "=5 # c", "=5#c", "=0b101", "=08"),
    )
]
TEXTS = ["string A=hello # w", "string A='hi'", 'string A = "a" # c', "string A=it's"]
BAD = [
    *("float64", "float64[x] a", "float64[ a", "9a x", "A/b x", "float64 _x", "float64 1x", "x=5"),
    *("int8 A=[1,2]", "int8 A=", "P X=5", "float64[] X=5", "uint8 x=5", "@", "float64x"),
]


def ours(line: str) -> MessageDefinition | None:
    """The definition of a message of one line; None if the line is malformed."""
    try:
        found = read_line(line, "pkg")
    except ValueError:
        return None
    if found is None:
        return MessageDefinition({}, {})
    if found.value is not None:
        return MessageDefinition({}, {found.name: found.value})
    return MessageDefinition(
        {found.name: DefinedField(normalized(found.base) or found.base, found.is_array)}, {}
    )


def theirs(line: str) -> MessageDefinition | None:
    try:
        return from_rosbags(get_types_from_msg(line, "pkg/msg/Own"))["pkg/Own"]
    except (TypesysError, AssertionError, ValueError):
        return None


def test_well_formed_lines_are_read_as_rosbags_reads_them() -> None:
    lines = [*FIELDS, *CONSTANTS, *TEXTS, "", "# c", " \t", "@key", "@key float64 x", " int8 x "]
    assert [line for line in lines if ours(line) is None] == []
    assert [(line, ours(line)) for line in lines if ours(line) != theirs(line)] == []


@pytest.mark.parametrize("line", BAD)
def test_malformed_lines_are_refused_as_rosbags_refuses_them(line: str) -> None:
    assert (ours(line), theirs(line)) == (None, None)


@pytest.mark.parametrize(
    ("line", "meant"),
    [
        ("string A=5", MessageDefinition({}, {"A": "5"})),  # rosbags: the number
        ("string A=5 m", MessageDefinition({}, {"A": "5 m"})),  # rosbags: an error
        ("uint8 x = 5", None),  # rosbags: a field
        ("uint8 A=five", None),  # rosbags: a text
        ("uint8 A=1e999", None),
    ],
)
def test_where_rosbags_is_at_fault_ros_counts(line: str, meant: MessageDefinition | None) -> None:
    assert theirs(line) != meant
    assert ours(line) == meant
