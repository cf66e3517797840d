"""Rules that are proved not to set each other off do not, whatever comes from outside."""

from __future__ import annotations

from dataclasses import replace

from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.analysis.closed_loop import Loop, Outside
from rossmarie.analysis.feedback import Circle
from rossmarie.analysis.inquiry import Inquiry
from rossmarie.analysis.part import part_of
from rossmarie.analysis.published import publications
from rossmarie.ir import ChannelValues, Reactions
from rossmarie.ir.reactions import Action, Assignment, Publish, RecoveryPlan, Task
from support.drafts import NOWHERE, Draft
from support.growing import NUMBERS, TICK, durations, timeouts

unhurried = settings(
    deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much]
)
numbers = st.sampled_from(NUMBERS)
_TIMES = 3


def publishing(values: list[float], periods: list[int | None]) -> Reactions:
    """Each rule publishes a number on the first topic."""
    effects = [
        Publish("/topic_0", "std_msgs/Float64", (Assignment(("slot_0",), value),), period, None)
        for value, period in zip(values, periods, strict=True)
    ]
    everywhere = range(len(values))
    return Reactions(
        (),
        tuple(Action(f"publish_{rule}", None, NOWHERE) for rule in everywhere),
        ("topic /topic_0",),
        tuple(Task(rule, effects[rule], 0, (), NOWHERE) for rule in everywhere),
        tuple(RecoveryPlan(((rule,),), (rule,)) for rule in everywhere),
        tuple(everywhere),
    )


@st.composite
def conditions(draw: st.DrawFn, draft: Draft, x: int, y: int) -> int:
    """A condition on what rules publish, and on what comes from outside."""
    above = draft.above(x, draw(st.sampled_from((-0.5, 0.0, 0.5))))
    below = draft.proposition(ir.Not(above))
    one = draw(st.sampled_from((above, below)))
    outside = draft.above(y, draw(numbers))
    other = draw(st.sampled_from((outside, draft.proposition(ir.Not(outside)))))
    aged = draft.proposition(ir.AgeReaches(0, draw(durations)))
    nodes: tuple[ir.PropositionNode, ...] = (
        draft.propositions[one].node,
        ir.And((one, other)),
        ir.Or((one, other)),
        ir.Held(one, draw(durations)),
        ir.And((one, draft.proposition(ir.Held(other, draw(durations))))),
        ir.And((one, aged)),
        ir.Or((aged, other)),
    )
    return draft.proposition(draw(st.sampled_from(nodes)))


@unhurried
@given(st.data())
def test_rules_that_are_proved_not_to_alternate_do_not(data: st.DataObject) -> None:
    draft = Draft()
    x, y = draft.read(data.draw(timeouts)), draft.read(data.draw(timeouts))
    count = data.draw(st.integers(1, 2))
    for _ in range(count):
        draft.rule(data.draw(conditions(draft, x, y)))
    values = [data.draw(numbers) for _ in range(count)]
    periods = [data.draw(st.sampled_from((None, TICK, 3 * TICK))) for _ in range(count)]
    machine = replace(draft.machine(), reactions=publishing(values, periods))
    published = list(publications(machine))
    circle = Circle(Inquiry(machine), published, published)
    assume(circle.is_impossible())
    rules = range(count)
    for _ in range(4):
        first, outside = data.draw(numbers), data.draw(numbers)
        messages = {0: ChannelValues({0: first}), 1: ChannelValues({1: outside})}
        sent = {channel: messages[channel] for channel in data.draw(st.sets(st.integers(0, 1)))}
        period_ns = min([TICK, *(each.timeout_ns or TICK for each in machine.inputs)]) // 2
        world = Outside(sent, period_ns, frozenset({0}), frozenset())
        loop = Loop(machine, part_of(machine, rules), rules, world, is_closed=True, ends_well=True)
        assert loop.run(40 * TICK, _TIMES) is None
