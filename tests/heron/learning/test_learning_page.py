"""Rows of trainings become tables, curves, and a verdict on what was expected."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

import pytest

from support.parts import LEARNERS, require

require(LEARNERS)

from dslkit.campaign import Value
from heron.evaluation.expectation import ExpectationVerdict
from heron.evaluation.learning import LearningFolder, TrainingLogs, write_learning_page
from heron.evaluation.learning.expectations import expectations_of
from heron.evaluation.learning.folder import read_rows
from heron.evaluation.learning.trainings import trainings_of
from heron.learning.arms import is_guarded
from heron.learning.episodes import EpisodeLog, TrainingEpisode
from heron.learning.runs import TrainingRun
from heron.learning.summary import BINS, CURVES, row_of
from heron.learning.training import CHECKPOINT, LOG
from heron.variants import Formulation, LearningArm

ONE = TrainingEpisode(0, 0.0, 100, 0.0, *([0] * 7), *([0.0] * 3))


def row(arm: LearningArm, seed: int, **numbers: float | None) -> Value:
    """A training as the thesis and our expectations have it."""
    run = TrainingRun(Formulation.STEPS, "ppo", arm, 1000, seed)
    found = row_of(
        run,
        [ONE._replace(steps=999)],
        {each: [ONE] for each in (LearningArm.GUARD, LearningArm.UNGUARDED)},
    )
    is_safe = is_guarded(arm)
    expected: Value = {
        "touched": 0 if is_safe else 20 + seed,
        "too_hard": 0 if is_safe else 30 + seed,
        "near_person": 0 if is_safe else 40 + seed,
        "violating_late": {LearningArm.UNGUARDED: 0.5}.get(arm, 0.1) + seed / 100,
        "steps_to_good": 500.0 + seed + (0 if is_safe else 200),
        "violating_unguarded": {LearningArm.GUARD: 0.6}.get(arm, 0.2) + seed / 100,
        "inserted_guard": 1.0,
        "inserted_unguarded": 1.0,
        "intervened_early": 0.5 + seed / 100,
        "intervened_late": 0.1,
    }
    return {**found, **expected, **numbers}


def rows(seeds: Iterable[int] = range(10), **numbers: float | None) -> list[Value]:
    return [row(arm, seed, **numbers) for seed in seeds for arm in LearningArm]


def verdicts(found: list[Value]) -> dict[str, ExpectationVerdict]:
    (trainings,) = trainings_of(found)
    return {claim.key: claim.verdict for claim in expectations_of(trainings)}


def test_what_is_expected_comes_out() -> None:
    found = verdicts(rows())
    assert set(found.values()) == {ExpectationVerdict.HOLDS}
    assert len(found) == 3 * 5 + 2 + 6


@pytest.mark.parametrize(
    ("changed", "key"),
    [
        ({"broken": 1.0}, "none guard broken"),
        ({"executed_outside": 1.0}, "none executed executed_outside"),
        ({"touched": 5.0}, "unguarded touched > guard touched"),
        ({"violating_late": 0.5}, "unguarded violating_late > ended violating_late"),
        ({"steps_to_good": None}, "unguarded steps_to_good > guard steps_to_good"),
        ({"violating_unguarded": 0.0}, "guard violating_unguarded > guard violating_guard"),
        (
            {"violating_unguarded": 0.4},
            "guard violating_unguarded > guard_feedback violating_unguarded",
        ),
        ({"inserted_guard": 0.5}, "as good"),
        ({"intervened_late": 0.9}, "less later"),
    ],
)
def test_what_comes_out_otherwise_is_reported(changed: dict[str, float | None], key: str) -> None:
    found = verdicts(rows(range(10), **changed))
    assert found[key] is not ExpectationVerdict.HOLDS


def test_learning_from_executed_actions_may_take_longer() -> None:
    slow = [
        each | {"steps_to_good": 900.0} if each["arm"] == "executed" else each for each in rows()
    ]
    assert verdicts(slow)["executed as soon"] is ExpectationVerdict.FAILS


def test_what_happens_in_no_arm_tells_nothing() -> None:
    found = verdicts(rows(range(10), touched=0.0, steps_to_good=None))
    assert found["unguarded touched > guard touched"] is ExpectationVerdict.OPEN
    assert found["unguarded steps_to_good > guard steps_to_good"] is ExpectationVerdict.OPEN


def test_a_single_seed_tells_little() -> None:
    assert ExpectationVerdict.OPEN in verdicts(rows([0])).values()


def test_the_page_has_all_trainings_of_its_folder(tmp_path: Path) -> None:
    folder = LearningFolder(tmp_path)
    folder.rows.parent.mkdir()
    write_learning_page(folder, {str(number): each for number, each in enumerate(rows([0, 1]))})
    tree = [each | {"formulation": "tree", "algorithm": "cma-es"} for each in rows([0])]
    page = write_learning_page(folder, {str(number): each for number, each in enumerate(tree)})
    text = page.read_text(encoding="utf-8")
    assert "## A policy of velocities, by PPO" in text
    assert "Seeds: 2. Steps of a training: 1,000." in text
    assert "## The numbers of a behavior tree, by CMA-ES" in text
    assert (folder.rows.parent / "steps-ppo-1000.svg").read_bytes().startswith(b"<?xml")
    assert len(read_rows(folder.rows)) == 3 * len(LearningArm)
    write_learning_page(folder, {})
    assert page.read_text(encoding="utf-8") == text


def test_rows_are_read_as_they_were_written(tmp_path: Path) -> None:
    folder = LearningFolder(tmp_path)
    folder.rows.parent.mkdir()
    write_learning_page(folder, {"a": row(LearningArm.GUARD, 3)})
    (found,) = read_rows(folder.rows)
    assert found == row(LearningArm.GUARD, 3)
    assert all(f"{name}_{place:02}" in found for name in CURVES for place in range(BINS))


def test_trainings_are_watched_by_their_logs(tmp_path: Path) -> None:
    run = TrainingRun(Formulation.STEPS, "ppo", LearningArm.GUARD, 1000, 0)
    other = TrainingRun(Formulation.STEPS, "ppo", LearningArm.UNGUARDED, 1000, 0)
    watch = TrainingLogs(tmp_path, [other, run])
    ((_, _, found),) = watch.look()
    assert dict(found)["episodes"] == ["0", "0"]
    (tmp_path / run.folder).mkdir()
    log = EpisodeLog(tmp_path / run.folder / LOG, 0)
    log.append(ONE._replace(steps=100, inserted=1))
    for _ in range(2):
        ((title, arms, found),) = watch.look()
        assert title == "a policy of velocities, ppo"
        assert arms == ["unguarded", "guard"]
        assert dict(found)["episodes"] == ["0", "1"]
        assert dict(found)["inserted, of the last episodes"] == ["", "100 %"]
    log.append(ONE._replace(steps=2000, broken=1, touched=1, proposed_outside=50))
    watch.note_end(run.key)
    ((_, _, found),) = watch.look()
    assert {label: cells[1] for label, cells in found} == {
        "trainings over": "1 of 1",
        "steps": "2,000",
        "episodes": "2",
        "inserted, of the last episodes": "50 %",
        "proposed outside the rules, of the steps": "25 %",
        "episodes with a violation": "1",
        "fragile parts broken": "1",
    }


def heron(*words: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "heron", *words], capture_output=True, text=True, check=False
    )


def test_a_study_is_run_and_gone_on_with(tmp_path: Path) -> None:
    command = ("learn", "tree", "--arm", "guard", "--steps", "300", "--out", tmp_path)
    found = heron(*command)
    assert found.returncode == 0
    assert "1 of 1" in found.stderr
    assert "learning.md" in found.stdout
    again = heron(*command, "--arm", "unguarded")
    assert again.returncode == 0
    assert "1 of 2 are done already" in again.stderr
    page = (tmp_path / "learning.md").read_text(encoding="utf-8")
    assert "| | unguarded | guard |" in page


def test_a_checkpoint_of_something_else_is_reported(tmp_path: Path) -> None:
    run = TrainingRun(Formulation.TREE, "cma-es", LearningArm.GUARD, 300, 0)
    folder = LearningFolder(tmp_path).trainings / run.folder
    folder.mkdir(parents=True)
    (folder / CHECKPOINT).write_text("something else")
    found = heron("learn", "tree", "--arm", "guard", "--steps", "300", "--out", tmp_path)
    assert found.returncode == 1
    assert "checkpoint belongs to another training; remove it" in " ".join(found.stderr.split())
    assert f"not finished (run the same command again): {run.key}" in found.stderr
    assert "Traceback" not in found.stderr
