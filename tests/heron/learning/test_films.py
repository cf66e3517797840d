"""Episodes of the task as films, and pictures of its environment: who looks on changes nothing."""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import pytest
from numpy.typing import NDArray

from support.c_compiler import needs_c
from support.parts import EGL, MUJOCO, needs, require

require(MUJOCO)

import gymnasium
from gymnasium.utils.env_checker import check_env
from PIL import Image

import heron.learning  # noqa: F401  # registers the environments
from heron.appearance import CannotDrawError
from heron.films import Film, insertion
from heron.films.clip import STRIP, Caption, with_caption
from heron.films.insertion import InsertionClip, film_of_insertion
from heron.films.movie import write_movie
from heron.learning.arms import ARM_NAMES, guarded
from heron.learning.environment import PegInHole
from heron.learning.insertion import PERIOD_NS
from heron.variants import LearningArm

Floats = NDArray[np.float64]
Result = TypeVar("Result")


@pytest.fixture(autouse=True)
def found_by_others(monkeypatch: pytest.MonkeyPatch) -> None:
    """Processes that draw find the functions of this module by its name."""
    monkeypatch.syspath_prepend(str(Path(__file__).parents[3]))


NAME = "heron/PegInHole-v1"
HOLE = np.array([-0.6, 0.0, 0.7])
GLASS = np.array([-0.5, 0.3, 0.75])
SEED = 1  # of an episode to which somebody comes


def into_the_fragile_part(seen: Floats) -> NDArray[np.float32]:
    wanted = np.array([*(-3.0 * (seen[:3] - GLASS)), -5.0])
    return np.asarray(np.clip(wanted, [*[-0.3] * 3, -10.0], [*[0.3] * 3, 0.0]), np.float32)


def into_the_hole(seen: Floats) -> NDArray[np.float32]:
    """Above the hole first, then down."""
    offset = seen[:3] - HOLE
    is_above = float(np.hypot(*offset[:2])) < 0.002
    down = -0.1 if is_above else -3.0 * (offset[2] - 0.05)
    wanted = np.array([*(-3.0 * offset[:2]), down, 0.0])
    return np.asarray(np.clip(wanted, -0.3, 0.3), np.float32)


def drawing(work: Callable[..., Result], *arguments: Any) -> Result:
    """The result of a call in a process of its own, which alone looks at how to draw."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setenv("MUJOCO_GL", "egl")
        with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
            return pool.submit(work, *arguments).result()


def observations(arm: LearningArm, seed: int) -> list[list[float]]:
    """An episode that nobody looks at."""
    env = guarded(PegInHole(), arm)
    seen, _ = env.reset(seed=seed)
    found, is_over = [seen.tolist()], False
    while not is_over:
        seen, _, terminated, truncated, _ = env.step(into_the_fragile_part(seen))
        found.append(seen.tolist())
        is_over = terminated or truncated
    return found


@pytest.fixture(scope="module")
def clips() -> dict[LearningArm, InsertionClip]:
    arms = (LearningArm.UNGUARDED, LearningArm.GUARD, LearningArm.ENDED)
    return {arm: film_of_insertion(into_the_fragile_part, arm, SEED) for arm in arms}


@needs_c
@pytest.mark.parametrize("arm", [LearningArm.UNGUARDED, LearningArm.GUARD])
def test_a_film_changes_nothing(arm: LearningArm) -> None:
    seen: list[list[float]] = []

    def noting(observation: Floats) -> NDArray[np.float32]:
        seen.append(observation.tolist())
        return into_the_fragile_part(observation)

    clip = film_of_insertion(noting, arm, SEED)
    *expected, _ = observations(arm, SEED)
    assert seen == expected
    assert clip.film.duration == pytest.approx((len(seen) + 1) * PERIOD_NS * 1e-9)


def captions(
    clip: InsertionClip, times: Sequence[float], monkeypatch: pytest.MonkeyPatch
) -> list[Caption]:
    """The words below pictures, without the pictures."""

    def pictures(_film: Film, _cameras: Any, times: Sequence[float], _size: Any) -> Iterator[None]:
        return iter([None] * len(times))

    with monkeypatch.context() as patched:
        patched.setattr(Film, "pictures", pictures)
        patched.setattr(insertion, "with_caption", lambda _pixels, caption: caption)
        found: Any = list(clip.pictures(times, 1, (480, 320)))
    return list(found)


@needs_c
def test_without_rules_it_tells_what_goes_wrong(
    clips: dict[LearningArm, InsertionClip], monkeypatch: pytest.MonkeyPatch
) -> None:
    clip = clips[LearningArm.UNGUARDED]
    start, wrong, end = captions(clip, [0.0, 6.0, clip.duration], monkeypatch)
    assert {each.title for each in (start, wrong, end)} == {"unguarded"}
    assert (start.time[0], start.state[0], start.signal[0]) == (
        "0.0 s",
        "wrist 0 N, person 2.4 m",
        "",
    )
    assert wrong.signal[0] == "broke the fragile part"
    assert wrong.names[0] == "would act: touch_in_v3_only"
    assert "keep_before_v2" in wrong.names
    assert end.time[0] == "not inserted after 12.0 s"
    assert end.names == ("broke the fragile part", "pressed too hard")
    assert 0.5 < clip.opening < 6.0, "it begins with the harm"


@needs_c
def test_with_rules_it_tells_which_are_active(
    clips: dict[LearningArm, InsertionClip], monkeypatch: pytest.MonkeyPatch
) -> None:
    clip = clips[LearningArm.GUARD]
    start, early, late, end = captions(clip, [0.0, 6.0, 10.5, clip.duration], monkeypatch)
    assert start.names == ()
    assert "keep_before_v2" in early.names
    assert "slow_near_person" not in early.names
    assert late.names[0] == "slow_near_person", "the latest comes first"
    assert set(early.names) < set(late.names)
    assert (end.time[0], end.names) == ("not inserted after 12.0 s", ())
    assert {each.signal[0] for each in (start, early, late)} == {""}
    assert clip.opening == 0.0, "there is no harm to begin with"


@needs_c
def test_an_episode_ends_when_it_does(
    clips: dict[LearningArm, InsertionClip], monkeypatch: pytest.MonkeyPatch
) -> None:
    ended = clips[LearningArm.ENDED]
    assert ended.duration < 6.0
    clip = film_of_insertion(into_the_hole, LearningArm.GUARD, 3)
    before, end, after = captions(
        clip, [clip.duration - 0.04, clip.duration, clip.duration + 1.0], monkeypatch
    )
    assert before.time[0].endswith(" s")
    assert end.time[0] == f"inserted after {clip.duration:.1f} s"
    assert (end, end.names) == (after, ())


def test_every_arm_has_a_title() -> None:
    assert list(ARM_NAMES) == list(LearningArm)


@pytest.mark.parametrize(("count", "is_whole"), [(2, True), (20, False)])
def test_names_that_do_not_fit_are_counted(count: int, is_whole: bool) -> None:
    names = [f"keep_before_v{number}" for number in range(count)]
    picture = np.zeros((30, 400, 3), np.uint8)
    shown = with_caption(picture, Caption("guard", ("1.0 s", (0, 0, 0)), names=names))
    assert shown.shape == (30 + STRIP, 400, 3)
    line = shown[30 + 41 :].astype(int)
    assert (line[:, -10:] == 255).all(), "there is a margin"
    assert (line[:, 300:] == 255).all() == is_whole


def _rendered(steps: int) -> tuple[list[list[float]], list[NDArray[np.uint8]]]:
    env = gymnasium.make(NAME, disable_env_checker=True, render_mode="rgb_array")
    seen, _ = env.reset(seed=SEED)
    found, pictures = [seen.tolist()], []
    for _ in range(steps):
        picture: Any = env.render()
        pictures.append(picture)
        seen, *_ = env.step(into_the_fragile_part(seen))
        found.append(seen.tolist())
    env.close()
    env.close()
    return found, pictures


@needs(EGL)
def test_a_picture_changes_nothing_and_shows_what_moves() -> None:
    found, pictures = drawing(_rendered, 25)
    assert found == observations(LearningArm.UNGUARDED, SEED)[:26]
    assert {picture.shape for picture in pictures} == {(400, 640, 3)}
    first, last = (pictures[place].astype(int) for place in (0, -1))
    assert np.abs(first - last).max() > 50
    redness = (first[..., 0] - first[..., 1] > 40) & (first[..., 0] - first[..., 2] > 40)
    greenness = (first[..., 1] - first[..., 0] > 15) & (first[..., 1] - first[..., 2] > 10)
    assert redness.mean() > 0.005, "the volume that is forbidden"
    assert greenness.mean() > 0.0005, "and the one in which contact is allowed"


def _checked() -> None:
    env = gymnasium.make(NAME, disable_env_checker=True, render_mode="rgb_array")
    check_env(env.unwrapped)


@pytest.mark.filterwarnings("ignore:.*(symmetric and normalized|probably too)")
@needs(EGL)
def test_it_is_an_environment_that_draws() -> None:
    drawing(_checked)


def test_an_environment_draws_only_when_it_is_asked_to() -> None:
    assert PegInHole().metadata == {"render_modes": ["rgb_array"], "render_fps": 25}
    assert PegInHole().render() is None
    with pytest.raises(ValueError, match="`render_mode` is None or \"rgb_array\", not 'human'"):
        PegInHole(render_mode="human")


def _undrawn() -> str:
    try:
        PegInHole(render_mode="rgb_array").render()
    except CannotDrawError as error:
        return str(error)
    return "it was drawn"


def test_where_nothing_can_be_drawn_it_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MUJOCO_GL", "disable")
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        assert pool.submit(_undrawn).result() == "there is no EGL"


def _written(path: Path) -> None:
    arms = (LearningArm.ENDED, LearningArm.GUARD)
    clips = [film_of_insertion(into_the_fragile_part, arm, SEED) for arm in arms]
    short = [InsertionClip(c.arm, c.outcome, c.film, c.instants[:50]) for c in clips]
    for clip in short:
        clip.outcome.seconds = min(clip.outcome.seconds, 1.0)
    write_movie(path, short, (96, 64))


@needs_c
@needs(EGL)
def test_two_episodes_are_shown_beside_each_other(tmp_path: Path) -> None:
    path = tmp_path / "two.webp"
    drawing(_written, path)
    with Image.open(path) as film:
        assert film.size == (2 * 96 + 8, 64 + STRIP)
        assert getattr(film, "n_frames", 1) > 8
