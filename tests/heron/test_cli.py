"""The command `heron`."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from heron.cli import choices
from heron.cli.main import app
from heron.variants import VARIANTS
from support.parts import MUJOCO, needs


@needs(MUJOCO)
def test_an_episode_is_run_and_its_measures_are_printed() -> None:
    found = CliRunner().invoke(app, ["run", "nav", "--arm", "rossmarie", "--variant", "flat"])
    assert found.exit_code == 0
    assert "rossmarie, on flat terrain, seed 0" in found.stdout
    assert "completed" in found.stdout
    assert "restricted without need" in found.stdout


@needs(MUJOCO)
def test_the_arm_places_its_block() -> None:
    found = CliRunner().invoke(app, ["run", "place", "--arm", "none", "--seed", "3"])
    assert found.exit_code == 0
    assert "none, table 4.2 cm too high, seed 3" in found.stdout
    assert "above 30 N" in found.stdout


@needs(MUJOCO)
def test_somebody_comes_into_the_room() -> None:
    found = CliRunner().invoke(app, ["run", "human", "--arm", "none", "--variant", "inside"])
    assert found.exit_code == 0
    assert "none, a person inside, seed 0" in found.stdout
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
        ["learn", "tree"],
        ["run", "insertion", "--ros1"],
        ["policy", "numbers.json"],
    ],
)
def test_without_mujoco_it_says_what_to_install(
    command: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(choices, "find_spec", lambda _: None)
    found = CliRunner().invoke(app, command)
    assert found.exit_code == 2
    assert "pip install 'heron-robot'" in found.output


@pytest.mark.parametrize("version", [(3, 10), (3, 12)])
def test_it_says_why_mujoco_is_not_there(
    version: tuple[int, int], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(choices, "find_spec", lambda name: None if name == "mujoco" else name)
    monkeypatch.setattr(choices, "_VERSION", version)
    found = CliRunner().invoke(app, ["demo"])
    is_old = version == (3, 10)
    assert ("needs Python 3.11 or later; this is Python 3.10" in found.output) is is_old
    assert (f"needs MuJoCo, not installed for {sys.executable}" in found.output) is not is_old
    assert "SciPy" not in found.output


@needs(MUJOCO)
def test_the_names_that_are_known_without_the_simulation_are_those_of_the_experiments() -> None:
    from heron.experiments import EXPERIMENTS

    assert {name: each.harms.keys() for name, each in EXPERIMENTS.items()} == {
        name: set(variants) for name, variants in VARIANTS.items()
    }
    assert list(EXPERIMENTS) == list(VARIANTS)


def test_a_wrong_arm_is_reported_with_those_that_there_are() -> None:
    found = CliRunner().invoke(app, ["run", "nav", "--arm", "none_at_all"])
    assert found.exit_code == 2
    assert "rossmarie" in found.output


@pytest.mark.parametrize(
    ("variables", "reported"),
    [
        ({"ROS_MASTER_URI": "http://127.0.0.1:1"}, "no ROS master at http://127.0.0.1:1"),
        ({"ROS_MASTER_URI": "nonsense"}, "no ROS master at nonsense"),
        ({"ROS_IP": "192.0.2.1"}, "192.0.2.1 is not an address of this machine"),
        ({"ROS_HOSTNAME": "no host"}, "no host is not an address of this machine"),
    ],
)
@needs(MUJOCO)
def test_what_hinders_a_link_to_ros_is_reported(
    variables: dict[str, str], reported: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("ROS_MASTER_URI", "ROS_IP", "ROS_HOSTNAME"):
        monkeypatch.delenv(name, raising=False)
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    found = CliRunner().invoke(app, ["run", "nav", "--ros1"])
    assert found.exit_code == 1
    assert reported in found.stderr


def test_without_a_guard_there_is_nothing_to_link() -> None:
    found = CliRunner().invoke(app, ["run", "nav", "--ros1", "--arm", "none"])
    assert found.exit_code == 2
    assert "--arm none has no such node" in found.stderr


NO_POLICY = ["run", "insertion", "--policy", "policy.npz"]


@pytest.mark.parametrize(
    ("command", "reported"),
    [
        (["run", "insertion"], "an episode needs --policy FILE"),
        (["run", "insertion", "--arm", "ended"], "insertion has no arm ended; there are"),
        ([*NO_POLICY, "--ros1"], "leave out --policy, and run `heron policy policy.npz`"),
        (["run", "insertion", "--ros1", "--arm", "unguarded"], "--arm unguarded has no such node"),
        (["run", "insertion", "--ros1", "--film", "a.gif"], "leave out --ros1"),
        ([*NO_POLICY, "--film", "a.txt"], "must end in .mp4 or .gif"),
    ],
)
def test_an_insertion_that_there_is_not_is_refused(command: list[str], reported: str) -> None:
    found = CliRunner().invoke(app, command)
    assert found.exit_code == 2
    assert reported in found.stderr


@needs(MUJOCO)
@pytest.mark.parametrize("command", [NO_POLICY, ["policy", "policy.npz"]])
def test_a_policy_that_is_not_there_is_reported(
    command: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    found = CliRunner().invoke(app, command)
    assert found.exit_code == 2
    assert "cannot read policy.npz: no such file" in found.stderr
    (tmp_path / "policy.npz").write_bytes(b"PK")
    found = CliRunner().invoke(app, command)
    assert found.exit_code == 2
    assert "policy.npz is not a policy of this task" in found.stderr


@needs(MUJOCO)
@pytest.mark.parametrize("command", [["run", "insertion", "--ros1"], ["policy", "numbers.json"]])
def test_without_a_master_nothing_is_in_operation(
    command: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("ROS_MASTER_URI", "http://127.0.0.1:1")
    numbers = {"Height": 0.05, "AsideX": 0, "AsideY": 0, "Force": 5, "Growth": 0.004, "Speed": 0.05}
    (tmp_path / "numbers.json").write_text(json.dumps(numbers), encoding="utf-8")
    found = CliRunner().invoke(app, command)
    assert found.exit_code == 1
    assert "no ROS master at http://127.0.0.1:1" in found.stderr


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["tree", "--algorithm", "ppo"], "tree has no algorithm ppo; there are cma-es"),
        (
            ["tree", "--arm", "executed"],
            "tree has no arm executed; there are unguarded, ended, penalty, guard, guard_feedback",
        ),
        (["steps", "--steps", "9000"], "so steps needs 9600 at least"),
        (["tree", "--ray", "here"], "--ray needs HOST:PORT, not `here`"),
    ],
)
def test_a_training_that_there_is_not_is_refused(words: list[str], reason: str) -> None:
    found = CliRunner().invoke(app, ["learn", *words])
    assert found.exit_code == 2
    assert reason in found.output.replace("\n", " ")


def test_without_learners_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(choices, "require_simulation", lambda: None)
    monkeypatch.setattr(
        choices, "find_spec", lambda name: None if name in {"cmaes", "skrl"} else name
    )
    found = CliRunner().invoke(app, ["learn", "steps"])
    assert found.exit_code == 2
    assert "these trainings need skrl, not installed" in found.output
    assert "pip install 'heron-robot[learning]'" in found.output
