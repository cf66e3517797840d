"""The suite's messages about missing parts, on a small suite of its own."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest

TESTS = Path(__file__).parents[1]

CONFTEST = """\
import pytest
from small_parts import PARTS
from support.lacking import Lacking

def pytest_addoption(parser):
    parser.addoption("--deep", action="store_true")

def pytest_configure(config):
    config.addinivalue_line("markers", "deep: too slow")
    config.pluginmanager.register(Lacking(PARTS))

def pytest_collection_modifyitems(config, items):
    if not config.getoption("--deep"):
        deep = [item for item in items if item.get_closest_marker("deep")]
        config.hook.pytest_deselected(items=deep)
        items[:] = [item for item in items if item not in deep]
"""
PARTS = """\
from support.parts import Part

THERE = Part("hands", lambda: None, "grow them")
AWAY = Part("wings", lambda: "no feathers", "make wings")
GONE = Part("a tail", lambda: "stale", "apt-get install tail")
PARTS = (THERE, AWAY, GONE)
"""
SKIPPING = """\
import pytest
from small_parts import AWAY, GONE, THERE
from support.parts import needs, require

@pytest.fixture
def tail():
    require(GONE)

@needs(THERE)
def test_there(): pass

@needs(AWAY)
@pytest.mark.parametrize("height", [1, pytest.param(2, marks=needs(GONE))])
def test_fly(height): assert False

@needs(AWAY)
def test_before_its_fixtures(tail): assert False

def test_wag(tail): assert False

def test_otherwise(): pytest.skip("it rains")

@pytest.mark.deep
@pytest.mark.parametrize("depth", [1, 2])
def test_dive(depth): pass
"""
MODULE = """\
from small_parts import GONE
from support.parts import require

require(GONE)

import no_such_module

def test_nothing(): pass
"""
MISSING = ["skipped: wings (no feathers)", "skipped: a tail (stale)"]
REPORTED = [
    *MISSING,
    "not run on this machine:",
    "  3 tests: wings (no feathers). To have it: make wings",
    "  1 test and 2 files: a tail (stale). To have it: apt-get install tail",
    "  1 test: it rains",
    "2 deep tests left to `make deep`",
]


@pytest.fixture(scope="module")
def suite(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("suite")
    for name, text in {
        "pytest.ini": "[pytest]\naddopts = -q --strict-markers\n",
        "conftest.py": CONFTEST,
        "small_parts.py": PARTS,
        "skipping/test_skipping.py": SKIPPING,
        "skipping/test_module.py": MODULE,
        "skipping/test_another_module.py": MODULE,
        "running/test_running.py": "def test_it(): pass\n",
    }.items():
        path = folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return folder


ALONE = {"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}
"""No plugin but those that are named; the suite starts faster."""


def reported(suite: Path, *arguments: str) -> list[str]:
    """The output of a run, without the progress of its tests and without times."""
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-p", "xdist", "-p", "no:cacheprovider", *arguments],
        cwd=suite, env={**os.environ, **ALONE, "PYTHONPATH": f"{TESTS}:{suite}"},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    return [line for line in done.stdout.splitlines() if line and "%]" not in line][:-1]


def without_workers(lines: Sequence[str]) -> list[str]:
    return [line for line in lines if "bringing up nodes" not in line]


@pytest.mark.parametrize("workers", ["0", "2"])
def test_each_reason_is_reported_with_its_number_of_tests(suite: Path, workers: str) -> None:
    assert without_workers(reported(suite, "skipping", "-n", workers)) == REPORTED


def test_nothing_is_left_of_a_deep_run(suite: Path) -> None:
    assert reported(suite, "skipping", "--deep", "-k", "not dive") == REPORTED[:-1]


def test_where_nothing_was_skipped_that_is_reported(suite: Path) -> None:
    assert reported(suite, "running") == [*MISSING, "no test was skipped on this machine"]


def test_where_nothing_is_missing_that_is_reported(suite: Path, tmp_path: Path) -> None:
    (tmp_path / "small_parts.py").write_text(PARTS.replace("AWAY, GONE", ""), encoding="utf-8")
    for name in ("pytest.ini", "conftest.py", "running/test_running.py"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text((suite / name).read_text("utf-8"), encoding="utf-8")
    assert reported(tmp_path, "running") == [
        "skipped: nothing, no part is missing",
        "no test was skipped on this machine",
    ]


def test_of_a_single_file_only_the_end_is_reported(suite: Path) -> None:
    assert reported(suite, "skipping/test_skipping.py::test_wag") == [
        "not run on this machine:",
        "  1 test: a tail (stale). To have it: apt-get install tail",
    ]


def test_a_list_of_tests_has_nothing_else_in_it(suite: Path) -> None:
    assert reported(suite, "running", "--collect-only") == ["running/test_running.py::test_it"]
