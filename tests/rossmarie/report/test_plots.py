from __future__ import annotations

import math

import numpy as np
import pytest

from rossmarie import ir
from rossmarie.ir import Comparison
from rossmarie.report.model import PlotThreshold
from rossmarie.report.plots import PlotPlan, plan_plots
from support.drafts import SECOND, Draft

INFINITY = math.inf


def only(draft: Draft) -> PlotPlan:
    (plan,) = plan_plots(draft.machine())
    return plan


def limits_of(draft: Draft) -> list[PlotThreshold]:
    return list(only(draft).thresholds)


@pytest.mark.parametrize(
    ("comparison", "region"),
    [
        (Comparison.GREATER, ((3.0, INFINITY),)),
        (Comparison.GREATER_OR_EQUAL, ((3.0, INFINITY),)),
        (Comparison.LESS, ((-INFINITY, 3.0),)),
        (Comparison.EQUAL, ()),
    ],
)
def test_a_comparison_with_a_constant_is_a_limit(
    comparison: Comparison, region: tuple[tuple[float, float], ...]
) -> None:
    draft = Draft()
    signal = draft.read()
    condition = draft.proposition(ir.Compare(comparison, signal, draft.constant(3.0)), "a.b")
    draft.rule(condition)
    assert limits_of(draft) == [PlotThreshold((3.0,), region, "a.b", ("rule_1",), False)]


def test_the_constant_may_stand_on_the_left() -> None:
    draft = Draft()
    draft.rule(draft.proposition(ir.Compare(Comparison.LESS, draft.constant(3.0), draft.read())))
    assert limits_of(draft)[0].regions == ((3.0, INFINITY),)


def test_a_negation_turns_the_regions_over() -> None:
    draft = Draft()
    low, high = draft.constant(-1.0), draft.constant(2.0)
    inside = draft.proposition(ir.Between(draft.read(), low, high))
    held = draft.proposition(ir.Held(draft.proposition(ir.Not(inside)), SECOND), "imu.steep")
    draft.rule(held)
    (limit,) = limits_of(draft)
    assert limit.limits == (-1.0, 2.0)
    assert limit.regions == ((-INFINITY, -1.0), (2.0, INFINITY))
    assert limit.text == "imu.steep"


def test_limits_and_samples_are_in_the_unit_of_the_signal() -> None:
    draft = Draft()
    slot = draft.slot(draft.input(draft.channel()))
    signal = draft.signal(ir.Read(slot), "temperature", "degC", 1.0, -273.15)
    draft.rule(draft.above(signal, 373.15))
    plan = only(draft)
    plot = plan.plot(np.array([0.0, 1.0]), np.array([273.15, math.nan]))
    assert (plot.text, plot.unit) == ("temperature", "degC")
    assert plot.thresholds[0].limits == (100.0,)
    np.testing.assert_array_equal(plot.values, [0.0, math.nan])


def test_rules_share_a_limit() -> None:
    draft = Draft()
    condition = draft.above(draft.read(), 1.0)
    draft.rule(condition)
    draft.rule(condition)
    assert [limit.rules for limit in limits_of(draft)] == [("rule_1", "rule_2")]


def test_a_limit_of_its_own_for_clearing_is_drawn() -> None:
    draft = Draft()
    signal = draft.read()
    draft.rule(draft.above(signal, 5.0), draft.proposition(ir.Not(draft.above(signal, 4.0))))
    activating, releasing = limits_of(draft)
    assert (activating.limits, activating.releases) == ((5.0,), False)
    assert (releasing.limits, releasing.releases) == ((4.0,), True)
    assert releasing.regions == ((-INFINITY, 4.0),)


def test_a_release_that_repeats_the_condition_is_not_drawn_twice() -> None:
    draft = Draft()
    condition = draft.above(draft.read(), 5.0)
    draft.rule(condition, draft.proposition(ir.Held(draft.proposition(ir.Not(condition)), SECOND)))
    assert [limit.releases for limit in limits_of(draft)] == [False]


def test_only_numbers_with_one_value_are_plotted() -> None:
    draft = Draft(texts=("docked",))
    text = draft.read(kind=ir.FieldKind.TEXT)
    equal = draft.proposition(ir.Compare(Comparison.EQUAL, text, draft.constant(0.0)))
    near = draft.proposition(
        ir.Quantified(ir.Quantifier.ANY, draft.above(draft.elements(), 1.0)), "scan.near"
    )
    flag = draft.proposition(ir.Flag(draft.read(kind=ir.FieldKind.FLAG)))
    draft.rule(draft.proposition(ir.And((equal, near, flag))))
    machine = draft.machine()
    assert [machine.signals[plan.signal].node for plan in plan_plots(machine)] == [ir.Read(1)]


def test_two_signals_compared_have_a_plot_each_and_no_limit() -> None:
    draft = Draft()
    draft.rule(draft.proposition(ir.Compare(Comparison.LESS, draft.read(), draft.read())))
    assert [plan.thresholds for plan in plan_plots(draft.machine())] == [(), ()]
