"""Computation of lessons from runs, by counting observations only."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass

from ezskiros.learning.lessons import Cost, Lessons, Places, Share, SkillFailure, Stale, Trip
from ezskiros.learning.runs import TaskRun
from ezskiros.learning.seen import Hit, activations, hits
from ezskiros.learning.traces import Execution, TaskTrace


def learn(runs: Sequence[TaskRun], locations: Set[str]) -> Lessons:
    """The lessons of some runs. `locations` are the IRIs of the individuals that count as
    places.
    """
    gathering = _Gathering(runs, lambda execution: _places(execution, locations))
    return Lessons(
        len(runs),
        sorted(gathering.trips(), key=lambda each: (-each.share.runs, each.rule, each.skill or "")),
        sorted(gathering.failures(), key=lambda each: (-each.share.runs, each.skill)),
        sorted(gathering.costs(), key=lambda each: (-each.expected_s, each.skill, each.places)),
        list(gathering.stale()),
    )


def _places(execution: Execution, locations: Set[str]) -> Places:
    return tuple(sorted(each for each in execution.values.items() if each[1] in locations))


@dataclass(frozen=True, eq=False)
class _Blame:
    """A hit, and one of the innermost running executions; None if no skill ran."""

    run: int
    hit: Hit
    execution: Execution | None


class _Gathering:
    def __init__(self, runs: Sequence[TaskRun], places: Callable[[Execution], Places]) -> None:
        self._runs, self._places = runs, places
        self._hits = [list(hits(run)) for run in runs]

    def costs(self) -> Iterator[Cost]:
        """The costs of skills on all levels, because a plan may call any of them."""
        executions: Counter[tuple[str, Places]] = Counter()
        losses: defaultdict[tuple[str, Places], list[float]] = defaultdict(list)
        for run in self._runs:
            executions.update(map(self._key, run.trace.executions))
        for found in self._hits:
            for hit in found:
                for key in {self._key(each) for each in hit.running}:
                    losses[key].append(hit.lost_s)
        for (skill, places), count in executions.items():
            lost = losses[skill, places]
            yield Cost(skill, places, count, len(lost), round(sum(lost, 0.0), 3))

    def _key(self, execution: Execution) -> tuple[str, Places]:
        return execution.skill, self._places(execution)

    # --- rules ------------------------------------------------------------------------------------

    def trips(self) -> Iterator[Trip]:
        """The rules with the skills during which they became active."""
        blamed: defaultdict[tuple[str, str | None], list[_Blame]] = defaultdict(list)
        for each in self._blames():
            skill = each.execution.skill if each.execution else None
            blamed[each.hit.activation.rule, skill].append(each)
        for (rule, skill), found in blamed.items():
            yield self._trip(rule, skill, found)

    def _blames(self) -> Iterator[_Blame]:
        for number, found in enumerate(self._hits):
            for hit in found:
                for execution in hit.innermost or (None,):
                    yield _Blame(number, hit, execution)

    def _trip(self, rule: str, skill: str | None, found: Sequence[_Blame]) -> Trip:
        watched = [n for n, run in enumerate(self._runs) if rule in run.verdicts.rules]
        of_skill = {n: set(self._ran(n, skill)) for n in watched}
        unique = {id(each.hit): each.hit for each in found}.values()
        return Trip(
            rule,
            skill,
            Share(_runs(found), sum(bool(each) for each in of_skill.values())),
            len(unique),
            round(sum((hit.lost_s for hit in unique), 0.0), 3),
            _within(found),
            self._at(found, of_skill.values()),
            found[0].hit.activation.cause,
        )

    def _ran(self, number: int, skill: str | None) -> Iterator[Places]:
        """The places with which a skill ran in a run, including the case without any place. Times
        without a running skill count as a run of no skill.
        """
        if skill is None:
            yield ()
        for each in self._runs[number].trace.executions:
            if each.skill == skill:
                yield self._places(each)

    def _at(self, found: Sequence[_Blame], ran: Iterable[Set[Places]]) -> Mapping[Places, Share]:
        runs: defaultdict[Places, set[int]] = defaultdict(set)
        for each in found:
            if each.execution is not None:
                runs[self._places(each.execution)].add(each.run)
        counts = Counter(places for each in ran for places in each)
        in_order = sorted(counts, key=lambda places: (-len(runs[places]), places))
        return {each: Share(len(runs[each]), counts[each]) for each in in_order}

    def stale(self) -> Iterator[Stale]:
        """The rules that became active because of a stale input."""
        counts = Counter(
            rule
            for run in self._runs
            for rule in {each.rule for each in activations(run) if each.is_stale}
        )
        for rule, count in sorted(counts.items()):
            watched = sum(rule in run.verdicts.rules for run in self._runs)
            yield Stale(rule, Share(count, watched))

    # --- failures ---------------------------------------------------------------------------------

    def failures(self) -> Iterator[SkillFailure]:
        """The skills that failed by themselves."""
        reasons: defaultdict[str, list[tuple[int, str]]] = defaultdict(list)
        started: Counter[str] = Counter()
        for number, run in enumerate(self._runs):
            started.update({each.skill for each in run.trace.executions})
            for each in _failed(run.trace):
                reasons[each.skill].append((number, each.reason))
        for skill, found in reasons.items():
            share = Share(len({number for number, _ in found}), started[skill])
            (most, _) = Counter(text for _, text in found).most_common(1)[0]
            yield SkillFailure(skill, share, most)


def _runs(found: Iterable[_Blame]) -> int:
    return len({each.run for each in found})


def _within(found: Iterable[_Blame]) -> Mapping[str, int]:
    """The number of activations by the parents of the innermost skills."""
    counts: Counter[str] = Counter()
    for each in found:
        if each.execution is None:
            continue
        above = each.execution.path[:-1]
        counts.update({other.skill for other in each.hit.running if other.path == above})
    return dict(sorted(counts.items(), key=lambda each: (-each[1], each[0])))


def _failed(trace: TaskTrace) -> Iterator[Execution]:
    """The failed executions, except those that failed because of a child."""
    explained: set[tuple[str, ...]] = set()
    for each in trace.executions:
        above = each.path[:-1]
        if each.outcome == "succeeded":
            explained.discard(above)
        elif each.outcome == "failed":
            if each.path not in explained:
                yield each
            explained.add(above)
        explained.discard(each.path)
