"""Trainings: what they learn from, what they keep, and what they tell."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from functools import cache, partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support.parts import LEARNERS, require

require(LEARNERS)

import jax
from flax.serialization import msgpack_restore

from heron.learning import insertion, step_training, training
from heron.learning.environment import GREATEST, LEAST
from heron.learning.episodes import EpisodeLog, TrainingEpisode, read_log
from heron.learning.insertion import FIELDS
from heron.learning.policy import Policy, load_policy, scaled
from heron.learning.runs import TrainingRun, run_of, runs_of
from heron.learning.step_learners import SkrlLearner
from heron.learning.step_training import StepTraining
from heron.learning.summary import BINS, bins_of, lately, row_of, share, steps_to_good
from heron.learning.training import CHECKPOINT, LOG, train
from heron.learning.tree_training import TreeTraining
from heron.variants import ALGORITHMS, BUDGETS, LEARNING_ARMS, Formulation, LearningArm

LEARNED = [
    (Formulation.STEPS, "ppo"),
    (Formulation.STEPS, "sac"),
    (Formulation.MOVES, "ppo"),
    (Formulation.TREE, "cma-es"),
]
NOTHING = TrainingEpisode(0, 0.0, 1, 0.0, *([0] * 7), *([0.0] * 3))


class Trained(NamedTuple):
    """A training that only shows that it can be run."""

    run: TrainingRun
    folder: Path
    training: Any
    row: Mapping[str, Any]


@cache
def trained(formulation: Formulation, algorithm: str) -> Trained:
    """One for each learner: JAX compiles for longer than such a training takes."""
    is_tree = formulation is Formulation.TREE
    run = runs(formulation, algorithm, 300 if is_tree else 400)
    folder = Path(tempfile.mkdtemp())
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(training, "FINAL", 1)
        patch.setattr(step_training, "COUNT", 4)
        if not is_tree:
            patch.setattr(insertion, "LONGEST_S", 3.0)
        made = training._new(run)
        patch.setattr(training, "_new", lambda _: made)
        return Trained(run, folder / run.folder, made, train(folder, run.key))


@pytest.fixture(scope="module", autouse=True)
def clean() -> Iterator[None]:
    yield
    for learner in LEARNED:
        shutil.rmtree(trained(*learner).folder.parent)


def runs(formulation: Formulation, algorithm: str, budget: int, **more: Any) -> TrainingRun:
    arm = more.get("arm", LearningArm.GUARD_FEEDBACK)
    return TrainingRun(formulation, algorithm, arm, budget, more.get("seed", 0))


def counts(found: Sequence[TrainingEpisode]) -> list[TrainingEpisode]:
    """Episodes but for the time that they took."""
    return [one._replace(seconds=0.0) for one in found]


def test_these_are_all_learners() -> None:
    assert [(each, name) for each, names in ALGORITHMS.items() for name in names] == LEARNED


@pytest.mark.parametrize(("formulation", "algorithm"), LEARNED)
def test_each_learner_is_run_to_its_row(formulation: Formulation, algorithm: str) -> None:
    found = trained(formulation, algorithm)
    episodes = read_log(found.folder / LOG)
    assert found.row["episodes"] == len(episodes) > 0
    assert found.row["executed_outside"] == 0
    assert all(one.length <= 300 and one.reward < 20 for one in episodes)
    assert found.row["inserted_guard"] in {0.0, 1.0}
    assert not (found.folder / CHECKPOINT).exists()


@pytest.mark.parametrize(("formulation", "algorithm"), LEARNED[:3])
def test_a_policy_needs_no_learner(formulation: Formulation, algorithm: str) -> None:
    found = trained(formulation, algorithm)
    policy = load_policy(found.folder / "policy.npz")
    seen = np.random.default_rng(0).normal(0.0, 1.0, (4, len(FIELDS)))
    expected = best(found.training._learner, scaled(seen))
    for one, wanted in zip(seen, expected, strict=True):
        assert np.allclose(policy(one), wanted, atol=1e-4)


def best(learner: SkrlLearner, observations: Any) -> Any:
    """The actions of the agent of skrl itself, without chance."""
    agent = learner._agent
    inputs = np.asarray(observations, np.float32)
    values, more = agent.policy.apply(
        agent.policy.state_dict.params, {"observations": inputs}, "policy"
    )
    if "log_std" in more:
        return learner._unscaled(np.asarray(values))
    return np.argmax(np.asarray(values), axis=-1)


@pytest.mark.parametrize("content", [b"", b"no policy", b"PK\x03\x04 broken"])
def test_what_is_no_policy_is_refused(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "policy.npz"
    path.write_bytes(content)
    with pytest.raises(ValueError, match=r"policy.npz is not a policy of this task"):
        load_policy(path)


def test_a_policy_of_something_else_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "policy.npz"
    path.write_bytes(Policy([(np.zeros((3, 4)), np.zeros(4))]).file())
    with pytest.raises(ValueError, match=r"is not a policy of this task"):
        load_policy(path)


@pytest.mark.parametrize(("formulation", "algorithm"), LEARNED[:2])
def test_a_learner_knows_what_it_has_learned(
    formulation: Formulation, algorithm: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = trained(formulation, algorithm)
    monkeypatch.setattr(step_training, "COUNT", 4)
    second = StepTraining(first.run)
    second.load(first.training.save())
    assert second.steps == first.training.steps
    assert second.result() == first.training.result()
    known, again = (msgpack_restore(each.save()) for each in (first.training, second))
    same = partial(np.array_equal, equal_nan=True)  # the memory has places that are free yet
    assert jax.tree.all(jax.tree.map(same, known, again))


def test_numbers_of_a_tree_go_on_as_if_nothing_had_been() -> None:
    run = runs(Formulation.TREE, "cma-es", 4000)
    whole = TreeTraining(run)
    expected, kept = [], b""
    for episode in whole.episodes():
        expected.append(episode)
        if len(expected) == 12:  # the second generation has begun
            kept = whole.save()
    again = TreeTraining(run)
    again.load(kept)
    assert again.steps == expected[8].steps
    assert counts(list(again.episodes())) == counts(expected[9:])
    assert again.best() == whole.best()


def test_a_training_that_was_interrupted_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = runs(Formulation.TREE, "cma-es", 4000)
    monkeypatch.setattr(training, "FINAL", 1)
    train(tmp_path / "whole", run.key)
    monkeypatch.setattr(training, "_EVERY", 1)
    episodes = TreeTraining.episodes

    def interrupted(self: TreeTraining) -> Iterator[TrainingEpisode]:
        for number, episode in enumerate(episodes(self)):
            if number == 12:
                raise KeyboardInterrupt
            yield episode

    with monkeypatch.context() as patch:
        patch.setattr(TreeTraining, "episodes", interrupted)
        with pytest.raises(KeyboardInterrupt):
            train(tmp_path / "parts", run.key)
    assert (tmp_path / "parts" / run.folder / CHECKPOINT).exists()
    train(tmp_path / "parts", run.key)
    whole, parts = (read_log(tmp_path / name / run.folder / LOG) for name in ("whole", "parts"))
    assert counts(parts) == counts(whole)
    assert [one.seconds for one in parts] == sorted(one.seconds for one in parts)


@pytest.mark.parametrize(("formulation", "algorithm"), [LEARNED[0], LEARNED[3]])
@pytest.mark.parametrize("kept", [b"", b"\xc1", b"{}", b'{"steps": 1, "scores": [[1]]}', b"[1]"])
def test_a_checkpoint_of_something_else_is_refused(
    formulation: Formulation,
    algorithm: str,
    kept: bytes,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    found = trained(formulation, algorithm)
    monkeypatch.setattr(training, "_new", lambda _: found.training)
    place = tmp_path / found.run.folder
    place.mkdir()
    (place / CHECKPOINT).write_bytes(kept)
    with pytest.raises(ValueError, match=r"checkpoint belongs to another training; remove it"):
        train(tmp_path, found.run.key)


def test_a_learner_refuses_what_another_one_has_learned() -> None:
    kept = trained(*LEARNED[2]).training.save()
    with pytest.raises(ValueError, match="belongs to another learner"):
        trained(*LEARNED[0]).training.load(kept)


class Chance:
    """A learner that learns nothing, and notes what it was to learn from."""

    def __init__(self, *_: object) -> None:
        self._chance = np.random.default_rng(0)
        self.proposed: list[Any] = []
        self.own: list[Any] = []

    def act(self, observations: Any) -> Any:
        self.proposed.append(self._chance.uniform(LEAST, GREATEST, (len(observations), 4)))
        return self.proposed[-1]

    def learn(self, *given: Any) -> None:
        self.own.append(given[1])


@pytest.mark.parametrize("arm", [LearningArm.GUARD, LearningArm.EXECUTED, LearningArm.UNGUARDED])
def test_a_learner_may_take_what_was_executed_for_its_own(
    arm: LearningArm, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(step_training, "SkrlLearner", Chance)
    monkeypatch.setattr(step_training, "COUNT", 2)
    found: Any = StepTraining(runs(Formulation.STEPS, "ppo", 700, arm=arm))
    (first, second, *_) = found.episodes()
    proposed, own = (np.array(each) for each in (found._learner.proposed, found._learner.own))
    assert np.array_equal(proposed, own) == (arm is not LearningArm.EXECUTED)
    assert first.proposed_outside > 0
    is_free = arm is LearningArm.UNGUARDED
    assert first.executed_outside == (first.proposed_outside if is_free else 0)
    assert (first.steps, second.steps) == (first.length * 2, second.length * 2)


# --- logs and rows ---------------------------------------------------------------------------

EPISODES = st.builds(
    TrainingEpisode,
    *[st.integers(0, 10**6), st.floats(0, 1e4).map(lambda value: float(f"{value:.6g}"))],
    *[st.integers(1, 300), st.floats(-20, 20).map(lambda value: float(f"{value:.6g}"))],
    *[st.integers(0, 300)] * 2,
    *[st.integers(0, 1)] * 5,
    *[st.floats(0, 1e3).map(lambda value: float(f"{value:.6g}"))] * 3,
)


@given(st.lists(EPISODES, max_size=5), EPISODES)
def test_a_log_holds_what_was_written(
    tmp_path_factory: pytest.TempPathFactory, episodes: list[TrainingEpisode], half: TrainingEpisode
) -> None:
    path = tmp_path_factory.mktemp("log") / LOG
    log = EpisodeLog(path, 0)
    for one in [*episodes, half]:
        log.append(one)
    text = path.read_text(encoding="utf-8")
    path.write_text(text[: text.rindex(",")], encoding="utf-8")  # interrupted
    assert read_log(path) == episodes
    least = min((one.steps for one in episodes), default=0)
    assert EpisodeLog(path, least).episodes == [one for one in episodes if one.steps <= least]


@pytest.mark.parametrize("line", ["1,2,3", "a" + ",1" * 13, "1" + ",1" * 14, "\udcff"])
def test_a_log_of_something_else_is_refused(line: str, tmp_path: Path) -> None:
    path = tmp_path / LOG
    EpisodeLog(path, 0).append(NOTHING)
    text = path.read_text(encoding="utf-8")
    path.write_text(text + line + "\n", encoding="utf-8", errors="surrogateescape")
    with pytest.raises(ValueError, match=r"is not a log of episodes; remove its folder"):
        EpisodeLog(path, 0)


def test_nine_of_ten_of_the_last_fifty() -> None:
    def steps(*inserted: int) -> int | None:
        found = [
            NOTHING._replace(inserted=each, steps=place) for place, each in enumerate(inserted, 1)
        ]
        return steps_to_good(Formulation.TREE, found)

    assert steps(*[1] * 49) is None
    assert steps(*[1] * 50) == 50
    assert steps(*[0] * 30, *[1] * 44) is None
    assert steps(*[0] * 30, *[1] * 60) == 75
    assert steps(*[1] * 44, *[0] * 6, *[1] * 43, 0) is None
    assert steps(*[1] * 45, *[0] * 50) == 50


def side_by_side(failing: int, cycles: int) -> list[TrainingEpisode]:
    """The episodes of 32 environments: `failing` ones always run out of time, at one instant; the
    others always insert, in a third of the time.
    """
    good = [NOTHING._replace(inserted=1)] * (32 - failing)
    bad = [NOTHING] * failing
    return [
        one._replace(steps=3200 * third)
        for third in range(1, 3 * cycles + 1)
        for one in (good if third % 3 else [*good, *bad])
    ]


@pytest.mark.parametrize(("failing", "is_good"), [(16, False), (12, False), (8, True), (0, True)])
def test_episodes_that_run_out_of_time_count_as_well(failing: int, is_good: bool) -> None:
    found = side_by_side(failing, 5)
    assert (steps_to_good(Formulation.STEPS, found) is not None) == is_good
    expected = 3 * (32 - failing) / (3 * (32 - failing) + failing)
    for third in range(9_600, 48_001, 3_200):
        last = lately(Formulation.STEPS, [one for one in found if one.steps <= third])
        assert share(one.inserted for one in last) == pytest.approx(expected)


@pytest.mark.parametrize("budget", [9_600, 48_000, 150_000, 10**6])
def test_each_part_of_a_curve_has_an_end_of_each_environment(budget: int) -> None:
    count = bins_of(Formulation.STEPS, budget)
    assert 1 <= count <= BINS
    assert budget / count >= 9_600
    assert bins_of(Formulation.TREE, budget) == BINS
    row = row_of(
        runs(Formulation.STEPS, "ppo", 48_000), side_by_side(16, 5), {LearningArm.GUARD: [NOTHING]}
    )
    assert [row[f"inserted_{place:02}"] for place in range(6)] == [*[0.75] * 5, None]


def test_a_row_has_the_shares_of_its_episodes() -> None:
    run = runs(Formulation.TREE, "cma-es", 200)
    one = NOTHING._replace(length=10, proposed_outside=4)
    episodes = [
        one._replace(steps=10, touched=1, broken=1),
        one._replace(steps=20, near_person=1, proposed_outside=10),
        one._replace(steps=190, inserted=1, proposed_outside=0),
        one._replace(steps=204, inserted=1, too_hard=1, proposed_outside=1, seconds=7.5),
    ]
    finals = {LearningArm.GUARD: [one], LearningArm.UNGUARDED: [one, episodes[0]]}
    row = row_of(run, episodes, finals)
    assert row["violating"] == 0.75
    assert row["violating_late"] == 0.5
    assert (row["touched"], row["too_hard"], row["near_person"], row["broken"]) == (1, 1, 1, 1)
    assert row["proposed_outside"] == 15 / 40
    assert (row["intervened_early"], row["intervened_late"]) == (0.7, 0.05)
    assert (row["violating_guard"], row["violating_unguarded"]) == (0.0, 0.5)
    assert row["seconds"] == 7.5
    assert [row[f"inserted_{place:02}"] for place in (0, 1, 2, 14)] == [0, 0, None, 1]
    assert f"inserted_{BINS:02}" not in row


@given(
    st.sampled_from(list(Formulation)),
    st.integers(1, 10**7),
    st.integers(0, 99),
    st.data(),
)
def test_a_key_names_its_training(
    formulation: Formulation, budget: int, seed: int, data: st.DataObject
) -> None:
    algorithm = data.draw(st.sampled_from(ALGORITHMS[formulation]))
    arm = data.draw(st.sampled_from(LEARNING_ARMS[formulation]))
    run = TrainingRun(formulation, algorithm, arm, budget, seed)
    assert run_of(run.key) == run
    assert "/" not in run.folder


def test_the_first_trainings_have_all_arms() -> None:
    arms = LEARNING_ARMS[Formulation.TREE]
    found = list(runs_of(Formulation.TREE, ["cma-es"], arms, BUDGETS[Formulation.TREE], 2))
    assert [run.arm for run in found] == [*arms, *arms]
    assert LearningArm.EXECUTED not in arms
    assert [run.seed for run in found] == [0] * len(arms) + [1] * len(arms)
