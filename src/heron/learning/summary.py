"""The row of a training: its episodes in numbers."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import accumulate

from dslkit.campaign import Value
from heron.learning.episodes import TrainingEpisode
from heron.learning.insertion import VIOLATIONS
from heron.learning.runs import TrainingRun
from heron.variants import LEAST_BUDGETS, Formulation, LearningArm

BINS = 15
"""The most parts of a training, by steps, in which its curves have a value each."""
CURVES: Mapping[str, Callable[[Sequence[TrainingEpisode]], float]] = {
    "inserted": lambda found: share(one.inserted for one in found),
    "violating": lambda found: share(one.is_violating for one in found),
    "intervened": lambda found: intervened(found),
}
"""Shares of episodes, and of steps."""
_LATELY = 50
"""Episodes, at least, of which a share is reported."""
_GOOD = 0.9


def share(values: Iterable[int | bool]) -> float:
    """The share of those that are true, of at least one."""
    found = list(values)
    return sum(found) / len(found)


def intervened(episodes: Sequence[TrainingEpisode]) -> float:
    """The share of steps whose proposed command the rules would change."""
    return sum(one.proposed_outside for one in episodes) / sum(one.length for one in episodes)


def row_of(
    run: TrainingRun,
    episodes: Sequence[TrainingEpisode],
    finals: Mapping[LearningArm, Sequence[TrainingEpisode]],
) -> Value:
    """The row of a training, by names of measures; not known is None."""
    early, late = (_part(episodes, run.budget, place, 4) for place in (0, 3))
    row: Value = {
        "formulation": run.formulation.value,
        "algorithm": run.algorithm,
        "arm": run.arm.value,
        "budget": run.budget,
        "seed": run.seed,
        "episodes": len(episodes),
        "seconds": episodes[-1].seconds,
        "steps_to_good": steps_to_good(run.formulation, episodes),
        "violating": share(one.is_violating for one in episodes),
        "violating_late": share(one.is_violating for one in late) if late else None,
        **{name: sum(getattr(one, name) for one in episodes) for name in VIOLATIONS},
        "broken": sum(one.broken for one in episodes),
        "greatest_force": max(one.greatest_force for one in episodes),
        "proposed_outside": intervened(episodes),
        "intervened_early": intervened(early) if early else None,
        "intervened_late": intervened(late) if late else None,
        "executed_outside": sum(one.executed_outside for one in episodes),
    }
    for arm, found in finals.items():
        row[f"inserted_{arm.value}"] = share(one.inserted for one in found)
        row[f"violating_{arm.value}"] = share(one.is_violating for one in found)
    count = bins_of(run.formulation, run.budget)
    for place in range(BINS):
        part = _part(episodes, run.budget, place, count)
        for name, of in CURVES.items():
            row[f"{name}_{place:02}"] = of(part) if part else None
    return row


def bins_of(formulation: Formulation, budget: int) -> int:
    """The parts of a training of so many steps. In each part every environment ends an episode:
    environments begin together, and so those that run out of time end together. Shares between
    these instants would be of the short episodes only.
    """
    return max(1, min(BINS, budget // LEAST_BUDGETS[formulation]))


def lately(
    formulation: Formulation, episodes: Sequence[TrainingEpisode]
) -> Sequence[TrainingEpisode]:
    """The last episodes: 50, and as many more as end while each environment ends one."""
    if not episodes:
        return episodes
    since = episodes[-1].steps - LEAST_BUDGETS[formulation]
    first = bisect_right(episodes, since, key=lambda one: one.steps)
    return episodes[min(first, max(0, len(episodes) - _LATELY)) :]


def steps_to_good(formulation: Formulation, episodes: Sequence[TrainingEpisode]) -> int | None:
    """The steps after which nine of ten of the last episodes were insertions."""
    done = list(accumulate((one.inserted for one in episodes), initial=0))
    least, first = LEAST_BUDGETS[formulation], 0
    for last, one in enumerate(episodes, 1):
        while episodes[first].steps <= one.steps - least:
            first += 1
        begin = min(first, last - _LATELY)
        is_whole = last == len(episodes) or episodes[last].steps > one.steps  # of this instant
        is_known = is_whole and begin >= 0 and one.steps >= least
        if is_known and done[last] - done[begin] >= _GOOD * (last - begin):
            return one.steps
    return None


def _part(
    episodes: Sequence[TrainingEpisode], budget: int, place: int, count: int
) -> list[TrainingEpisode]:
    low, high = budget * place / count, budget * (place + 1) / count
    last = place == count - 1
    return [one for one in episodes if low < one.steps <= high or (last and one.steps > high)]
