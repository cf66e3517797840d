"""Measure conditions about places in a scene, with few and with many polygons, and conditions about
points in a zone; write the tables as a page.
"""

from __future__ import annotations

import json
import math
import tempfile
import time
from collections.abc import Iterator, Sequence
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from in_process import Round
from machine import processor
from operators import ROUNDS, SAMPLES, built, machine, nanoseconds
from skill_rules import SKILLS
from written_page import written_page

COUNTS = (1, 10, 100)
CORNERS = 6
SIDE_M = 4.0
"""The width of the cells of a grid of polygons (m). A robot drives across the whole grid."""

NEAR_M = 0.47
CONDITIONS = {"in": "place in Zone", "distance": f"distance(place, Zone) < {NEAR_M} m"}
REFERENCE = "place.x > 5 m"
_RULES = """
skills "skills.json";
action react;
input place = topic /place : geometry_msgs/PointStamped .point;
rule r: if {condition} then {{ react; }};
"""
_HARNESS = """
#include <stdlib.h>
#include "{name}_monitor.h"

void drive(size_t n, const int64_t *t, const double *x, const double *y, uint64_t *active)
{{
    static {name}_monitor m;
    if ({name}_init(&m, NULL, NULL))
        abort();
    *active = 0;
    for (size_t i = 0; i < n; i++) {{
        {name}_update_place(&m, t[i], {arguments});
        *active += {name}_is_active(&m, 0);
    }}
}}
"""
_DECLARATION = "void drive(size_t, int64_t *, double *, double *, uint64_t *);"

Polygon = Sequence[tuple[float, float]]


def polygons(count: int) -> list[Polygon]:
    """Hexagons (m), one in each cell of a grid."""
    columns = math.ceil(math.sqrt(count))
    turns = [2 * math.pi * number / CORNERS for number in range(CORNERS)]
    middles = ((SIDE_M * (each % columns), SIDE_M * (each // columns)) for each in range(count))
    return [
        [(x + 1.5 * math.cos(turn), y + 1.5 * math.sin(turn)) for turn in turns] for x, y in middles
    ]


def path(count: int) -> tuple[np.ndarray, np.ndarray]:
    """The path of the robot: x and y (m) of a curve through all cells."""
    width = SIDE_M * math.ceil(math.sqrt(count))
    phase = np.linspace(0.0, 40 * math.pi, SAMPLES)
    x = width / 2 * (1 + np.cos(phase * 1.3)) - SIDE_M / 2
    y = width / 2 * (1 + np.sin(phase)) - SIDE_M / 2
    return x, y


def write_scene(folder: Path, count: int) -> None:
    """Write a skills file whose scene has `count` polygons."""
    zone: dict[str, Any] = {"name": "hall.Zone", "parents": [], "place": None}
    locations = [
        {"iri": f"http://example.org/hall#Zone-{number}", "label": None, "classes": ["hall.Zone"],
         "frame": "map", "corners": [list(corner) for corner in each], "place": None}
        for number, each in enumerate(polygons(count))
    ]  # fmt: skip
    found = {**SKILLS, "classes": [zone], "locations": locations}
    (folder / "skills.json").write_text(json.dumps(found), encoding="utf-8")


def in_c(folder: Path, code: str, condition: str, count: int) -> Round:
    """The generated update with the place of each sample."""
    write_scene(folder, count)
    compiled = machine(folder, code, _RULES.format(condition=condition))
    given = {"x": "x[i]", "y": "y[i]"}
    arguments = ", ".join(given.get(str(slot.path[-1]), "0.0") for slot in compiled.slots)
    harness = _HARNESS.format(name=compiled.name, arguments=arguments)
    library, ffi = built(folder, compiled, harness, _DECLARATION)
    times = np.arange(SAMPLES, dtype=np.int64) * 10_000_000
    pointers = [ffi.from_buffer("int64_t[]", times)]
    pointers += [ffi.from_buffer("double[]", each) for each in path(count)]
    active = ffi.new("uint64_t *")

    def run() -> tuple[float, list[int]]:
        start = time.process_time()
        library.drive(SAMPLES, *pointers, active)
        return time.process_time() - start, [active[0]]

    return run


def by_shapely(code: str, count: int) -> Round:
    """Shapely with a tree of rectangles over the polygons, in one call for all samples."""
    tree = shapely.STRtree([shapely.Polygon(each) for each in polygons(count)])
    points = shapely.points(*path(count))

    def run() -> tuple[float, list[int]]:
        start = time.process_time()
        if code == "in":
            found = tree.query(points, predicate="intersects")[0]
        else:
            found = tree.query(points, predicate="dwithin", distance=NEAR_M)[0]
        took = time.process_time() - start
        return took, [len(np.unique(found))]

    return run


def rows(folder: Path) -> Iterator[str]:
    """A row for each condition and number of polygons."""
    contenders = {"reference": in_c(folder, "reference", REFERENCE, 1)}
    for count in COUNTS:
        for code, condition in CONDITIONS.items():
            ours, peer = in_c(folder, f"{code}_{count}", condition, count), by_shapely(code, count)
            assert ours()[1] == peer()[1], "both find the same places"
            contenders |= {f"{code} {count}": ours, f"{code} {count} shapely": peer}
    found = nanoseconds({name: (run, SAMPLES) for name, run in contenders.items()})
    base_ns = found["reference"]
    yield f"| `{REFERENCE}` | | {base_ns:.1f} | 1.0 | |"
    for count in COUNTS:
        for code, condition in CONDITIONS.items():
            ours, peer = found[f"{code} {count}"], found[f"{code} {count} shapely"]
            yield f"| `{condition}` | {count} | {ours:.1f} | {ours / base_ns:.1f} | {peer:.0f} |"


# --- zones -----------------------------------------------------------------------------------

EDGES = 100
POINTS = 720
LISTS = 500
_POINTS = f"input points = topic /points : geometry_msgs/PoseArray .poses up to {POINTS};"
IN_ZONE = {
    "in": "count(p in points: p in zoned) > 3",
    "distance": f"min(p in points: distance(p, zoned)) < {NEAR_M} m",
}
OUTLINES = {"circle": 1.0, "star": 2.0}
"""The distance of every other corner from the center, relative to the corners between them."""
_LIST_HARNESS = """
#include <stdlib.h>
#include "{name}_monitor.h"

void lists(size_t n, const double *x, const double *y, uint64_t *active)
{{
    static {name}_monitor m;
    if ({name}_init(&m, NULL, NULL))
        abort();
    *active = 0;
    for (size_t i = 0; i < n; i++) {{
        {name}_update_points(&m, (int64_t)i, 0, x + {points} * i, y + {points} * i, {points});
        *active += {name}_is_active(&m, 0);
    }}
}}
"""


def outline(share: float) -> Polygon:
    """The corners of a polygon around (0, 0) (m); every other corner has the distance `share`."""
    turns = [2 * math.pi * number / EDGES for number in range(EDGES)]
    radii = [share if number % 2 else 1.0 for number in range(EDGES)]
    return [(r * math.cos(turn), r * math.sin(turn)) for r, turn in zip(radii, turns, strict=True)]


def points(share: float) -> np.ndarray:
    """Points in the square around a polygon (m), so that the monitor has to visit its edges."""
    return np.random.default_rng(1).uniform(-share, share, (2, LISTS * POINTS))


def list_in_c(folder: Path, code: str, condition: str, share: float) -> Round:
    """The generated update with a list of points."""
    corners = ", ".join(f"[{x!r}, {y!r}]" for x, y in outline(share))
    zoned = f"zone zoned in base_link {{ polygon {corners} m; }}"
    rule = f"rule r: if {condition} then {{ react; }};"
    compiled = machine(folder, code, "\n".join(["action react;", _POINTS, zoned, rule, ""]))
    harness = _LIST_HARNESS.format(name=compiled.name, points=POINTS)
    declaration = "void lists(size_t, double *, double *, uint64_t *);"
    library, ffi = built(folder, compiled, harness, declaration)
    pointers = [ffi.from_buffer("double[]", each.copy()) for each in points(share)]
    active = ffi.new("uint64_t *")

    def run() -> tuple[float, list[int]]:
        start = time.process_time()
        library.lists(LISTS, *pointers, active)
        return time.process_time() - start, [active[0]]

    return run


def list_by_shapely(code: str, share: float) -> Round:
    """Shapely with a prepared polygon, in one call for all points of a list."""
    polygon = shapely.Polygon(outline(share))
    shapely.prepare(polygon)
    lists = [shapely.points(each.T) for each in np.split(points(share), LISTS, axis=1)]

    def run() -> tuple[float, list[int]]:
        start = time.process_time()
        if code == "in":
            found = [np.count_nonzero(shapely.intersects(polygon, each)) > 3 for each in lists]
        else:
            found = [shapely.distance(polygon, each).min() < NEAR_M for each in lists]
        return time.process_time() - start, [sum(found)]

    return run


def zone_rows(folder: Path) -> Iterator[str]:
    """A row for each condition and polygon."""
    contenders: dict[str, Round] = {}
    for outlined, share in OUTLINES.items():
        for code, condition in IN_ZONE.items():
            ours = list_in_c(folder, f"{outlined}_{code}", condition, share)
            peer = list_by_shapely(code, share)
            assert ours()[1] == peer()[1], "both find the same places"
            contenders |= {f"{outlined} {code}": ours, f"{outlined} {code} shapely": peer}
    found = nanoseconds({name: (run, LISTS) for name, run in contenders.items()})
    for outlined in OUTLINES:
        for code, condition in IN_ZONE.items():
            ours, peer = found[f"{outlined} {code}"], found[f"{outlined} {code} shapely"]
            yield f"| `{condition}` | {outlined} | {ours / 1e3:.1f} | {peer / 1e3:.0f} |"


PREFACE = """\
# Cost of conditions about places

Written by `benchmarks/places.py`; do not edit. Each condition is the only condition of a rule. The
class `Zone` has the given number of individuals in the scene, each with a polygon of
{corners} corners. A robot drives across all polygons: {samples:,} places at 100 Hz. All figures
are CPU times from one run on one machine ({processor}, {day}),
the medians of {rounds} rounds. Absolute figures hold for this machine only.

[Shapely](https://shapely.readthedocs.io) {shapely} searches a tree of rectangles,
for all places in one call. Shapely gives the same answer for every place.

| condition | polygons | C99: ns per sample | ratio to a comparison | Shapely: ns per place |
|---|---|---|---|---|"""
ZONES = """
## Zones

A list has {points} points, as many as a scan. A zone is a polygon of {edges} edges: a circle, or a
star. Every other corner of the star is twice as far from the center as the corners beside it. All
points lie in the square around the polygon. The time of C99 is the time of one message. The time of
Shapely is the time of one call for all points, with a prepared polygon.

| condition | polygon | C99: µs per list | Shapely: µs per list |
|---|---|---|---|"""


def page() -> str:
    """The text of the page."""
    with tempfile.TemporaryDirectory() as folder:
        found, zoned = list(rows(Path(folder))), list(zone_rows(Path(folder)))
    preface = PREFACE.format(
        corners=CORNERS,
        samples=SAMPLES,
        processor=processor(),
        day=datetime.now(timezone.utc).date(),
        rounds=ROUNDS,
        shapely=shapely.__version__,
    )
    zones = ZONES.format(points=POINTS, edges=EDGES)
    return "\n".join([preface, *found, zones, *zoned, ""])


def main() -> None:
    """Measure and write the page."""
    written_page(__doc__).write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
