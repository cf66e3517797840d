"""Arrays of messages are lists, whose elements have no arrays."""

from __future__ import annotations

from rossmarie.types import List, Message, MessageCatalog, Quantity, Text, Type, Unsupported, Vector
from rossmarie.units import parse_unit


def at(type_: Type | None, *path: str) -> Type:
    assert type_ is not None
    for name in path:
        assert isinstance(type_, Message)
        type_ = type_.fields[name]
    return type_


def test_arrays_of_messages_are_lists() -> None:
    catalog = MessageCatalog()
    poses = at(catalog.find("nav_msgs/Path"), "poses")
    assert isinstance(poses, List)
    assert isinstance(poses.element, Message)
    assert at(poses.element, "pose", "position") == Vector(Quantity(parse_unit("m")))
    corners = at(catalog.find("geometry_msgs/Polygon"), "points")
    assert corners == List(Vector(Quantity(parse_unit("m"))))


def test_elements_of_lists_have_no_arrays() -> None:
    status = at(MessageCatalog().find("diagnostic_msgs/DiagnosticArray"), "status")
    assert isinstance(status, List)
    assert isinstance(status.element, Message)
    assert at(status.element, "name") == Text()
    values = at(status.element, "values")
    assert isinstance(values, Unsupported)
    assert "in each element of a list" in values.reason
