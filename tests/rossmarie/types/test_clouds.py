"""The points of clouds: fields of any name, in units that may be declared."""

from __future__ import annotations

from pathlib import Path

from rossmarie.types import (
    List,
    Message,
    MessageCatalog,
    Point,
    Quantity,
    Type,
    Unsupported,
)
from rossmarie.types.ros_messages import UnitOverrides
from rossmarie.units import parse_unit

CLOUD = "sensor_msgs/PointCloud2"


def at(type_: Type | None, *path: str) -> Type:
    for name in path:
        assert isinstance(type_, Message)
        type_ = type_.fields[name]
    assert type_ is not None
    return type_


def point(name: str = CLOUD, *path: str, units: dict[str, str] | None = None) -> Point:
    overrides: UnitOverrides = {
        (CLOUD, tuple(field.split("."))): parse_unit(unit) for field, unit in (units or {}).items()
    }
    points = at(MessageCatalog(unit_overrides=overrides).find(name), *path, "points")
    assert isinstance(points, List)
    assert points.is_of_points
    assert isinstance(points.element, Point)
    return points.element


def test_a_point_has_a_place_in_meters_and_fields_of_any_name() -> None:
    for axis in "xyz":
        assert point().member(axis) == Quantity(parse_unit("m"))
    assert point().member("intensity") == Quantity(None)


def test_units_of_fields_are_declared() -> None:
    found = point(units={"points.doppler": "km/h", "points.range": "cm"})
    assert found.member("doppler") == Quantity(parse_unit("km/h"))
    assert found.member("range") == Quantity(parse_unit("cm"))
    assert found.member("x") == Quantity(parse_unit("m"))


def test_the_place_has_one_unit() -> None:
    for field in ("points", "points.y"):
        found = point(units={field: "mm"})
        assert found.member("x") == Quantity(parse_unit("mm"))


def test_older_clouds_are_lists_of_messages() -> None:
    points = at(MessageCatalog().find("sensor_msgs/PointCloud"), "points")
    assert isinstance(points, List)
    assert not points.is_of_points


def write(folder: Path, name: str, text: str) -> None:
    path = folder / f"{name}.msg"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def test_clouds_in_other_messages_and_in_their_lists(tmp_path: Path) -> None:
    write(tmp_path, "my_msgs/Segment", f"{CLOUD} cloud")
    write(tmp_path, "my_msgs/Segments", f"Segment[] segments\n{CLOUD}[] clouds")
    catalog = MessageCatalog([tmp_path])
    inner = at(catalog.find("my_msgs/Segment"), "cloud", "points")
    assert isinstance(inner, List)
    assert inner.is_of_points
    segments = at(catalog.find("my_msgs/Segments"), "segments")
    assert isinstance(segments, List)
    points = at(segments.element, "cloud", "points")
    assert isinstance(points, Unsupported)
    assert "rules look one level deep" in points.reason


def test_another_message_of_that_name_has_no_points(tmp_path: Path) -> None:
    write(tmp_path, CLOUD, "uint32 width\nuint8[] data")
    message = MessageCatalog([tmp_path]).find(CLOUD)
    assert message is not None
    assert "points" not in message.fields
