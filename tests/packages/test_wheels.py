"""The wheels hold what they should, and each works with nothing but what it asks for."""

from __future__ import annotations

import os
import sys
import zipfile
from pathlib import Path

import pytest

from support.packages import ROOT, dist, linked, projects

TRIALS = [each for each in dist().TRIALS if each.requirement != "heron-robot"]
"""`make dist` tries the simulation as well, which asks for almost all that is installed."""


@pytest.fixture(scope="module")
def wheels(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """The wheels of all projects."""
    found: list[Path] = dist().build(tmp_path_factory.mktemp("wheels"), with_sources=False)
    return found


@pytest.fixture(scope="module", autouse=True)
def nothing_of_ours_around() -> None:
    """Let no variable of a developer lead the commands of a trial to the sources."""
    assert "PYTHONPATH" not in dist().failures.__code__.co_names


def test_wheels_pass_the_checks_of_their_tools(wheels: list[Path]) -> None:
    dist().check(wheels)


def test_a_wheel_has_each_file_of_its_package_and_no_other(wheels: list[Path]) -> None:
    for project in projects().values():
        (wheel,) = (each for each in wheels if each.name.startswith(_file_name(project.name)))
        with zipfile.ZipFile(wheel) as opened:
            names = {name for name in opened.namelist() if ".dist-info/" not in name}
        source = ROOT / "src"
        expected = {
            str(path.relative_to(source))
            for path in (source / project.module).rglob("*")
            if path.is_file() and "__pycache__" not in path.parts
        }
        examples = f"{project.module}/examples/"
        assert {name for name in names if not name.startswith(examples)} == expected
        assert any(name.startswith(examples) for name in names) == (project.name == "ezskiros")


def _file_name(name: str) -> str:
    return f"{name.replace('-', '_')}-"


@pytest.mark.parametrize("trial", TRIALS, ids=lambda each: each.requirement)
def test_a_wheel_works_with_what_it_asks_for(
    trial: object, wheels: list[Path], tmp_path: Path
) -> None:
    requirement = trial.requirement  # type: ignore[attr-defined]
    programs = linked(tmp_path / "environment", requirement, wheels)
    folder = tmp_path / "work"
    folder.mkdir()
    assert list(dist().failures(trial, programs, folder)) == []


def test_this_python_is_among_those_that_are_tried() -> None:
    assert os.path.realpath(sys.executable) in {
        os.path.realpath(path) for path in dist().pythons().values()
    } or sys.version_info[:2] > (3, 14)
