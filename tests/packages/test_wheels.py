"""The wheels hold what they should, and each works with nothing but what it asks for."""

from __future__ import annotations

import zipfile
from pathlib import Path
from typing import Any

import pytest

from support.packages import ROOT, dist, linked, projects

TRIALS = [each for each in dist().TRIALS if each.requirement != "heron-robot"]
"""`make dist` tries the simulation as well, which asks for almost all that is installed."""


@pytest.fixture(scope="module")
def wheels(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """The wheels of all projects."""
    found: list[Path] = dist().build(tmp_path_factory.mktemp("wheels"), with_sources=False)
    return found


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
    trial: Any, wheels: list[Path], tmp_path: Path
) -> None:
    programs = linked(tmp_path / "environment", trial.requirement, wheels)
    folder = tmp_path / "work"
    folder.mkdir()
    assert list(dist().failures(trial, programs, folder)) == []
