"""Commands: rules R11 and R12 of docs/explanation/reactions.md."""

import math

import pytest

from rossmarie import ir
from rossmarie.interpreter import Reactor
from rossmarie.ir import FieldBounds
from support.plans import Plans, ReactorBench, limit, scale

FREE = (1.0, -math.inf, math.inf)


def test_r11_the_narrowest_limits_count() -> None:
    plans = Plans(fields=2)
    plans.rule([plans.task(limit(-1.0, 0.5)), plans.task(scale(0.5))])
    plans.rule([plans.task(limit(-0.25, 2.0)), plans.task(scale(0.75))])
    bench = ReactorBench(plans)
    assert bench.bounds(0) == FREE
    bench.react(0, 0, 1)
    assert bench.bounds(0) == (0.5, -0.25, 0.5)
    assert bench.bounds(0, 1) == (0.5, -math.inf, math.inf)


def test_r11_a_limit_without_a_ramp_is_gone_at_once() -> None:
    plans = Plans()
    plans.rule([plans.task(limit(-1.0, 0.5))])
    bench = ReactorBench(plans)
    bench.react(0, 0)
    bench.react(1)
    assert bench.bounds(1) == FREE


def test_r11_a_limit_with_a_ramp_moves_apart() -> None:
    plans = Plans()
    plans.rule([plans.task(limit(-1.0, 0.5, ramp=0.25))])
    bench = ReactorBench(plans)
    bench.react(0, 0)
    assert bench.bounds(9) == (1.0, -1.0, 0.5)
    bench.react(10)
    assert bench.bounds(10) == (1.0, -1.0, 0.5)
    assert bench.bounds(12) == (1.0, -1.5, 1.0)


def test_r11_a_factor_grows_up_to_one() -> None:
    plans = Plans()
    plans.rule([plans.task(scale(0.5, ramp=0.125))])
    bench = ReactorBench(plans)
    bench.react(0, 0)
    bench.react(1)
    assert [bench.bounds(seconds)[0] for seconds in (1, 2, 5, 6)] == [0.5, 0.625, 1.0, 1.0]


def test_r11_another_start_puts_a_limit_in_force_again() -> None:
    plans = Plans()
    plans.rule([plans.task(limit(-1.0, 0.5, ramp=0.25))])
    bench = ReactorBench(plans)
    bench.react(0, 0)
    bench.react(1)
    bench.react(3, 0)
    assert bench.bounds(4) == (1.0, -1.0, 0.5)


def test_r11_before_its_release_a_limit_has_not_moved() -> None:
    plans = Plans()
    plans.rule([plans.task(limit(-1.0, 0.5, ramp=2.0))])
    bench = ReactorBench(plans)
    bench.react(0, 0)
    bench.react(5)
    assert bench.bounds(1) == (1.0, -1.0, 0.5)


@pytest.mark.parametrize(
    ("value", "bounded"),
    [(0.5, 0.25), (3.0, 1.0), (-9.0, -0.5), (math.inf, 0.0), (-math.inf, 0.0), (math.nan, 0.0)],
)
def test_r11_a_number_is_scaled_and_then_bounded(value: float, bounded: float) -> None:
    assert FieldBounds(factor=0.5, low=-0.5, high=1.0).of(value) == bounded


def test_r12_until_opened_every_field_is_bounded_to_zero() -> None:
    plans = Plans(fields=2)
    plans.rule([plans.task(limit(-1.0, 1.0))])
    reactor = Reactor(plans.machine().reactions)
    blocked = FieldBounds(1.0, 0.0, 0.0)
    reactor.react(0, [True], [])
    assert reactor.bounds(0, 0) == (blocked, blocked)
    reactor.open()
    assert reactor.bounds(0, 0) == (FieldBounds(1.0, -1.0, 1.0), FieldBounds(*FREE))


@pytest.mark.parametrize("at_ns", [ir.EARLIEST_NS, ir.LATEST_NS])
def test_r12_out_of_range_every_field_is_bounded_to_zero(at_ns: int) -> None:
    plans = Plans()
    plans.rule([plans.task(limit(-1.0, 1.0))])
    bench = ReactorBench(plans)
    assert bench.reactor.bounds(at_ns, 0) == (FieldBounds(1.0, 0.0, 0.0),)
