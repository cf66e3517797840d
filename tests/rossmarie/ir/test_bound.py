"""The bound on the evaluations of one call counts what can fall due, and nothing else."""

from __future__ import annotations

from rossmarie import ir
from support.drafts import SECOND, Draft


def test_without_timers_there_is_the_evaluation_of_the_event() -> None:
    draft = Draft()
    draft.rule(draft.above(draft.read(), 1.0))
    assert ir.most_evaluations(draft.machine()) == 1


def test_every_timer_of_ordinary_rules_counts_once() -> None:
    draft = Draft()
    leaves = [draft.above(draft.read(SECOND), 1.0) for _ in range(5)]
    together = draft.proposition(ir.And(tuple(leaves)))
    swings = draft.proposition(ir.Oscillates(draft.read(), 3, SECOND, 0.0))
    for condition in (draft.proposition(ir.Held(together, SECOND)), swings):
        opposite = draft.proposition(ir.Not(condition))
        draft.rule(condition, draft.proposition(ir.Held(opposite, 2 * SECOND)))
    # The event, five timeouts, the window, and a `for` and two `clear for`.
    assert ir.most_evaluations(draft.machine()) == 1 + 5 + 1 + 3


def test_equal_ages_of_one_channel_are_one_timer() -> None:
    draft = Draft()
    channel = draft.channel()
    first, second = draft.input(channel, SECOND), draft.input(channel, SECOND)
    draft.input(draft.channel(), SECOND)
    draft.proposition(ir.AgeReaches(first, SECOND))
    draft.proposition(ir.AgeReaches(second, SECOND + 1))
    machine = draft.machine()
    assert [count for _, count in ir.wakes(machine)] == [1, 0, 1, 0, 1]
    assert ir.most_evaluations(machine) == 1 + 3


def test_a_for_over_what_can_become_true_again_counts_that_often() -> None:
    draft = Draft()
    used = draft.input(draft.channel())
    early, late = (draft.proposition(ir.AgeReaches(used, age * SECOND)) for age in (1, 2))
    outside = draft.proposition(
        ir.Not(draft.proposition(ir.And((early, draft.proposition(ir.Not(late))))))
    )
    draft.proposition(
        ir.Held(outside, SECOND // 2)
    )  # true until the one age, and from the other on
    *_, (_, count) = ir.wakes(draft.machine())
    assert count == 2


def test_a_for_over_what_ceases_to_be_true_and_becomes_true_again_counts_twice() -> None:
    draft = Draft()
    late = draft.proposition(ir.AgeReaches(draft.input(draft.channel()), 9 * SECOND))
    early = draft.proposition(ir.Not(late))
    swings = draft.proposition(ir.Oscillates(draft.read(), 3, SECOND, 0.0))
    expiring = draft.above(draft.read(SECOND), 1.0)
    matured = draft.proposition(ir.Held(early, SECOND))
    conditions = (
        draft.proposition(ir.Or((swings, late))),
        draft.proposition(ir.Or((expiring, late))),
        draft.proposition(ir.Or((draft.proposition(ir.Not(swings)), early))),
        draft.proposition(ir.Not(matured)),
        draft.proposition(ir.Or((matured, draft.proposition(ir.AgeReaches(0, 99 * SECOND))))),
    )
    outer = [draft.proposition(ir.Held(condition, SECOND)) for condition in conditions]
    machine = draft.machine()
    counts = [count for _, count in ir.wakes(machine)][len(machine.inputs) :]
    assert [counts[index] for index in outer] == [2] * len(outer)


def test_a_for_over_what_cannot_become_true_again_counts_once() -> None:
    draft = Draft()
    condition = draft.above(draft.read(SECOND), 1.0)
    draft.proposition(
        ir.Held(draft.proposition(ir.Not(draft.proposition(ir.Held(condition, SECOND)))), SECOND)
    )
    draft.proposition(ir.Held(draft.proposition(ir.AgeReaches(0, SECOND // 2)), SECOND))
    swings = draft.proposition(ir.Oscillates(draft.read(), 3, SECOND, 0.0))
    draft.proposition(ir.Held(draft.proposition(ir.Not(swings)), SECOND))
    assert max(count for _, count in ir.wakes(draft.machine())) == 1


def test_edges_count_twice_and_once_more_for_each_that_can_come() -> None:
    draft = Draft()
    aged = draft.proposition(ir.AgeReaches(draft.input(draft.channel()), SECOND))
    draft.proposition(ir.Recurs(aged, 3, SECOND))  # an edge, at which it is known as well
    above = draft.above(draft.read(), 1.0)
    draft.proposition(ir.Recurs(above, 3, SECOND))  # no edge comes without a message
    counts = [count for _, count in ir.wakes(draft.machine())]
    assert counts == [0, 0, 1, 2 + 1 + 1, 0, 2]
