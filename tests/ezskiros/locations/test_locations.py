"""The locations of individuals in scenes: boxes, polygons, points, and invalid values."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from ezskiros.check.scenes import check_scene
from ezskiros.locations import FoundLocations, find_locations
from ezskiros.locations.box import footprint
from ezskiros.locations.location import NoPolygonError
from ezskiros.locations.polygon import MOST_CORNERS, corners_of
from ezskiros.ontology import Ontology, load
from ezskiros.ontology.read import read
from support import command_line
from support.effort import takes_at_most
from support.skills import ONTOLOGY

PREFIXES = """\
@prefix geo: <http://www.opengis.net/ont/geosparql#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
"""
FRAME = 'skiros:BaseFrameId "map"'
AT = "skiros:PositionX 1.0 ; skiros:PositionY 2.0"
SIZED = f"{AT} ; skiros:SizeX 4.0 ; skiros:SizeY 2.0"


@pytest.fixture(scope="module")
def ontology() -> Ontology:
    return load(ONTOLOGY)


def found(said: str, folder: Path, ontology: Ontology) -> FoundLocations:
    scene = folder / "lab.turtle"
    scene.write_text(f"{PREFIXES}\nskiros:Location-1 a skiros:Location ; {said} .\n")
    document, wrong = read(scene)
    assert document is not None, wrong
    return find_locations(document, ontology.model)


def area(corners: tuple[tuple[float, float], ...]) -> float:
    """Positive where the corners go around anticlockwise."""
    pairs = zip(corners, (*corners[1:], corners[0]), strict=True)
    return sum(x * v - u * y for (x, y), (u, v) in pairs) / 2


# --- what there is ----------------------------------------------------------------------------


def test_a_polygon_goes_around_anticlockwise(tmp_path: Path, ontology: Ontology) -> None:
    said = f'{FRAME} ; rdfs:label "corridor" ; geo:asWKT "POLYGON ((0 0, 0 2, 9 2, 9 0, 0 0))"'
    (location,) = found(said, tmp_path, ontology).locations
    assert location.frame == "map"
    assert location.label == "corridor"
    assert area(location.corners) == 18
    assert set(location.corners) == {(0, 0), (0, 2), (9, 2), (9, 0)}
    assert location.span.text == "skiros:Location-1"


def test_a_position_is_a_point_and_with_a_size_a_box(tmp_path: Path, ontology: Ontology) -> None:
    (point,) = found(f"{FRAME} ; {AT}", tmp_path, ontology).locations
    assert point.corners == ((1.0, 2.0),)
    (box,) = found(f"{FRAME} ; {SIZED}", tmp_path, ontology).locations
    assert set(box.corners) == {(-1, 1), (3, 1), (3, 3), (-1, 3)}
    assert area(box.corners) == 8


def test_a_location_that_is_nowhere_is_known_to_be(tmp_path: Path, ontology: Ontology) -> None:
    for said in (f"{FRAME} ; rdfs:label 'x'", "skiros:PositionX 1.0"):
        (location,) = found(said, tmp_path, ontology).locations
        assert location.corners == ()
        assert location.frame == ""


def test_classes_of_a_scene_are_not_somewhere(tmp_path: Path, ontology: Ontology) -> None:
    assert not found(f"a owl:Class ; {FRAME} ; {AT}", tmp_path, ontology).locations


@given(
    st.tuples(st.floats(-100, 100), st.floats(-100, 100)),
    st.floats(-math.pi, math.pi),
    st.tuples(st.floats(0.01, 50), st.floats(0.01, 50), st.floats(0, 5)),
)
def test_a_box_that_is_turned_is_that_of_shapely(
    position: tuple[float, float], yaw: float, size: tuple[float, float, float]
) -> None:
    corners = footprint(position, (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)), size)
    x, y = size[0] / 2, size[1] / 2
    upright = shapely.box(position[0] - x, position[1] - y, position[0] + x, position[1] + y)
    turned = shapely.affinity.rotate(upright, yaw, use_radians=True)
    assert shapely.Polygon(corners).hausdorff_distance(turned) < 1e-9
    assert area(corners) == pytest.approx(size[0] * size[1])


def test_a_box_that_lies_on_its_side_casts_another_shadow() -> None:
    half = math.sqrt(0.5)
    corners = footprint((0.0, 0.0), (0.0, half, 0.0, half), (4.0, 2.0, 1.0))
    assert area(corners) == pytest.approx(2.0 * 1.0)


@given(
    st.lists(st.floats(0.5, 20), min_size=3, max_size=12),
    st.tuples(st.floats(-50, 50), st.floats(-50, 50)),
    st.booleans(),
)
def test_a_star_keeps_its_corners(
    radii: list[float], middle: tuple[float, float], clockwise: bool
) -> None:
    turns = [2 * math.pi * number / len(radii) for number in range(len(radii))]
    star = [
        (middle[0] + radius * math.cos(turn), middle[1] + radius * math.sin(turn))
        for radius, turn in zip(radii, turns, strict=True)
    ]
    ordered = star[::-1] if clockwise else star
    text = ", ".join(f"{x!r} {y!r}" for x, y in (*ordered, ordered[0]))
    corners = corners_of(f"POLYGON (({text}))")
    assert set(corners) == set(star)
    assert area(corners) == pytest.approx(area(tuple(star)))


# --- what there is not ------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("POLYGON ((0 0, 2 2, 2 0, 0 2, 0 0))", "crosses or touches itself at (1, 1)"),
        ("POLYGON ((0 0, 2 0, 2 2, 1 0, 0 2, 0 0))", "crosses or touches itself at (1, 0)"),
        ("POLYGON ((0 0, 1 0, 2 0, 0 0))", "crosses or touches itself at (1, 0)"),
        ("POLYGON ((0 0, 4 0, 4 4, 0 0), (2 1, 3 1, 3 2, 2 1))", "has a hole"),
        ("POLYGON ((0 0, 1 0, 1 1))", "is not well-known text: Points of LinearRing"),
        ("POLYGON ((0 0, 1 0", "is not well-known text"),
        ("", "does not begin with POLYGON"),
        ("POLYGON EMPTY", "is empty"),
        ("POINT (1 2)", "does not begin with POLYGON"),
        ("MULTIPOLYGON (((0 0, 1 0, 1 1, 0 0)))", "does not begin with POLYGON"),
        pytest.param("GEOMETRYCOLLECTION (" * 100_000, "does not begin with POLYGON", id="deep"),
        pytest.param("POLYGON (" * 100_000, "is not well-known text", id="deep polygon"),
        ("POLYGON Z ((0 0 1, 1 0 1, 1 1 1, 0 0 1))", "has heights"),
        ("POLYGON ((0 0, 1 nan, 1 1, 0 0))", "has a coordinate that is not a number"),
        ("POLYGON ((0 0, 1e400 1, 1 1, 0 0))", "has a coordinate that is not a number"),
        ("POLYGON ((0 0, 2e6 1, 1 1, 0 0))", "up to 1000000 m"),
        ("<http://x.org/1> POLYGON ((0 0, 1 0, 1 1, 0 0))", "names a coordinate system"),
    ],
)
def test_no_polygon(text: str, reason: str, tmp_path: Path, ontology: Ontology) -> None:
    seen = found(f'{FRAME} ; geo:asWKT "{text}"', tmp_path, ontology)
    (wrong,) = seen.diagnostics
    assert wrong.code == "EZS610"
    assert reason in wrong.title
    assert wrong.primary.span.text == "geo:asWKT"
    assert [each.corners for each in seen.locations] == [()]


def test_too_many_corners_are_refused_at_once() -> None:
    turns = [2 * math.pi * number / 200_000 for number in range(200_000)]
    around = ", ".join(f"{math.cos(turn)} {math.sin(turn)}" for turn in [*turns, 0.0])
    with pytest.raises(NoPolygonError, match=f"200000 corners; at most {MOST_CORNERS}"):
        corners_of(f"POLYGON (({around}))")


@pytest.mark.parametrize(
    ("said", "code", "title"),
    [
        (f"{FRAME} ; skiros:PositionX 1.0", "EZS611", "skiros:PositionX but no skiros:PositionY"),
        (f"{FRAME} ; {AT} ; skiros:SizeY 1.0", "EZS611", "skiros:SizeY but no skiros:SizeX"),
        (AT, "EZS611", "skiros:PositionX but no skiros:BaseFrameId"),
        (f'skiros:BaseFrameId "" ; {AT}', "EZS611", "but no skiros:BaseFrameId"),
        ('geo:asWKT "POLYGON ((0 0, 1 0, 1 1, 0 0))"', "EZS611", "geo:asWKT but no skiros:Base"),
        (f"{FRAME} ; {SIZED} ; skiros:OrientationZ 1.0", "EZS611", "but no skiros:OrientationX"),
        (f"{FRAME} ; {AT}, 3.0", "EZS612", "skiros:PositionY of skiros:Location-1 has several"),
        (f"{FRAME} ; {AT.replace('1.0', 'true')}", "EZS612", "PositionX of skiros:Location-1 is t"),
        (f"{FRAME} ; {AT.replace('1.0', '1e7')}", "EZS612", "is 1e7, not a number up to 1000000"),
        (f"{FRAME} ; {SIZED.replace('4.0', '0.0')}", "EZS612", "SizeX of skiros:Location-1 is 0;"),
        (f"{FRAME} ; {SIZED} ; skiros:SizeZ -1.0", "EZS612", "SizeZ of skiros:Location-1 is -1;"),
        (
            f"{FRAME} ; {SIZED} ; skiros:OrientationX 0.0 ; skiros:OrientationY 0.0 ;"
            " skiros:OrientationZ 0.0 ; skiros:OrientationW 0.0",
            "EZS612",
            "is not part of a quaternion of length 1",
        ),
    ],
)
def test_half_a_place_is_none(
    said: str, code: str, title: str, tmp_path: Path, ontology: Ontology
) -> None:
    seen = found(said, tmp_path, ontology)
    (wrong,) = seen.diagnostics
    assert wrong.code == code
    assert title in wrong.title
    assert [each.corners for each in seen.locations] == [()]


# --- the skills file -----------------------------------------------------------------------


def test_a_scene_is_exported_with_its_classes_and_as_a_source(tmp_path: Path) -> None:
    scene = tmp_path / "lab.turtle"
    scene.write_text(
        f"{PREFIXES}\nskiros:Container-2 a skiros:Container ; {FRAME} ; {AT} .\n"
        f'skiros:Location-1 a skiros:Location ; rdfs:label "desk" ; {FRAME} ; {SIZED} .\n'
    )
    done = command_line.run(
        "ezskiros", "export", "lab.turtle", "--ontology", str(ONTOLOGY), "-o", "skills.json",
        folder=tmp_path,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    file = json.loads((tmp_path / "skills.json").read_text())
    container, desk = file["locations"]
    assert container["corners"] == [[1, 2]]
    assert container["classes"] == ["skiros.Container"]
    assert desk["label"] == "desk"
    assert len(desk["corners"]) == 4
    assert desk["place"]["line"] == 7
    assert {"skiros.Container", "skiros.Location", "sumo.Object"} == {
        each["name"] for each in file["classes"]
    }
    assert "lab.turtle" in [each["path"] for each in file["sources"]]


def test_a_wrong_scene_is_not_exported(tmp_path: Path) -> None:
    scene = tmp_path / "lab.turtle"
    scene.write_text(f"{PREFIXES}\nskiros:Location-1 a skiros:Location ; {AT}, 3.0 .\n")
    done = command_line.run(
        "ezskiros", "export", "lab.turtle", "--ontology", str(ONTOLOGY), "-o", "skills.json",
        folder=tmp_path,
    )  # fmt: skip
    assert done.returncode == 1
    assert "EZS612" in done.stderr + done.stdout
    assert not (tmp_path / "skills.json").exists()


def test_an_individual_in_two_scenes_is_not_exported(tmp_path: Path) -> None:
    for name, x in (("a", 1.0), ("b", 9.0)):
        at = f"skiros:PositionX {x} ; skiros:PositionY 2.0"
        text = f"{PREFIXES}\nskiros:Location-1 a skiros:Location ; {FRAME} ; {at} .\n"
        (tmp_path / f"{name}.turtle").write_text(text)
    done = command_line.run(
        "ezskiros", "export", "a.turtle", "b.turtle", "--ontology", str(ONTOLOGY),
        "-o", "skills.json", folder=tmp_path,
    )  # fmt: skip
    assert done.returncode == 1
    assert "there are two locations" in done.stderr + done.stdout
    assert not (tmp_path / "skills.json").exists()


def test_a_large_scene_takes_time_in_proportion(ontology: Ontology, tmp_path: Path) -> None:
    def scene_of(count: int) -> Path:
        scene = tmp_path / f"{count}.turtle"
        square = 'geo:asWKT "POLYGON ((0 0, 1 0, 1 1, 0 0))"'
        individuals = (
            f"skiros:Location-{n} a skiros:Location ; {FRAME} ; {square} ." for n in range(count)
        )
        scene.write_text("\n".join([PREFIXES, *individuals]))
        return scene

    small, large = scene_of(500), scene_of(4000)
    assert takes_at_most(12.0, lambda path: check_scene(path, ontology), small, large)
