"""The guard of a policy: it takes an observation and an action, and returns an action that may be
executed (thesis, section 6.4, figure 5: the safety interface).
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cached_property
from threading import RLock
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rossmarie.engines import GuardEngine, Started, start_guard
from rossmarie.guard.arrays import refuse, require_array
from rossmarie.guard.batch import GuardBatch
from rossmarie.guard.decision import (
    Before,
    Decision,
    Reasons,
    Request,
    active_in,
    feedback_between,
    margins_in,
)
from rossmarie.guard.feedback import FeedbackMeter, rules_with_margin
from rossmarie.guard.mapping import ArrayMapping, Declared, MappingError
from rossmarie.guard.requests import requests_of
from rossmarie.guard.state import GuardState, Sizes
from rossmarie.ir import (
    Change,
    Event,
    Machine,
    Verdict,
    as_instant,
    machine_to_json,
    near_name,
    require_instant,
)
from rossmarie.native import CHANGED, REPORTED, StepCall
from rossmarie.targets import c99

Array = NDArray[Any]
_NEWS = CHANGED | REPORTED


class Guard:
    """A guard between a policy and its robot. Instants are integers in ns, which never decrease.

    A copy is an independent guard with the same state. Calls from several threads wait for each
    other.
    """

    def __init__(self, machine: Machine, observe: Declared, act: Declared) -> None:
        """`mapping.py` describes the declarations. Raises `MappingError` for declarations that do
        not fit the rules.
        """
        self.machine = machine
        self.rules = tuple(rule.name for rule in machine.rules)
        """The names of the rules."""
        self.rules_with_margin = rules_with_margin(machine)
        """The names of the rules that declare a margin, in the order of margins."""
        self._meter = FeedbackMeter(machine)
        self._declared = observe, act
        self._mapping = ArrayMapping(machine, observe, act)
        self._lock = RLock()
        started: Started[GuardEngine] = start_guard(machine)
        self.kind = started.kind
        self.reason = started.reason
        self._engine = started.engine
        self.on_event: Callable[[Event], object] = _unheard
        """A function that is called with each verdict, in order, for logging."""
        self._begin()

    def _begin(self) -> None:
        self._reasons: Reasons  # the first step connects the arrays
        self._step: StepCall = self._first_step
        self._topic_steps: Sequence[StepCall] = ()
        self._at_ns: int | None = None
        self._before: Before = None
        self._latest: Before = None
        self._earlier: NDArray[np.float64] | None = None
        self._is_decided = False
        self._sizes: Sizes | None = None

    @property
    def margin(self) -> NDArray[np.float64]:
        """The margins at the last observation, as in `Decision.margin`. Raises `ValueError` before
        the first observation.
        """
        self._now()
        assert self._latest is not None, "it was observed"
        return margins_in(self._latest[1], self._meter)

    def require_sizes(self, observed: int, acted: int) -> None:
        """Raise `MappingError` if a declared place is outside observations or actions of these
        sizes.
        """
        self._mapping.wiring(observed, acted)

    def step(self, at_ns: int, observation: Array, action: Array) -> Decision:
        """Decide about an action that a policy proposes after an observation.

        Arrays are flat, of float32 or float64, and always as long as at the first step. Raises
        `MappingError` for other arrays, `ValueError` for an instant out of range or before the last
        one, `TypeError` for a value that is not an array or not an integer. After an error nothing
        has changed.
        """
        executed = action.copy() if isinstance(action, np.ndarray) else refuse("action", action)
        with self._lock:
            note = self._step(at_ns, observation, executed)
            if note is None:
                return self._step_in_order(at_ns, observation, action)
            self._see(at_ns, note)
            return self._decision(at_ns, executed, note, action)

    def observe(
        self, at_ns: int, observation: Array, *, one_by_one: bool = False
    ) -> NDArray[np.bool_]:
        """Process an observation, for `decide`. Returns a mask of the active rules, of shape
        (rules,). Several observations may precede a decision: those of the substeps of a
        simulation, each at its instant. With `one_by_one`, the topics of an observation arrive one
        after another, in the order in which the rules name them, as in a node. The topics of the
        first observation arrive together, because a node waits for all.

        Raises the errors of `step`.
        """
        if not isinstance(observation, np.ndarray):
            refuse("observation", observation)
        with self._lock:
            arrive = self._arrive_by_topic if one_by_one and self._latest else self._arrive
            note = arrive(at_ns, observation)
            if note is None:
                self._require_fit(at_ns, observation, None)
                note = arrive(as_instant(at_ns), np.ascontiguousarray(observation))
                assert note is not None, "it fits now"
            self._see(at_ns, note)
            if note[0] & REPORTED:
                self._note(self._engine.take_events())
        return active_in(note, len(self.rules))

    def decide(self, action: Array) -> Decision:
        """Decide about an action at the instant of the last observation: `observe` and `decide`
        together are one `step`. Raises the errors of `step`, and `ValueError` before the first
        observation.
        """
        executed = action.copy() if isinstance(action, np.ndarray) else refuse("action", action)
        with self._lock:
            at_ns = self._now()
            note = self._step(at_ns, None, executed)
            if note is None:
                self._require_fit(at_ns, None, action)
                executed = np.array(action, order="C")
                note = self._step(at_ns, None, executed)
                assert note is not None, "it fits now"
            return self._decision(at_ns, executed, note, action)

    def allows(self, actions: Array) -> NDArray[np.bool_]:
        """For actions of shape (k, m), whether each would pass unchanged after the last
        observation, as a mask of shape (k,). Changes nothing. Raises the errors of `decide`.
        """
        if not isinstance(actions, np.ndarray):
            refuse("action", actions)
        if actions.ndim != 2:
            raise MappingError(f"actions have the shape {actions.shape}, not (k, m)")
        with self._lock:
            at_ns = self._now()
            if len(actions):
                self._require_fit(at_ns, None, actions[0])
            return self._allow(np.ascontiguousarray(actions, np.float64))

    def _arrive(self, at_ns: int, observation: Array) -> bytes | None:
        return self._step(at_ns, observation, None)

    def _arrive_by_topic(self, at_ns: int, observation: Array) -> bytes | None:
        if not self._topic_steps:
            assert self._sizes is not None, "it was observed"
            wiring = self._mapping.wiring(*self._sizes)
            self._topic_steps = [
                self._engine.step_call(replace(wiring, arriving=frozenset({channel})))
                for channel in sorted(wiring.arriving)
            ] or [self._step]
        note: bytes | None = None
        for step in self._topic_steps:
            note = step(at_ns, observation, None)
            if note is None:  # for the first topic; the refused call has changed nothing
                return None
        return note

    def _decision(self, at_ns: int, executed: Array, note: bytes, wanted: Array) -> Decision:
        self._is_decided = True
        before, earlier = self._before, self._earlier
        if not note[0] & _NEWS:
            return Decision(at_ns, executed, note, self._reasons, before, earlier)
        requests = self._take() if note[0] & REPORTED else ()
        given = wanted.copy() if note[0] & CHANGED else None
        return Decision(at_ns, executed, note, self._reasons, before, earlier, given, requests)

    def _see(self, at_ns: int, note: bytes) -> None:
        """Record an observation, and the observation before it. Earlier observations without a
        decision contribute only their feedback.
        """
        self._at_ns = at_ns
        if self._is_decided:
            self._earlier = None
        elif self._before is not None and self._latest is not None:
            found = feedback_between(self._meter, self._before, self._latest)
            self._earlier = found if self._earlier is None else self._earlier + found
        self._is_decided = False
        self._before, self._latest = self._latest, (at_ns, note)

    def report(self, request: Request | int, *, success: bool) -> None:
        """Report the end of a request, or of a task by its number. The consequences come with the
        next decision.
        """
        task = request if isinstance(request, int) else request.task
        with self._lock:
            self._engine.report(self._now(), task, success=success)
            self._note(self._engine.take_events())

    def reset(self, rule: str | None = None) -> None:
        """Reset one latched rule, or all latched rules if `rule` is None, for an operator. Latched
        rules with a false condition are cleared. Raises `ValueError` for an unknown rule.
        """
        if rule is not None and rule not in self.rules:
            near = near_name(rule, self.rules)
            meant = f"; did you mean `{near}`?" if near else ""
            raise ValueError(f"there is no rule `{rule}`{meant}")
        number = None if rule is None else self.rules.index(rule)
        with self._lock:
            self._engine.reset(self._now(), number)
            self._note(self._engine.take_events())

    def restart(self) -> None:
        """Forget everything, for the next episode."""
        with self._lock:
            self._engine.restart()
            self._begin()

    def batch(self, count: int) -> GuardBatch:
        """A batch of `count` guards with the same rules and declarations, in the initial state."""
        return GuardBatch(count, self.machine, self._engine.row, self._mapping.wiring)

    def state(self) -> GuardState:
        """The whole state, for `restore`. It can be pickled if the guard is native."""
        with self._lock:
            return self._state()

    def _state(self) -> GuardState:
        if self._at_ns is None:
            return GuardState(self._fingerprint, None, None, {}, None)
        known = self._engine.save()
        return GuardState(
            self._fingerprint,
            self._sizes,
            self._at_ns,
            self._reasons.causes,
            known,
            (self._before, self._latest),
            self._earlier,
            self._is_decided,
        )

    def restore(self, state: GuardState) -> None:
        """Restore the state of a guard of the same rules. Raises `ValueError` for a state of other
        rules, of another version of ROSSMARie, or of another kind of guard, and `MappingError` if
        its arrays do not fit the declarations. After an error nothing has changed.
        """
        if state.fingerprint != self._fingerprint:
            raise ValueError(
                f"the state is of a guard of other rules, or of another version or kind: "
                f"{state.fingerprint}, not {self._fingerprint}"
            )
        with self._lock:
            self._restore(state)

    def __reduce__(self) -> tuple[object, ...]:
        return _again, (self.machine, *self._declared, self.state())

    def __deepcopy__(self, memo: object) -> Guard:
        return self.__copy__()

    def __copy__(self) -> Guard:
        state, another = self.state(), object.__new__(type(self))
        another.__dict__ |= self.__dict__ | {"_engine": self._engine.fresh(), "_lock": RLock()}
        another.on_event = _unheard
        another._begin()
        another.restore(state)
        return another

    def _restore(self, state: GuardState) -> None:
        if state.sizes is None:
            self.restart()
            return
        self._mapping.wiring(*state.sizes)
        self._engine.load(state.known)
        self._connect(*state.sizes)
        self._at_ns = state.at_ns
        self._before, self._latest = state.seen
        self._earlier, self._is_decided = state.earlier, state.is_decided
        self._reasons = replace(self._reasons, causes=state.causes)

    @cached_property
    def _fingerprint(self) -> str:
        """The rules, the version of the engine, and the kind of the guard."""
        text = machine_to_json(self.machine)
        reported = f"{text}\0{c99.version()}\0{self.kind}"
        return f"{self.machine.name} {hashlib.sha256(reported.encode()).hexdigest()[:16]}"

    # --- steps -------------------------------------------------------------------------------

    def _now(self) -> int:
        if self._at_ns is None:
            raise ValueError("there is no step yet: call `step` first")
        return as_instant(self._at_ns)

    def _first_step(
        self, at_ns: int, observation: Array | None, action: Array | None
    ) -> bytes | None:
        """Connect the arrays by their sizes."""
        assert observation is not None, "there is no observation yet: call `observe` first"
        require_array("observation", observation)
        if action is not None:
            require_array("action", action)
        require_instant(as_instant(at_ns))
        self._connect(observation.size, None if action is None else action.size)
        return self._step(at_ns, observation, action)

    def _connect(self, observed: int, acted: int | None) -> None:
        wiring = self._mapping.wiring(observed, acted)
        self._sizes = (observed, acted)
        causes = self._reasons.causes if self._at_ns is not None else {}
        self._reasons = Reasons(self.machine, self._meter, self._mapping, wiring, causes)
        self._acted = {each.command for each in wiring.commands}
        self._step = self._engine.step_call(wiring)
        self._topic_steps = ()
        self._allow = self._engine.allow_call(wiring)

    def _step_in_order(self, at_ns: int, observation: Array, action: Array) -> Decision:
        """Perform a step with copies of its arrays. Raises the errors of the arguments."""
        self._require_fit(at_ns, observation, action)
        return self.step(
            as_instant(at_ns), np.ascontiguousarray(observation), np.ascontiguousarray(action)
        )

    def _require_fit(self, at_ns: int, observation: Array | None, action: Array | None) -> None:
        """Raise an error if the arguments do not fit. The first action connects the arrays
        again.
        """
        assert self._sizes is not None
        if action is not None and self._sizes[1] is None:
            require_array("action", action)
            self._connect(self._sizes[0], action.size)
        for what, array, size in zip(
            ("observation", "action"), (observation, action), self._sizes, strict=True
        ):
            if array is None:
                continue
            require_array(what, array)
            if array.size != size:
                raise MappingError(f"the {what} has {array.size} numbers, but had {size} at first")
        instant = as_instant(at_ns)
        require_instant(instant)
        if self._at_ns is not None and instant < self._at_ns:
            raise ValueError(
                f"time goes back from {self._at_ns} ns to {instant} ns; "
                "call `restart` before a new episode"
            )

    def _take(self) -> tuple[Request, ...]:
        """Record the reported events and task commands. Returns the requests."""
        reported = self._engine.take()
        self._note(reported.events)
        return tuple(requests_of(self.machine, reported.task_commands, self._acted))

    def _note(self, events: list[Event]) -> None:
        causes = dict(self._reasons.causes)
        for event in events:
            if isinstance(event, Verdict) and event.change is Change.CLEARED:
                causes.pop(event.rule, None)
            elif isinstance(event, Verdict):
                causes[event.rule] = event
        self._reasons = replace(self._reasons, causes=causes)
        for event in events:
            self.on_event(event)


def _unheard(_: Event) -> None:
    """Ignore an event, because there is no log."""


def _again(machine: Machine, observe: Declared, act: Declared, state: GuardState) -> Guard:
    """A guard with the state of another guard. Raises the errors of `restore`."""
    guard = Guard(machine, observe, act)
    guard.restore(state)
    return guard
