"""The examples of lists and of clouds: nothing is found in them, tests pass, nodes come of them."""

from __future__ import annotations

from pathlib import Path

import pytest

from rossmarie.driver import check_file
from rossmarie.driver.build import build_files
from rossmarie.driver.testing import run_test_file

FOLDER = Path(__file__).parents[2] / "examples" / "perception"
OBJECTS, POINTS = FOLDER / "objects.ross", FOLDER / "points.ross"


@pytest.mark.parametrize("rules", [OBJECTS, POINTS])
def test_nothing_is_found(rules: Path) -> None:
    assert [one.title for one in check_file(rules).diagnostics] == []


@pytest.mark.parametrize(("rules", "count"), [(OBJECTS, 6), (POINTS, 5)])
def test_its_tests_pass(rules: Path, count: int) -> None:
    found = run_test_file(rules)
    assert [one.title for ran in found.ran for one in ran.found] == []
    assert len(found.ran) == count


@pytest.mark.parametrize("target", ["ros1", "ros2"])
def test_a_node_has_room_for_as_many_elements_as_is_said(tmp_path: Path, target: str) -> None:
    build_files(OBJECTS, target, tmp_path)
    text = (tmp_path / "src" / "rules.h").read_text()
    assert "std::array<double, 64> detections_detections_bbox_size_z{};" in text
    assert "std::vector<double>" not in text


@pytest.mark.parametrize("target", ["ros1", "ros2"])
def test_a_node_takes_what_is_read_of_points(tmp_path: Path, target: str) -> None:
    build_files(POINTS, target, tmp_path)
    assert "std::array<double, 307200>" in (tmp_path / "src" / "rules.h").read_text()
    text = (tmp_path / "src" / "rules.cpp").read_text()
    assert "points_count = points(message, 307200, {" in text
    assert '{"doppler", arrays.radar_targets_points_doppler.data()}' in text
