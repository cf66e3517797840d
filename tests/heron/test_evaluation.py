"""Rows of episodes become tables, and a verdict on what was expected."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import pytest

from support.parts import MUJOCO, RAY, needs, require

require(MUJOCO)

from typer.testing import CliRunner

from dslkit.campaign import Journal, Value
from heron.cli.main import app
from heron.evaluation import (
    EpisodeRow,
    Folder,
    Results,
    StudyRow,
    keys_of,
    page_of,
    read_rows,
    row_of,
    sources,
    write_page,
)
from heron.evaluation.expectation import ExpectationVerdict
from heron.evaluation.expectations import expectations_of
from heron.evaluation.sample import samples_of
from heron.evaluation.statistics import compare, median, share
from heron.evaluation.study_section import slope_torque
from heron.experiments import EXPERIMENTS, STUDIES
from heron.variants import ExperimentArm, Person
from support.depth import deep

DOCS = Folder(Path(__file__).parents[2] / "docs")
PLACING = EXPERIMENTS["place"]
COMMON = {"duration": 10.0, "completed": 1.0, "interventions": 0.0, "peak_force": 50.0}


def row(arm: ExperimentArm, seed: int, variant: str = "high", **numbers: float) -> EpisodeRow:
    every = {measure.name: 0.0 for measure in PLACING.measures}
    return EpisodeRow(variant, arm.value, seed, every | COMMON | numbers)


def as_expected(seeds: Iterable[int]) -> list[EpisodeRow]:
    """The results of the thesis, in numbers."""
    found = []
    for seed in seeds:
        found += [
            row(
                ExperimentArm.NONE, seed, duration=8.0, peak_force=100.0 + seed, time_above_30_n=1.0
            ),
            row(ExperimentArm.DEROS, seed, duration=40.0 + seed, interventions=1.0),
            row(ExperimentArm.ROSSMARIE, seed, duration=11.0, reaction_hammering=0.3),
            *(row(arm, seed, "expected") for arm in PLACING.arms),
        ]
    return found


def verdicts(rows: list[EpisodeRow], variant: str = "high") -> dict[str, ExpectationVerdict]:
    (sample,) = (one for one in samples_of(PLACING, rows) if one.variant == variant)
    return {expectation.key: expectation.verdict for expectation in expectations_of(sample)}


def test_what_the_thesis_says_is_as_expected() -> None:
    rows = as_expected(range(10))
    found = {**verdicts(rows), **verdicts(rows, "expected")}
    assert set(found.values()) == {ExpectationVerdict.HOLDS}
    assert len(found) == 13


@pytest.mark.parametrize(
    ("key", "variant", "arm", "numbers"),
    [
        ("harm deros time_above_30_n", "high", ExperimentArm.DEROS, {"time_above_30_n": 30.0}),
        ("safe deros peak_force", "high", ExperimentArm.ROSSMARIE, {"peak_force": 56.0}),
        ("in time hammering", "high", ExperimentArm.ROSSMARIE, {"reaction_hammering": 0.6}),
        ("fastest", "high", ExperimentArm.NONE, {"completed": 0.0}),
        ("fastest", "high", ExperimentArm.NONE, {"duration": 12.0}),
        ("operator", "high", ExperimentArm.DEROS, {"interventions": 0.0}),
        ("operator", "high", ExperimentArm.DEROS, {"completed": 0.0}),
        ("alone", "high", ExperimentArm.ROSSMARIE, {"completed": 0.0}),
        ("alone", "high", ExperimentArm.ROSSMARIE, {"interventions": 1.0}),
        ("sooner", "high", ExperimentArm.ROSSMARIE, {"duration": 60.0}),
        ("all finish", "expected", ExperimentArm.NONE, {"completed": 0.0}),
        ("no interference", "expected", ExperimentArm.DEROS, {"restricted_without_need": 0.1}),
    ],
)
def test_what_is_otherwise_is_not(
    key: str, variant: str, arm: ExperimentArm, numbers: dict[str, float]
) -> None:
    rows = [
        replace(one, numbers=one.numbers | numbers)
        if (one.variant, one.arm) == (variant, arm.value)
        else one
        for one in as_expected(range(10))
    ]
    found = verdicts(rows, variant)
    assert {name for name, verdict in found.items() if verdict is ExpectationVerdict.FAILS} == {key}


def test_few_episodes_tell_nothing() -> None:
    found = verdicts(as_expected(range(2)))
    assert found["harm rossmarie peak_force"] is ExpectationVerdict.OPEN
    assert verdicts(as_expected(range(1)))["safe deros peak_force"] is ExpectationVerdict.OPEN


# --- a collision monitor beside them ---------------------------------------------------------

HUMAN = EXPERIMENTS["human"]


def visit(arm: ExperimentArm, seed: int, **numbers: float) -> EpisodeRow:
    """An episode with somebody in the room, as safe as can be, and 40 s long."""
    every = {measure.name: 0.0 for measure in HUMAN.measures}
    usual = {"completed": 1.0, "duration": 40.0, "gives_way": 0.1 + 0.001 * seed}
    return EpisodeRow(Person.INSIDE.value, arm.value, seed, every | usual | numbers)


def of_visits(**changed: dict[str, float]) -> dict[str, ExpectationVerdict]:
    """The verdicts on ten visits in each arm; numbers of an arm are changed by its name."""
    rows = [
        visit(arm, seed, **changed.get(arm.value, {})) for seed in range(10) for arm in HUMAN.arms
    ]
    (sample,) = (one for one in samples_of(HUMAN, rows) if one.variant == "inside")
    return {expectation.key: expectation.verdict for expectation in expectations_of(sample)}


@pytest.mark.parametrize(
    ("key", "arm", "numbers", "verdict"),
    [
        ("does as much", "rossmarie", {"duration": 43.0}, ExpectationVerdict.HOLDS),
        ("does as much", "rossmarie", {"duration": 45.0}, ExpectationVerdict.FAILS),
        ("does as much", "rossmarie", {"completed": 0.0}, ExpectationVerdict.FAILS),
        ("does as much", "collision_monitor", {"completed": 0.0}, ExpectationVerdict.HOLDS),
        ("safe collision_monitor risk", "rossmarie", {"risk": 0.1}, ExpectationVerdict.FAILS),
        ("safe collision_monitor risk", "collision_monitor", {"risk": 0.1},
         ExpectationVerdict.HOLDS),
        ("better collision_monitor gives_way", "collision_monitor", {"gives_way": 0.0},
         ExpectationVerdict.HOLDS),
        ("better collision_monitor gives_way", "rossmarie", {"gives_way": 0.0},
         ExpectationVerdict.FAILS),
    ],
)  # fmt: skip
def test_rossmarie_is_compared_with_the_collision_monitor(
    key: str, arm: str, numbers: dict[str, float], verdict: ExpectationVerdict
) -> None:
    assert of_visits(**{arm: numbers})[key] is verdict


def test_where_no_zone_says_anything_nothing_is_expected_of_it() -> None:
    assert not any("collision" in key for key in verdicts(as_expected(range(3))))


def test_what_repeats_itself_is_expected_once() -> None:
    for experiment in EXPERIMENTS.values():
        chosen = [harm for harms in experiment.harms.values() for harm in harms]
        on_bump = [harm for harm in chosen if harm in ("peak_front", "peak_drive", "peak_rear")]
        assert len(on_bump) == len(set(on_bump)), "there is one bump, and it is in two terrains"


def test_intervals_hold_what_they_are_of() -> None:
    found = median([1.0, 2.0, 3.0, 4.0, 100.0])
    assert (found.value, found.low >= 1.0, found.high <= 100.0) == (3.0, True, True)
    assert found.low < 3.0 < found.high
    assert median([1.0, 2.0, 3.0, 4.0, 100.0]) == found, "the same values, the same interval"
    assert math.isnan(median([1.0]).low)
    all_of_them = share(30, 30)
    assert all_of_them.high == pytest.approx(1.0)
    assert all_of_them.low == pytest.approx(0.886, abs=0.001)
    assert compare([1.0] * 10, [1.0] * 10).chance == 1.0
    assert compare([2.0 + 0.1 * i for i in range(10)], [1.0] * 10).chance < 0.01


def test_the_page_tells_what_failed_and_what_is_missing() -> None:
    rows = as_expected(range(10))
    page = page_of(Results({"place": rows}, {}), "experiments")
    assert "- met: 13" in page
    assert "Not met" not in page
    assert "| task completed | 10 of 10 [72, 100 %] |" in page
    assert "Not finished" not in page
    rows[2] = row(ExperimentArm.ROSSMARIE, 0, completed=0.0)
    page = page_of(Results({"place": rows[:-1]}, {}), "experiments")
    assert "- not met: 1" in page
    assert (
        "*II, placing, high*, with ROSSMARie the robot finishes without an operator: "
        "the robot finishes in 9" in page
    )
    assert "Not finished: expected/rossmarie/9." in page


def test_every_episode_of_every_arm_is_run_seed_by_seed() -> None:
    keys = [key for key in keys_of([PLACING], 2) if "=" not in key]
    assert len(keys) == len(set(keys)) == 18
    assert keys[:3] == ["place/high/none/0", "place/high/deros/0", "place/high/rossmarie/0"]
    assert keys[9].endswith("/1")


# --- studies ---------------------------------------------------------------------------------


def test_studies_are_run_for_the_experiments_that_are_chosen() -> None:
    studied = [key for key in keys_of([PLACING], 30) if "=" in key]
    assert len(studied) == len(set(studied)) == 2 * 3 * STUDIES["operator"].seeds
    assert studied[0] == "operator=0/place/high/deros/0"
    assert not any(key.startswith("torque") for key in studied)
    assert any(key.startswith("torque=6.5/nav") for key in keys_of(EXPERIMENTS.values(), 1))


@pytest.mark.deep
def test_an_operator_who_stands_beside_the_robot_costs_no_half_minute() -> None:
    usual, at_once = (row_of(f"{study}place/high/deros/3") for study in ("", "operator=0/"))
    assert "study" not in usual
    assert (at_once["study"], at_once["value"]) == ("operator", "0")
    assert (usual["interventions"], at_once["interventions"]) == (1.0, 1.0)
    assert isinstance(usual["duration"], float)
    assert isinstance(at_once["duration"], float)
    assert usual["duration"] - at_once["duration"] == pytest.approx(30.0, abs=0.5)


def test_more_torque_takes_the_hazard_away() -> None:
    assert slope_torque() == pytest.approx(6.3, abs=0.05)
    assert row_of("torque=7/nav/gentle/none/3")["completed"] == 1.0


def test_the_page_shows_what_depends_on_a_choice() -> None:
    study = STUDIES["operator"]
    rows = [
        StudyRow(value, "place", row(ExperimentArm.DEROS, seed, duration=10.0 + value + seed))
        for value in study.values
        for seed in range(3)
    ]
    page = page_of(Results({}, {"operator": rows}), "experiments")
    assert "| 30 | - | - | 3 of 3, 41.0 [40.0, 42.0] | - | - |" in page
    assert "![Delay of the operator](experiments/operator.svg)" in page
    assert "The thesis describes its experiments, but gives no figures" in page


# --- what is in the documentation ------------------------------------------------------------


def test_the_page_in_the_documentation_is_made_of_the_rows_beside_it() -> None:
    results = DOCS.results()
    assert results.experiments.keys() == EXPERIMENTS.keys()
    assert results.studies.keys() == STUDIES.keys()
    assert (DOCS.path / "experiments.md").read_text(encoding="utf-8") == page_of(
        results, "experiments"
    )
    for name in (*results.experiments, *results.studies):
        assert DOCS.plot(name).read_bytes().startswith(b"<?xml")


@pytest.mark.parametrize(
    "key",
    [
        "place/high/rossmarie/1",
        *deep(
            [
                "contact/jammed/skill_aware/1",
                "human/inside/collision_monitor/1",
                "human/inside/deros/1",
                "nav/gentle/collision_monitor/1",
                "nav/gentle/none/1",
                "second/passing/learned/1",
            ]
        ),
    ],
)
def test_an_episode_that_is_run_again_is_the_one_in_the_documentation(key: str) -> None:
    name, variant, arm, seed = key.split("/")
    (there,) = (
        row
        for row in DOCS.results().experiments[name]
        if (row.variant, row.arm, row.seed) == (variant, arm, int(seed))
    )
    again = {name: value for name, value in row_of(key).items() if isinstance(value, float)}
    assert again.keys() == there.numbers.keys()
    assert there.numbers == pytest.approx(again, rel=1e-3, abs=1e-3)


def test_an_episode_of_a_study_that_is_run_again_is_the_one_in_the_documentation() -> None:
    (there,) = (
        one.row
        for one in DOCS.results().studies["operator"]
        if (one.value, one.experiment) == (0.0, "place")
        and (one.row.variant, one.row.seed) == ("high", 1)
    )
    again = row_of("operator=0/place/high/deros/1")
    assert there.numbers == pytest.approx({name: again[name] for name in there.numbers}, rel=1e-3)


# --- the command -----------------------------------------------------------------------------


def test_an_evaluation_writes_its_page_and_does_nothing_twice(tmp_path: Path) -> None:
    keys = list(keys_of([PLACING], 2))
    assert len(keys) == 18 + 2 * 2 * 3
    with Journal(Folder(tmp_path).journal, sources()) as journal:
        for key in keys:
            *study, _, variant, arm, seed = key.split("/")
            numbers = row(ExperimentArm(arm), int(seed), variant, duration=12.3456789).numbers
            place: Value = {
                "experiment": "place",
                "variant": variant,
                "arm": arm,
                "seed": int(seed),
            }
            changed: Value = (
                dict(zip(("study", "value"), study[0].split("="), strict=True)) if study else {}
            )
            journal.append(key, {**numbers, **place, **changed})
    command = ["evaluate", "--seeds", "2", "--experiment", "place", "--out", str(tmp_path)]
    found = CliRunner().invoke(app, command)
    assert found.exit_code == 0, found.output
    assert "30 of 30 are already done" in found.output
    assert "Seeds: 2." in (tmp_path / "experiments.md").read_text(encoding="utf-8")
    written = read_rows(Folder(tmp_path).rows("place"))
    assert len(written) == 18
    assert {row.numbers["duration"] for row in written} == {12.3457}
    first = Folder(tmp_path).plot("place").read_bytes()
    write_page(Folder(tmp_path), {})
    assert Folder(tmp_path).plot("place").read_bytes() == first


def test_an_evaluation_of_one_experiment_keeps_the_studies_of_the_others(tmp_path: Path) -> None:
    def of(experiment: str, variant: str, duration: float) -> Value:
        numbers = row(ExperimentArm.DEROS, 0, variant, duration=duration).numbers
        return {
            **numbers,
            "study": "operator",
            "value": "10",
            "experiment": experiment,
            "variant": variant,
            "arm": "deros",
            "seed": 0,
        }

    folder = Folder(tmp_path)
    folder.journal.parent.mkdir()
    write_page(folder, {"a": of("nav", "steep", 99.5), "b": of("place", "high", 20.0)})
    write_page(folder, {"b": of("place", "high", 21.0)})
    found = {
        one.experiment: one.row.numbers["duration"] for one in folder.results().studies["operator"]
    }
    assert found == {"nav": 99.5, "place": 21.0}


def test_results_of_another_program_do_not_get_in(tmp_path: Path) -> None:
    with Journal(Folder(tmp_path).journal, "Heron of old"):
        pass
    found = CliRunner().invoke(app, ["evaluate", "--seeds", "1", "--out", str(tmp_path)])
    assert found.exit_code == 2
    assert "Heron of old" in found.output
    assert "--out" in found.output


def test_an_unknown_experiment_is_reported_with_those_that_there_are() -> None:
    found = CliRunner().invoke(app, ["evaluate", "--experiment", "fly"])
    assert found.exit_code == 2
    known = "nav, place, human, contact, corridor, blocked, second"
    assert f"there is no experiment fly; there are {known}" in found.output


def test_an_interrupted_evaluation_says_how_it_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("heron.cli.evaluating.run", interrupt)
    found = CliRunner().invoke(app, ["evaluate", "--seeds", "1", "--out", str(tmp_path)])
    assert found.exit_code == 130
    assert "run the same command again to continue" in found.output


AT_A_CLUSTER = ["evaluate", "--seeds", "1", "--ray", "127.0.0.1:1", "--out"]


@needs(RAY)
def test_a_cluster_that_is_not_there_is_reported(tmp_path: Path) -> None:
    found = CliRunner().invoke(app, [*AT_A_CLUSTER, str(tmp_path)])
    assert found.exit_code == 2
    assert "no Ray cluster at 127.0.0.1:1" in found.output


def test_without_ray_it_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("heron.cli.choices.find_spec", lambda name: None if name == "ray" else name)
    found = CliRunner().invoke(app, [*AT_A_CLUSTER, str(tmp_path)])
    assert found.exit_code == 2
    assert "pip install 'heron-robot[ray]'" in found.output
