"""Locations of individuals in a skills file, and places in sources."""

from __future__ import annotations

from rossmarie.skills.json_reader import Json
from rossmarie.skills.model import Location, SourcePlace

FARTHEST = 1e6
"""The greatest coordinate of a location in m."""
MOST_CORNERS = 1000
"""The most corners of a polygon."""
_SIDES = 2
"""Corners that are neither a point nor a polygon."""


def location(item: Json) -> Location:
    """A location in the scene. Raises `UnreadableJson`."""
    corners = item.get("corners")
    found = corners.each(_corner)
    if len(found) == _SIDES or len(found) > MOST_CORNERS:
        corners.fail(f"are {len(found)}, which is neither a point nor a polygon")
    return Location(
        iri=item.get("iri").text(),
        label=item.get("label").optional(Json.text) or "",
        classes=item.get("classes").texts(),
        frame=item.get("frame").optional(Json.text) or "",
        corners=found,
        place=place_of(item),
    )


def _corner(item: Json) -> tuple[float, float]:
    numbers = item.each(Json.number)
    if len(numbers) != _SIDES or not all(abs(each) <= FARTHEST for each in numbers):
        item.fail(f"is not x and y up to {FARTHEST:.0f} m")
    return numbers[0], numbers[1]


def place_of(item: Json) -> SourcePlace | None:
    """The place of a source text; None if it is in no file. Raises `UnreadableJson`."""
    return item.get("place").optional(_place)


def _place(item: Json) -> SourcePlace:
    return SourcePlace(
        item.get("path").text(),
        item.get("line").whole(),
        item.get("column").whole(),
        item.get("end_line").whole(),
        item.get("end_column").whole(),
    )
