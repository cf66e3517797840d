"""The walk through a behavior tree: the known conditions before and after each node."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace

from ezskiros.check.inference import names as names_of
from ezskiros.contracts.changing import changed, failed, join
from ezskiros.contracts.children import BoundChild, TreeChildren
from ezskiros.contracts.findings import TreeFindings
from ezskiros.contracts.judge import Judge
from ezskiros.contracts.knowledge import How, KnownFacts, Origin, WorldChange
from ezskiros.contracts.statements import TreeCondition, renamed
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.nodes import Decoration, Decorator, Flow, Node, Processor, calls, children
from ezskiros.skills.values import Symbol

MOST_TRIES = 5
"""The maximum number of tries of a retry that are examined, until no further try has fewer known
conditions.
"""
MOST_TICKS = 10
"""The maximum number of ticks of a running child that are examined, until a further tick has no
fewer known conditions. Beyond this, nothing is known.
"""


@dataclass(frozen=True)
class NodeOutcome:
    """The knowledge after the success of a node, on all paths together and on each path, and after
    its failure.
    """

    success: KnownFacts
    endings: tuple[KnownFacts, ...]
    failures: tuple[KnownFacts, ...]


@dataclass(frozen=True)
class Place:
    """The position of a node: whether its failure fails the compound skill, and whether to report
    findings.

    `tick` transforms the known conditions at the start of a tick while a child runs there: earlier
    children of a serial or a selector restart, parallel children continue. Findings of these
    children are reported or not. `again` gives the reason if the node restarts.
    """

    is_fatal: bool = True
    is_reported: bool = True
    tick: Callable[[KnownFacts, bool], KnownFacts] | None = None
    again: str | None = None

    def at_next_tick(self, known: KnownFacts, *, is_reported: bool) -> KnownFacts:
        """The knowledge when the next tick reaches the node."""
        return self.tick(known, is_reported) if self.tick else known


@dataclass
class TreeWalk:
    """The walk through one tree. `held` are the hold-conditions of the compound skill."""

    judge: Judge
    findings: TreeFindings
    children: TreeChildren
    held: Sequence[TreeCondition]
    _started: dict[int, list[TreeCondition]] = field(default_factory=dict)
    """The conditions that were known at the first start of each call."""
    _steps: dict[tuple[object, ...], NodeOutcome] = field(default_factory=dict)
    """The results by calls and known conditions. Most later ticks repeat the results of earlier
    ones.
    """

    def through(self, node: Node, known: KnownFacts, place: Place = Place()) -> NodeOutcome:
        """Compute the known conditions after a node."""
        match node:
            case SkillCall():
                return self._skill(node, known, place)
            case Decorator(decoration=decoration, child=child, limit=limit):
                tries = MOST_TRIES if isinstance(limit, Symbol) else int(limit or 1)
                return self._decorated(decoration, child, tries, known, place)
            case Processor(flow=Flow.SERIAL | Flow.SERIAL_STAR, children=below):
                is_restarting = node.flow is Flow.SERIAL
                return self._sequence(below, known, place, is_restarting=is_restarting)
            case Processor(flow=Flow.SELECTOR | Flow.SELECTOR_STAR, children=below):
                is_restarting = node.flow is Flow.SELECTOR
                return self._selector(below, known, place, is_restarting=is_restarting)
            case Processor(flow=Flow.NO_FAIL, children=below):
                inner = self._sequence(below, known, replace(place, is_fatal=False))
                paths = (*inner.endings, *inner.failures)
                return NodeOutcome(join(paths, self.judge), paths, ())
            case Processor(flow=Flow.PARALLEL_FF | Flow.PARALLEL_FS as flow, children=below):
                return self._parallel(below, known, place, is_race=flow is Flow.PARALLEL_FS)
            case Processor():
                raise AssertionError(node)

    # --- skills -----------------------------------------------------------------------------------

    def _skill(self, call: SkillCall, known: KnownFacts, place: Place) -> NodeOutcome:
        child = self.children.of(call, known)
        self._hold(child, known, place)
        wrong = self._judged(child, known, place)
        right = [each for each in child.asked(known) if each not in wrong]
        self._started.setdefault(id(call), right)
        if place.tick is not None:
            return self._step(child, known, wrong, place)
        key = (call, *known.without_trail)
        if key not in self._steps:
            bare = replace(known, changes={}, trail=())
            self._steps[key] = self._step(child, bare, wrong, place)
        step = self._steps[key]
        success = step.success.after(known)
        return NodeOutcome(success, (success,), tuple(each.after(known) for each in step.failures))

    def _step(
        self, child: BoundChild, known: KnownFacts, wrong: dict[TreeCondition, bool], place: Place
    ) -> NodeOutcome:
        """Follow the knowledge through a child with some conditions that may be false."""
        asked, free = child.asked(known), child.inferred(known)
        ready = known.binding(child.bound())
        about_free = [each for each in asked if not set(free).isdisjoint(names_of(each.statement))]
        is_found = not any(each in wrong for each in about_free)
        started = self.judge.merged(self._assuming(ready, asked, child))
        running = self._running(started, place)
        again = self.children.of(child.call, running)
        after = changed(running, again.changes(How.DONE), self.judge)
        after = after.binding(again.outputs())
        if any(is_false for is_false in wrong.values()):
            return NodeOutcome(
                replace(after, is_dead=True), (replace(after, is_dead=True),), (known,)
            )
        before = self._assuming(ready, about_free, child) if is_found else known
        before = self.judge.merged(before).perhaps_binding(free)
        if place.tick is not None:
            before = join((before, running), self.judge)
        again = self.children.of(child.call, before)
        failure = failed(before, again.changes(How.FAILED), self.judge)
        return NodeOutcome(after, (after,), (failure.by(f"`{child.label}` has failed"),))

    def _judged(
        self, child: BoundChild, known: KnownFacts, place: Place
    ) -> dict[TreeCondition, bool]:
        """The conditions of a child that may be false, each with whether it is certainly false."""
        asked, free = child.asked(known), child.inferred(known)
        about = [
            each.statement for each in asked if not set(free).isdisjoint(names_of(each.statement))
        ]
        chosen = self.judge.choice(known, about, free) if about else {}
        wrong: dict[TreeCondition, bool] = {}
        for each in asked:
            if self.judge.entails(known, renamed(each.statement, chosen)):
                continue
            clash = self.judge.clash(known, each.statement)
            wrong[each] = clash is not None
            if not place.is_reported:
                continue
            if place.again is not None:
                if place.is_fatal and each in self._started.get(id(child.call), ()):
                    self.findings.restart(child.call, each, known, clash, place.again)
            elif clash is not None:
                self.findings.false_at_start(
                    child.call, each, known, clash, is_fatal=place.is_fatal
                )
            else:
                self.findings.unknown_at_start(child.call, each, known, is_fatal=place.is_fatal)
        return wrong

    def _assuming(
        self, known: KnownFacts, asked: Iterable[TreeCondition], child: BoundChild
    ) -> KnownFacts:
        """The knowledge after the start of a child: its conditions hold, and facts that they
        exclude do not.
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

    def _hold(self, child: BoundChild, known: KnownFacts, place: Place) -> None:
        for each in self.held if place.is_reported else ():
            if not self.judge.entails(known, each.statement):
                is_certain = place.again is None
                clash = self.judge.clash(known, each.statement) if is_certain else None
                self.findings.hold(child.call, each, known, clash)

    # --- processors -------------------------------------------------------------------------------

    def _sequence(
        self, below: Sequence[Node], known: KnownFacts, place: Place, *, is_restarting: bool = False
    ) -> NodeOutcome:
        failures: list[KnownFacts] = []
        endings: tuple[KnownFacts, ...] = (known,)
        for index, node in enumerate(below):
            inner = place
            if is_restarting and index:
                inner = self._with_serial(below[:index], place)
                failures.append(self._partly(below[: index + 1], known, place))
            outcome = self.through(node, known, inner)
            known, endings = outcome.success, outcome.endings
            failures += outcome.failures
        return NodeOutcome(known, endings, tuple(failures))

    def _with_serial(self, before: Sequence[Node], place: Place) -> Place:
        """Add a serial, whose earlier children restart at each tick."""
        why = "a serial restarts it in each tick"

        def tick(known: KnownFacts, is_reported: bool) -> KnownFacts:
            known = place.at_next_tick(known, is_reported=is_reported)
            again = Place(place.is_fatal, place.is_reported and is_reported, again=why)
            return self._sequence(before, known, again).success

        return replace(place, tick=tick)

    def _selector(
        self, below: Sequence[Node], known: KnownFacts, place: Place, *, is_restarting: bool = False
    ) -> NodeOutcome:
        inner = place if len(below) == 1 else replace(place, is_fatal=False)
        endings: list[KnownFacts] = []
        failures: tuple[KnownFacts, ...] = (known,)
        for index, node in enumerate(below):
            before = join(failures, self.judge) if failures else replace(known, is_dead=True)
            stopped: list[KnownFacts] = []
            if is_restarting and index:
                inner = self._with_selector(below[:index], place, stopped)
            outcome = self.through(node, before, inner)
            names = " and ".join(f"`{each.skill.__name__}`" for each in calls(node))
            endings += [each.by(f"{names} succeeded") for each in outcome.endings]
            endings += [self._partly([node], each, place) for each in stopped]
            failures = outcome.failures
        return NodeOutcome(join(endings, self.judge), tuple(endings), failures)

    def _with_selector(
        self, before: Sequence[Node], place: Place, stopped: list[KnownFacts]
    ) -> Place:
        """Add a selector, whose earlier children are retried at each tick. `stopped` gets the known
        conditions if one of them succeeds.
        """
        why = "a selector retries it in each tick"

        def tick(known: KnownFacts, is_reported: bool) -> KnownFacts:
            known = place.at_next_tick(known, is_reported=is_reported)
            again = Place(False, place.is_reported and is_reported, again=why)
            outcome = self._selector(before, known, again)
            stopped[:] = [join([*stopped, *outcome.endings], self.judge)]
            failures = outcome.failures or (replace(known, is_dead=True),)
            return join(failures, self.judge)

        return replace(place, is_fatal=False, tick=tick)

    def _parallel(
        self, below: Sequence[Node], known: KnownFacts, place: Place, *, is_race: bool
    ) -> NodeOutcome:
        outcomes = []
        for index, node in enumerate(below):
            others = (*below[:index], *below[index + 1 :])
            beside = self._beside(others, known)
            own_place = self._with_others(beside, place)
            # In a race, any other child may never start, because a child may end the race before.
            is_certain = not is_race or (index == 0 and isinstance(node, SkillCall))
            own_place = replace(own_place, is_fatal=place.is_fatal and is_certain)
            # All children start in the first tick of the parallel. No child restarts before that.
            outcome = self.through(node, beside(known), own_place)
            if len(below) > 1 and not is_race and place.is_reported:
                again = "SkiROS2 restarts it in each tick until the others are done"
                self._restart([node], outcome.success, again)
            kept = self._partly(others, outcome.success, place, How.BESIDE)
            outcomes.append(replace(outcome, success=kept))
        stopped = self._partly(below, known, place).by("a child of the parallel has failed")
        endings = tuple(each.success for each in outcomes)
        if is_race:
            return NodeOutcome(join(endings, self.judge), endings, (stopped,))
        merged = endings[0] if endings else known
        for each in endings[1:]:
            merged = replace(
                merged.assuming(each.facts).binding(each.bound),
                same={**merged.same, **each.same},
                changes={**merged.changes, **each.changes},
                is_dead=merged.is_dead or each.is_dead,
            )
        return NodeOutcome(merged, (merged,), (stopped,))

    def _beside(
        self, others: Sequence[Node], known: KnownFacts
    ) -> Callable[[KnownFacts], KnownFacts]:
        """The effect of other nodes that run at the same time on the knowledge."""
        changes = [each for node in others for each in self._changes(node, known, How.BESIDE)]
        names = {name for node in others for name in self._found(node, known)}
        return lambda known: failed(known, changes, self.judge).perhaps_binding(names)

    def _with_others(self, beside: Callable[[KnownFacts], KnownFacts], place: Place) -> Place:
        """Add children that run at the same time."""

        def tick(known: KnownFacts, is_reported: bool) -> KnownFacts:
            return beside(place.at_next_tick(known, is_reported=is_reported))

        return replace(place, tick=tick)

    # --- ticks ------------------------------------------------------------------------------------

    def _partly(
        self, below: Sequence[Node], known: KnownFacts, place: Place, how: How = How.FAILED
    ) -> KnownFacts:
        """The knowledge after nodes may have done some of their work, in any number of ticks."""
        changes = [each for node in below for each in self._changes(node, known, how)]
        names = [name for node in below for name in self._found(node, known)]
        return self._running(known.perhaps_binding(names), place, changes)

    def _running(
        self, known: KnownFacts, place: Place, changes: Sequence[WorldChange] = ()
    ) -> KnownFacts:
        """The knowledge while a skill runs, in any number of ticks; or while changes may be made,
        without findings.
        """
        known = failed(known, changes, self.judge)
        if place.tick is None:
            return known
        for _ in range(MOST_TICKS):
            after = failed(place.tick(known, not changes), changes, self.judge)
            later = join((known, after), self.judge)
            if later.is_as_much_as(known):
                return later
            known = later
        return known.without(known.facts)

    def _changes(self, node: Node, known: KnownFacts, how: How) -> Iterator[WorldChange]:
        """All changes that nodes below a node may make."""
        for call in calls(node):
            yield from self.children.of(call, known).changes(how)

    def _found(self, node: Node, known: KnownFacts) -> Iterator[str]:
        """The names for which a node may find individuals."""
        for call in calls(node):
            yield from self.children.of(call, known).bound()

    # --- decorators -------------------------------------------------------------------------------

    def _decorated(
        self, decoration: Decoration, child: Node, tries: int, known: KnownFacts, place: Place
    ) -> NodeOutcome:
        if decoration is Decoration.INVERTER:
            inner = self.through(child, known, replace(place, is_fatal=False))
            failures = inner.failures or (replace(inner.success, is_dead=True),)
            return NodeOutcome(join(failures, self.judge), failures, (inner.success,))
        outcome = self.through(child, known, place)
        if decoration is Decoration.TIMEOUT:
            late = self._partly([child], known, place).by("the time limit was reached")
            return replace(outcome, failures=(*outcome.failures, late))
        return self._retried(child, tries, outcome, place)

    def _retried(self, child: Node, tries: int, outcome: NodeOutcome, place: Place) -> NodeOutcome:
        """The outcome of further tries. Each try starts after a failed one and may fail, too."""
        endings, failures = outcome.endings, outcome.failures
        if tries > 1 and place.is_reported:
            for each in failures:
                self._restart([child], each, "the retry restarts it", is_certain=True)
        for _ in range(min(tries - 1, MOST_TRIES) if failures else 0):
            before = self._running(join(failures, self.judge), place)
            again = self.through(child, before, replace(place, is_reported=False, is_fatal=False))
            endings = (*endings, *again.endings)
            failures = again.failures
            if join(failures, self.judge).facts.keys() == before.facts.keys():
                break
        return NodeOutcome(join(endings, self.judge), endings, failures)

    # --- restarted children -----------------------------------------------------------------------

    def _restart(
        self, below: Sequence[Node], known: KnownFacts, again: str, *, is_certain: bool = False
    ) -> None:
        """Check that children can restart. With `is_certain`, only certain failures are
        reported.
        """
        for call in (first for node in below for first in _first_calls(node)):
            for each in self._started.get(id(call), ()):
                if self.judge.entails(known, each.statement):
                    continue
                clash = self.judge.clash(known, each.statement)
                if clash or (not is_certain and self.findings.last_touching(known, each.statement)):
                    self.findings.restart(call, each, known, clash, again)
                    break


def _first_calls(node: Node) -> Iterator[SkillCall]:
    """The skills that can start first in a node."""
    if isinstance(node, SkillCall):
        yield node
        return
    below = children(node)
    is_one = isinstance(node, Processor) and node.flow not in (Flow.PARALLEL_FF, Flow.PARALLEL_FS)
    for child in below[:1] if is_one else below:
        yield from _first_calls(child)
