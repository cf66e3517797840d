"""Lists of messages through the Python API: as dictionaries, as objects, and as columns."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from rossmarie import Monitor
from rossmarie.native import ColumnError
from support.c_compiler import needs_c
from support.engines import ENGINES, load

pytestmark = needs_c

RULES = """\
action stop;
input path = topic /plan : nav_msgs/Path .poses up to 3 timeout 5 sec;
input status = topic /diagnostics : diagnostic_msgs/DiagnosticArray .status up to 2 timeout 5 sec;
rule near: if any(p in path: p.pose.position.x < 1 m and p.pose.position.y < 1 m) then { stop; };
rule broken: if any(s in status: s.name == "motor" and s.level >= 2) then { stop; };
"""
FINE = {"name": "motor", "level": 0}
BROKEN = SimpleNamespace(name="motor", level=2)


@pytest.fixture(params=ENGINES)
def monitor(request: pytest.FixtureRequest, tmp_path: Path) -> Monitor:
    found = load(RULES, request.param, tmp_path)
    found.update(0, {"path": [], "status": []})
    assert list(found.active) == []
    return found


def at(x: float, y: float) -> dict[str, object]:
    return {"pose": {"position": {"x": x, "y": y}}}


def test_lists_of_dictionaries_and_of_objects(monitor: Monitor) -> None:
    monitor.update(1, {"path": [at(0.5, 2.0), at(2.0, 0.5)], "status": [FINE]})
    assert list(monitor.active) == []
    monitor.update(2, {"path": (at(2.0, 2.0), at(0.5, 0.5)), "status": [FINE, BROKEN]})
    assert list(monitor.active) == ["near", "broken"]
    monitor.update(3, {"path": [], "status": [FINE]})
    assert list(monitor.active) == []


def test_names_of_fields_may_be_written_in_one(monitor: Monitor) -> None:
    monitor.update(1, {"path": [{"pose.position.x": 0.5, "pose.position.y": 0.5}]})
    assert list(monitor.active) == ["near"]


def test_lists_as_columns(monitor: Monitor) -> None:
    monitor.update(1, {"status.name": ["motor"], "status.level": [2]})
    monitor.update(1, {"path.x": [0.5, 3.0], "path.y": [2.0, 3.0]})
    assert list(monitor.active) == ["broken"]
    monitor.update(2, {"path.x": [0.5, 3.0], "path.y": [0.5, 3.0]})
    assert list(monitor.active) == ["near", "broken"]


@pytest.mark.parametrize("stale", [None, [at(9.0, 9.0)] * 4])
def test_a_list_that_is_not_known_is_stale(monitor: Monitor, stale: object) -> None:
    monitor.update(1, {"path": stale})  # type: ignore[dict-item]
    assert list(monitor.active) == ["near"]


def test_a_list_with_columns_of_different_lengths_is_stale(monitor: Monitor) -> None:
    monitor.update(1, {"path.x": [9.0], "path.y": [9.0, 9.0]})
    assert list(monitor.active) == ["near"]


def test_a_field_that_a_dictionary_lacks_is_unknown(monitor: Monitor) -> None:
    monitor.update(1, {"path": [{"pose": {"position": {"x": 9.0}}}]})
    assert list(monitor.active) == []  # it is far, wherever y is
    monitor.update(2, {"path": [{"pose": {"position": {"x": 0.5}}}]})
    assert list(monitor.active) == ["near"]


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"path": 3.0}, "`path` takes a list of messages, not 3.0"),
        ({"path": "near"}, "`path` takes a list of messages"),
        ({"path": [SimpleNamespace(pose=3.0)]}, "has no field `pose.position.x`"),
        ({"status": [{"name": 3, "level": 0}]}, "expected a string, not 3"),
        ({"status.name": [3]}, "expected a string, not 3"),
        ({"status.name": "motor"}, "`status.name` takes the strings of all elements"),
    ],
)
def test_what_is_no_list_is_refused(monitor: Monitor, values: dict[str, object], said: str) -> None:
    with pytest.raises(TypeError, match=said):
        monitor.update(1, values)  # type: ignore[arg-type]
    assert list(monitor.active) == []


def test_a_misspelt_list_is_reported(monitor: Monitor) -> None:
    with pytest.raises(KeyError, match="did you mean `path`"):
        monitor.update(1, {"pth": []})


def test_tables_have_as_many_elements_in_each_row(monitor: Monitor) -> None:
    times = np.array([1, 2])
    columns = {
        "path.x": np.array([[0.5, 9.0], [9.0, 9.0]]),
        "path.y": np.array([[0.5, 9.0], [9.0, 9.0]]),
        "status.name": np.array([["motor"], ["camera"]]),
        "status.level": np.array([[2], [2]]),
    }
    run = monitor.run(times, columns)
    assert run.active.tolist() == [[True, True], [False, False]]
    columns["path.y"] = np.zeros((2, 3))
    with pytest.raises(ColumnError, match="belong to one list, but have the shapes"):
        monitor.run(times, columns)
