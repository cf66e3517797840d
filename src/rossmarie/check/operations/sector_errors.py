"""Mistakes in sectors of laser scans, and readings outside any sector."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class NoSectors(Error, code="ROSS271", name="no-sectors"):
    """A sector of a value that is not a scan."""

    title = "`{text}` has no sectors"
    label = "this is {found}"
    note = "only the `ranges` of a sensor_msgs/LaserScan have an angle for each reading"
    text: str
    found: str

    class Ranges(Remark):
        says = "write `{text}.ranges[{sector}]`"
        text: str
        sector: str

    class Points(Remark):
        says = (
            "look at the angle of each point: `any(p in {text}: p.angle in [-30, 30] deg and ...)`"
        )
        text: str


class NoSector(Error, code="ROSS272", name="no-sector"):
    """Two ends without a sector between them."""

    title = "a sector goes from one angle to another"
    label = "{found}"
    note = (
        "a sector goes counter-clockwise; 0 deg is straight ahead of the scanner, 90 deg is to its "
        "left"
    )
    help = "write two angles: `[-30 deg .. 30 deg]`"
    found: str


class LongWay(Warning, code="ROSS273", name="long-way-round"):
    """A sector whose ends were probably exchanged."""

    title = "this sector is {width} deg wide"
    label = "the sector goes counter-clockwise, and so through 180 deg"
    help = "if you mean the sector ahead, exchange its ends: `[{last} .. {first}]`"
    note = "if you mean this sector, let the second angle be the greater angle: `{greater}`"
    width: str
    first: str
    last: str
    greater: str


class RawReadings(Warning, code="ROSS274", name="raw-readings"):
    """Readings of a scan that include invalid distances."""

    title = "`{text}` has readings that are not distances"
    label = "a reading of 0 counts as something at 0 m"
    note = (
        "many lidars report 0 where nothing returns; only the scan itself gives the least valid "
        "distance (`range_min`)"
    )
    text: str

    class Sector(Remark):
        says = (
            "use the distances in a sector: `{text}[-30 deg .. 30 deg]` for those ahead, or "
            "`{text}[-180 deg .. 180 deg]` for a scanner that sees all around"
        )
        text: str

    class Angle(Remark):
        says = (
            "give the angle of the reading: `min({text}[-5 deg .. 5 deg])` for the readings "
            "straight ahead"
        )
        text: str


ALL: tuple[type[Template], ...] = (NoSectors, NoSector, LongWay, RawReadings)
