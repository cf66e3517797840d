"""Queries and their answers: proved impossible, possible with a witness, or undecided."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial

import z3

from rossmarie.analysis.activity import propositions_of, seen_together, together
from rossmarie.analysis.draft import drafted
from rossmarie.analysis.encoding import Questioned
from rossmarie.analysis.hints import hints
from rossmarie.analysis.part import part_below, part_of
from rossmarie.analysis.shrink import Replays, shortened
from rossmarie.analysis.solver import Satisfiability, ask
from rossmarie.analysis.state import ArbitraryState
from rossmarie.analysis.trace import SymbolicTrace
from rossmarie.analysis.witness import Predicate, Witness
from rossmarie.ir import Machine, TruthValue

_MOST_AWAITED = 16
"""The most conditions of `for` in one query that are compared with each other."""

StatePredicate = Callable[[ArbitraryState], z3.BoolRef]
TracePredicate = Callable[[SymbolicTrace], z3.BoolRef]


class OutOfTimeError(Exception):
    """The queries of a run exceeded their time limit."""


@dataclass(frozen=True)
class AskedQuery:
    """A query: the predicate as terms over one state, as terms over a trace, and as the interpreter
    evaluates it. `propositions` are the indices of the propositions that it depends on.
    """

    propositions: tuple[int, ...]
    in_state: StatePredicate
    in_trace: TracePredicate
    in_view: Predicate


@dataclass(frozen=True)
class QueryResult:
    """The answer to a query. If the answer is POSSIBLE, it contains a witness."""

    outcome: Satisfiability
    witness: Witness | None = None


@dataclass
class Inquiry:
    """Asks queries about one machine. `deadline_s` is an instant in s on the clock of
    `time.process_time`; after it, every query raises `OutOfTimeError`. None means no deadline.
    """

    machine: Machine
    deadline_s: float | None = None
    _orders: dict[tuple[int, int, TruthValue], bool] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.asked = Questioned(self.machine)

    def about(self, *rules: int) -> Inquiry:
        """An inquiry about these rules only. They become its first, second and later rules."""
        return Inquiry(part_of(self.machine, rules), self.deadline_s)

    def below(self, proposition: int) -> Inquiry:
        """An inquiry about a proposition, which becomes the last proposition of its machine."""
        return Inquiry(part_below(self.machine, proposition), self.deadline_s)

    def decide(self, query: AskedQuery) -> QueryResult:
        """Find the answer to a query. The cheapest method comes first."""
        self.check_time()
        state = ArbitraryState(self.asked)
        term = query.in_state(state)
        if ask(state.facts, term).outcome is Satisfiability.IMPOSSIBLE:
            return QueryResult(Satisfiability.IMPOSSIBLE)
        witness = self.witness(query, _ATTEMPTS[:1])
        if witness is None and self._is_refuted(state, term):
            return QueryResult(Satisfiability.IMPOSSIBLE)
        witness = witness or self.witness(query, _ATTEMPTS[1:])
        return QueryResult(
            Satisfiability.UNDECIDED if witness is None else Satisfiability.POSSIBLE, witness
        )

    # --- proofs ------------------------------------------------------------------------------

    def is_impossible(self, predicate: StatePredicate, *, settled: bool = False) -> bool:
        """Say whether it is proved that a predicate is false in all states that a trace can lead
        to.
        """
        self.check_time()
        state = ArbitraryState(self.asked, settled=settled)
        term = predicate(state)
        return self._is_refuted(state, term)

    def is_possible(self, predicate: StatePredicate, *, settled: bool = False) -> bool:
        """Say whether the solver finds a state in which a predicate is true. The predicate depends
        on no `for`, and the state need not be reachable.
        """
        self.check_time()
        state = ArbitraryState(self.asked, settled=settled)
        term = predicate(state)
        return not state.awaited and ask(state.facts, term).outcome is Satisfiability.POSSIBLE

    def _is_refuted(self, state: ArbitraryState, term: z3.BoolRef) -> bool:
        outcome = ask(state.facts, term).outcome
        if outcome is Satisfiability.POSSIBLE and 1 < len(state.awaited) <= _MOST_AWAITED:
            orders = list(self.orders(state))
            outcome = ask([*state.facts, *orders], term).outcome
        return outcome is Satisfiability.IMPOSSIBLE

    def orders(self, state: ArbitraryState) -> Iterator[z3.BoolRef]:
        """Facts: some propositions are true only while another proposition is true, and not for
        longer.
        """
        for one in state.awaited:
            for other in state.awaited:
                if not self._may_need(one, other) or not self._needs(one, other, TruthValue.TRUE):
                    continue
                yield state.is_longer(one, other)
                for value in (TruthValue.UNKNOWN, TruthValue.STALE):
                    if self._needs(one, other, value):
                        yield state.is_unknown_with(one, other, value)

    def _may_need(self, one: int, other: int) -> bool:
        """Say whether the query is worth its cost. Propositions of different messages rarely imply
        each other.
        """
        supports = self.asked.supports.propositions
        return one != other and not supports[one].channels.isdisjoint(supports[other].channels)

    def _needs(self, one: int, other: int, value: TruthValue) -> bool:
        """Say whether it is proved that one proposition has a value only while another proposition
        has the same value.
        """
        if (one, other, value) not in self._orders:
            state = ArbitraryState(self.asked)
            theirs = z3.Not(state.proposition(other).is_value(value))
            without = z3.And(state.proposition(one).is_value(value), theirs)
            proved = self._is_refuted(
                state, without
            )  # queries about propositions with more levels of operands
            self._orders[one, other, value] = proved
        return self._orders[one, other, value]

    # --- witnesses ---------------------------------------------------------------------------

    def witness(
        self, query: AskedQuery, attempts: Sequence[tuple[int, bool]] | None = None
    ) -> Witness | None:
        """A witness that the interpreter confirms, preferably one in which all sensors work."""
        for legs, is_calm in _ATTEMPTS if attempts is None else attempts:
            self.check_time()
            trace = SymbolicTrace(self.asked, query.propositions, legs)
            witness = self._borne_out(trace, query, is_calm)
            if witness is not None:
                return witness
        return None

    def _borne_out(self, trace: SymbolicTrace, query: AskedQuery, is_calm: bool) -> Witness | None:
        """A confirmed witness on a trace, the most readable witness that is found."""
        predicate = query.in_trace(trace)
        wishes: Sequence[z3.BoolRef] = trace.calm if is_calm else ()
        for preferred in hints(trace):
            answer = ask(trace.facts, predicate, *wishes, *preferred)
            if answer.model is None:
                continue
            draft = drafted(trace, answer.model, is_calm=is_calm)
            replays = Replays(self.machine, query.in_view, query.propositions)
            witness = shortened(self.machine, draft, replays)
            if witness is not None:
                return witness
        return None

    def quick_witness(
        self, propositions: tuple[int, ...], legs: int, in_trace: TracePredicate, in_view: Predicate
    ) -> Witness | None:
        """A witness of single messages, one after another, while all sensors work."""
        self.check_time()
        trace = SymbolicTrace(self.asked, propositions, legs, is_brief=True)
        predicate = in_trace(trace)
        for preferred in hints(trace):
            answer = ask(trace.facts, predicate, *trace.calm, *preferred)
            if answer.model is not None:
                draft = drafted(trace, answer.model, is_calm=True)
                replays = Replays(self.machine, in_view, propositions)
                return shortened(self.machine, draft, replays)
        return None

    def check_time(self) -> None:
        """Check the time. Raises `OutOfTimeError` after the deadline."""
        if self.deadline_s is not None and time.process_time() > self.deadline_s:
            raise OutOfTimeError


_ATTEMPTS = ((1, True), (2, True), (1, False), (2, False), (3, True), (3, False))
"""The legs of each attempt, and whether all sensors work in it, the simplest first. A predicate
that needs more changes than three legs allow stays undecided.
"""


def both_active(machine: Machine) -> AskedQuery:
    """The query whether the first two rules of a machine can be active at the same time."""
    return AskedQuery(
        propositions_of(machine, (0, 1)),
        partial(together, one=0, other=1),
        partial(seen_together, one=0, other=1),
        lambda seen: seen[-1].active[0] and seen[-1].active[1],
    )


def has_value(proposition: int, value: TruthValue) -> AskedQuery:
    """The query whether a proposition can have a value."""
    return AskedQuery(
        (proposition,),
        partial(is_value, proposition=proposition, value=value),
        partial(_comes_to, proposition=proposition, value=value),
        lambda seen: seen[-1].truth_values[proposition] is value,
    )


def is_value(state: ArbitraryState, proposition: int, value: TruthValue) -> z3.BoolRef:
    """Say whether a proposition has a value in a state."""
    return state.proposition(proposition).is_value(value)


def _comes_to(trace: SymbolicTrace, proposition: int, value: TruthValue) -> z3.BoolRef:
    return z3.Or([moment.proposition(proposition).is_value(value) for moment in trace.moments])
