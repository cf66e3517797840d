"""The walk through a behavior tree: what is known before and after each node."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace

from ezskiros.check.inference import names as names_of
from ezskiros.contracts.changing import changed, failed, join
from ezskiros.contracts.children import Child, SkillOf, child_of
from ezskiros.contracts.findings import Findings
from ezskiros.contracts.judge import Judge
from ezskiros.contracts.knowledge import Change, How, Known, Origin
from ezskiros.contracts.statements import Asked, renamed
from ezskiros.skills.nodes import (
    Decoration,
    Decorator,
    Flow,
    Node,
    Processor,
    SkillCall,
    calls,
    children,
)

MOST_TRIES = 5
"""Of a retry that are looked at, until no further one has less to rely on."""


@dataclass(frozen=True)
class Outcome:
    """What is known when a node has succeeded, on all ways and on each, and when it has failed."""

    success: Known
    endings: tuple[Known, ...]
    failures: tuple[Known, ...]


@dataclass(frozen=True)
class Place:
    """Where a node is: whether the compound fails with it, and whether findings are told."""

    is_fatal: bool = True
    is_told: bool = True


@dataclass
class Walk:
    """Through one tree. `held` is what the compound holds while it runs."""

    judge: Judge
    findings: Findings
    skill_of: SkillOf
    held: Sequence[Asked]
    _started: dict[int, list[Asked]] = field(default_factory=dict)
    """By calls: what was known to hold when they started first."""

    def through(self, node: Node, known: Known, place: Place = Place()) -> Outcome:
        """What becomes of what is known."""
        match node:
            case SkillCall():
                return self._skill(node, known, place)
            case Decorator(decoration=decoration, child=child, limit=limit):
                return self._decorated(decoration, child, limit or 1, known, place)
            case Processor(flow=Flow.SERIAL | Flow.SERIAL_STAR, children=below):
                is_restarting = node.flow is Flow.SERIAL
                return self._sequence(below, known, place, is_restarting=is_restarting)
            case Processor(flow=Flow.SELECTOR | Flow.SELECTOR_STAR, children=below):
                return self._selector(below, known, place)
            case Processor(flow=Flow.NO_FAIL, children=below):
                inner = self._sequence(below, known, replace(place, is_fatal=False))
                ways = (*inner.endings, *inner.failures)
                return Outcome(join(ways, self.judge), ways, ())
            case Processor(flow=flow, children=below):
                return self._parallel(below, known, place, is_race=flow is Flow.PARALLEL_FS)
        raise AssertionError(node)

    # --- skills -----------------------------------------------------------------------------------

    def _skill(self, call: SkillCall, known: Known, place: Place) -> Outcome:
        child = child_of(call, self.skill_of(call), known)
        self._hold(child, known, place)
        asked = child.asked(known)
        free = child.inferred(known)
        ready = known.binding(child.bound())
        wrong = self._judged(child, asked, free, known, place)
        about_free = [each for each in asked if not set(free).isdisjoint(names_of(each.statement))]
        is_found = not any(each in wrong for each in about_free)
        started = self.judge.merged(self._assuming(ready, asked, child))
        self._started.setdefault(id(call), [each for each in asked if each not in wrong])
        again = child_of(call, child.skill, started)
        after = changed(started, list(again.changes(How.DONE)), self.judge)
        after = after.binding(again.outputs())
        if any(is_false for is_false in wrong.values()):
            return Outcome(replace(after, is_dead=True), (replace(after, is_dead=True),), (known,))
        before = self._assuming(ready, about_free, child) if is_found else known
        before = self.judge.merged(before)
        again = child_of(call, child.skill, before)
        failure = failed(before, list(again.changes(How.FAILED)), self.judge)
        return Outcome(after, (after,), (failure.by(f"`{child.label}` has failed"),))

    def _judged(
        self, child: Child, asked: Sequence[Asked], free: Sequence[str], known: Known, place: Place
    ) -> dict[Asked, bool]:
        """The conditions of a child that need not hold; whether they are certain not to."""
        about = [
            each.statement for each in asked if not set(free).isdisjoint(names_of(each.statement))
        ]
        chosen = self.judge.choice(known, about, free) if about else {}
        wrong: dict[Asked, bool] = {}
        for each in asked:
            if self.judge.entails(known, renamed(each.statement, chosen)):
                continue
            clash = self.judge.clash(known, each.statement)
            wrong[each] = clash is not None
            if not place.is_told:
                continue
            if clash is not None:
                self.findings.false_at_start(
                    child.call, each, known, clash, is_fatal=place.is_fatal
                )
            else:
                self.findings.unknown_at_start(child.call, each, known, is_fatal=place.is_fatal)
        return wrong

    def _assuming(self, known: Known, asked: Iterable[Asked], child: Child) -> Known:
        """What is known when a child has started: what it asks for holds, what that excludes does
        not.
        """
        for each in asked:
            while clash := self.judge.clash(known, each.statement):
                lost = [fact for fact in known.facts if fact in clash.said]
                if not lost:
                    return known
                known = known.without(lost)
            origin = Origin(each.clause.span, each.kind, child.call)
            known = known.assuming({each.statement: origin})
        return known

    def _hold(self, child: Child, known: Known, place: Place) -> None:
        for each in self.held if place.is_told else ():
            if not self.judge.entails(known, each.statement):
                clash = self.judge.clash(known, each.statement)
                self.findings.hold(child.call, each, known, clash)

    # --- processors -------------------------------------------------------------------------------

    def _sequence(
        self, below: Sequence[Node], known: Known, place: Place, *, is_restarting: bool = False
    ) -> Outcome:
        failures: list[Known] = []
        endings: tuple[Known, ...] = (known,)
        for index, node in enumerate(below):
            if is_restarting and place.is_told:
                self._restart(below[:index], known, "a serial starts it again in each tick")
            outcome = self.through(node, known, place)
            known, endings = outcome.success, outcome.endings
            failures += outcome.failures
        return Outcome(known, endings, tuple(failures))

    def _selector(self, below: Sequence[Node], known: Known, place: Place) -> Outcome:
        inner = place if len(below) == 1 else replace(place, is_fatal=False)
        endings: list[Known] = []
        failures: tuple[Known, ...] = (known,)
        for node in below:
            before = join(failures, self.judge) if failures else replace(known, is_dead=True)
            outcome = self.through(node, before, inner)
            names = " and ".join(f"`{each.skill.__name__}`" for each in calls(node))
            endings += [each.by(f"{names} succeeded") for each in outcome.endings]
            failures = outcome.failures
        return Outcome(join(endings, self.judge), tuple(endings), failures)

    def _parallel(
        self, below: Sequence[Node], known: Known, place: Place, *, is_race: bool
    ) -> Outcome:
        own = [list(self._changes(node, known, How.BESIDE)) for node in below]
        outcomes = []
        for index, node in enumerate(below):
            beside = [each for other in (*own[:index], *own[index + 1 :]) for each in other]
            is_first = index == 0 or not is_race  # else the first may be done before it starts
            own_place = replace(place, is_fatal=place.is_fatal and is_first)
            before = failed(known, beside, self.judge)
            others = (*below[:index], *below[index + 1 :])
            before = before.binding(name for each in others for name in self._found(each, known))
            outcome = self.through(node, before, own_place)
            if len(below) > 1 and not is_race and place.is_told:
                again = "SkiROS2 starts it again in each tick until the others are done"
                self._restart([node], outcome.success, again)
            kept = failed(outcome.success, beside, self.judge)
            outcomes.append(replace(outcome, success=kept))
        everything = [each for changes in own for each in changes]
        stopped = failed(known, everything, self.judge).by("a child of the parallel has failed")
        endings = tuple(each.success for each in outcomes)
        if is_race:
            return Outcome(join(endings, self.judge), endings, (stopped,))
        merged = endings[0] if endings else known
        for each in endings[1:]:
            merged = replace(
                merged.assuming(each.facts).binding(each.bound),
                same={**merged.same, **each.same},
                changes=tuple(dict.fromkeys((*merged.changes, *each.changes))),
                is_dead=merged.is_dead or each.is_dead,
            )
        return Outcome(merged, (merged,), (stopped,))

    def _changes(self, node: Node, known: Known, how: How) -> Iterator[Change]:
        """All that may be changed below a node."""
        for call in calls(node):
            yield from child_of(call, self.skill_of(call), known).changes(how)

    def _found(self, node: Node, known: Known) -> Iterator[str]:
        """Names for which a node may find things."""
        for call in calls(node):
            yield from child_of(call, self.skill_of(call), known).bound()

    # --- decorators -------------------------------------------------------------------------------

    def _decorated(
        self, decoration: Decoration, child: Node, limit: float, known: Known, place: Place
    ) -> Outcome:
        if decoration is Decoration.INVERTER:
            inner = self.through(child, known, replace(place, is_fatal=False))
            failures = inner.failures or (replace(inner.success, is_dead=True),)
            return Outcome(join(failures, self.judge), failures, (inner.success,))
        outcome = self.through(child, known, place)
        if decoration is Decoration.TIMEOUT:
            stopped = failed(known, list(self._changes(child, known, How.FAILED)), self.judge)
            late = stopped.by("the time was over")
            return replace(outcome, failures=(*outcome.failures, late))
        return self._retried(child, int(limit), outcome, place)

    def _retried(self, child: Node, limit: int, outcome: Outcome, place: Place) -> Outcome:
        """Further tries start where one has failed; they may fail in turn."""
        endings, failures = outcome.endings, outcome.failures
        if limit > 1 and place.is_told:
            for each in failures:
                self._restart([child], each, "the retry starts it again", is_certain=True)
        for _ in range(min(limit - 1, MOST_TRIES) if failures else 0):
            before = join(failures, self.judge)
            again = self.through(child, before, replace(place, is_told=False, is_fatal=False))
            endings = (*endings, *again.endings)
            failures = again.failures
            if join(failures, self.judge).facts.keys() == before.facts.keys():
                break
        return Outcome(join(endings, self.judge), endings, failures)

    # --- children that are started again ----------------------------------------------------------

    def _restart(
        self, below: Sequence[Node], known: Known, again: str, *, is_certain: bool = False
    ) -> None:
        """Whether children can start again; with `is_certain` only that they cannot is told."""
        for call in (first for node in below for first in _first_calls(node)):
            for each in self._started.get(id(call), ()):
                if self.judge.entails(known, each.statement):
                    continue
                clash = self.judge.clash(known, each.statement)
                if clash or (not is_certain and self.findings.last_touching(known, each.statement)):
                    self.findings.restart(call, each, known, clash, again)
                    break


def _first_calls(node: Node) -> Iterator[SkillCall]:
    """The skills that a node may start with."""
    if isinstance(node, SkillCall):
        yield node
        return
    below = children(node)
    is_one = isinstance(node, Processor) and node.flow not in (
        Flow.PARALLEL_FF,
        Flow.PARALLEL_FS,
    )
    for child in below[:1] if is_one else below:
        yield from _first_calls(child)
