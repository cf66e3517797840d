"""The command `heron`."""

from __future__ import annotations

import pytest
from typer.testing import CliRunner

from heron.cli import main
from heron.cli.main import app


def test_an_episode_is_run_and_its_measures_are_printed() -> None:
    pytest.importorskip("mujoco", reason="the simulation needs MuJoCo, which needs Python 3.11")
    found = CliRunner().invoke(app, ["run", "nav", "--arm", "rossmarie", "--terrain", "flat"])
    assert found.exit_code == 0
    assert "rossmarie, on flat terrain, seed 0" in found.stdout
    assert "completed" in found.stdout
    assert "restricted without need" in found.stdout


def test_the_arm_places_its_block() -> None:
    pytest.importorskip("mujoco", reason="the simulation needs MuJoCo, which needs Python 3.11")
    found = CliRunner().invoke(app, ["run", "place", "--arm", "none", "--seed", "3"])
    assert found.exit_code == 0
    assert "none, table 4.2 cm too high, seed 3" in found.stdout
    assert "above 30 N" in found.stdout


def test_somebody_comes_into_the_room() -> None:
    pytest.importorskip("mujoco", reason="the simulation needs MuJoCo, which needs Python 3.11")
    found = CliRunner().invoke(app, ["run", "human", "--arm", "none", "--person", "inside"])
    assert found.exit_code == 0
    assert "none, somebody inside, seed 0" in found.stdout
    assert "least distance to the person" in found.stdout


@pytest.mark.parametrize(
    "command",
    [
        ["run", "nav"],
        ["run", "place"],
        ["run", "human"],
        ["demo"],
        ["evaluate"],
        ["record", "nav", "--out", "a.mcap"],
    ],
)
def test_without_mujoco_it_says_what_to_install(
    command: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(main, "find_spec", lambda _: None)
    found = CliRunner().invoke(app, command)
    assert found.exit_code == 2
    assert "pip install 'rossmarie[heron]'" in found.output


def test_a_wrong_arm_is_told_with_those_that_there_are() -> None:
    found = CliRunner().invoke(app, ["run", "nav", "--arm", "none_at_all"])
    assert found.exit_code == 2
    assert "rossmarie" in found.output
