"""The example of lists of messages: nothing is found in it, its tests pass, nodes come of it."""

from __future__ import annotations

from pathlib import Path

import pytest

from rossmarie.driver import check_file
from rossmarie.driver.build import build_files
from rossmarie.driver.testing import run_test_file

RULES = Path(__file__).parents[2] / "examples" / "perception" / "objects.ross"


def test_nothing_is_found() -> None:
    assert [one.title for one in check_file(RULES).diagnostics] == []


def test_its_tests_pass() -> None:
    found = run_test_file(RULES)
    assert [one.title for ran in found.ran for one in ran.found] == []
    assert len(found.ran) == 6


@pytest.mark.parametrize("target", ["ros1", "ros2"])
def test_a_node_has_room_for_as_many_elements_as_is_said(tmp_path: Path, target: str) -> None:
    build_files(RULES, target, tmp_path)
    text = (tmp_path / "src" / "rules.h").read_text()
    assert "std::array<double, 64> detections_detections_bbox_size_z{};" in text
    assert "std::vector<double>" not in text
