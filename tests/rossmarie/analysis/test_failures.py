"""Statements about stale inputs agree with the behavior of the monitor."""

from __future__ import annotations

from pathlib import Path

from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.analysis.failures import find_unnoticed, losses
from rossmarie.analysis.inquiry import Inquiry
from rossmarie.analysis.loss import Effect
from rossmarie.driver import compile_file
from rossmarie.interpreter import Interpreter
from rossmarie.ir import InputState
from support.compiled import machine_of
from support.drafts import SECOND
from support.machines import machines, take, traces
from support.testing import INPUTS

EXAMPLES = Path(__file__).parents[3] / "examples"


def table(rules: Path) -> dict[str, tuple[set[str], set[str]]]:
    machine = compile_file(rules).machine
    found = {}
    for loss in losses(Inquiry(machine)):
        active, maybe = (
            {machine.rules[rule].name for rule, what in loss.effects.items() if what is effect}
            for effect in (Effect.ACTIVATES, Effect.DEPENDS)
        )
        found[machine.inputs[loss.input].name] = (active, maybe)
    return found


def test_the_table_of_the_demo_is_right() -> None:
    found = table(EXAMPLES / "demo" / "demo.ross")
    assert found["ranges"] == ({"keep_distance", "emergency_stop", "boxed_in"}, set())
    assert found["speed"] == ({"report_braking"}, {"slow_on_bump", "position_unknown"})
    assert found["fix"] == (set(), {"position_unknown"})


def test_a_rule_that_needs_more_than_the_loss_does_not_notice_it() -> None:
    never = "rule never: if fix.status.status > 200 and speed > 1 m/s then { slow; };\n"
    rules = INPUTS + never
    others = "".join(f"rule r{each}: if speed > {each} m/s then {{ slow; }};\n" for each in (1, 2))

    def unnoticed(text: str) -> list[str]:
        found = find_unnoticed(Inquiry(machine_of(text)))
        return [finding.diagnostic.primary.span.text for finding in found]

    assert unnoticed(rules) == ["speed"]
    assert unnoticed(rules + others) == []


@settings(deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much])
@given(machines(max_nodes=8), st.data())
def test_a_rule_that_the_loss_of_an_input_activates_is_active_after_it(
    machine: ir.Machine, data: st.DataObject
) -> None:
    found = [
        (loss.input, rule)
        for loss in losses(Inquiry(machine))
        for rule, effect in loss.effects.items()
        if effect is Effect.ACTIVATES
    ]
    assume(found)
    monitor = Interpreter(machine)
    trace = data.draw(traces(machine))
    for step in trace:
        take(monitor, step)
    monitor.advance(trace[-1].at_ns + 1000 * SECOND)
    for used, rule in found:
        if monitor.input_states[used] is not InputState.NEVER:
            assert monitor.active[rule]
