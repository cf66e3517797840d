from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.interpreter import Interpreter
from rossmarie.ir import Change, TimeJump, Verdict
from rossmarie.report.axis import Axis, place
from rossmarie.report.model import Replay
from rossmarie.report.spans import active_spans, summarize
from support.drafts import SECOND, Draft
from support.machines import Step, cases, take


def run(machine: ir.Machine, trace: list[Step]) -> tuple[Replay, tuple[bool, ...]]:
    """The replay of a trace by the interpreter, and the rules that are active at the end."""
    monitor = Interpreter(machine)
    events = [event for step in trace for event in take(monitor, step)]
    ends = (trace[0].at_ns, trace[-1].at_ns)
    replay = Replay(machine, "a.ross", "a.mcap", "python", *ends, tuple(events), (), ())
    return replay, tuple(monitor.active)


@given(cases())
def test_spans_of_a_rule_follow_each_other_within_the_replay(
    case: tuple[ir.Machine, list[Step]],
) -> None:
    replay, _ = run(*case)
    for spans in active_spans(replay):
        borders = [0]
        for span in spans:
            borders += [span.start_ns, span.end_ns]
        borders.append(replay.duration_ns)
        assert borders == sorted(borders)


@given(cases())
def test_every_verdict_begins_or_ends_exactly_one_span(
    case: tuple[ir.Machine, list[Step]],
) -> None:
    replay, active = run(*case)
    verdicts = {i for i, event in enumerate(replay.events) if isinstance(event, Verdict)}
    spans = [span for row in active_spans(replay) for span in row]
    used = [place for span in spans for place in (span.opened, span.closed) if place is not None]
    assert sorted(used) == sorted(verdicts)
    assert all(span.end_ns == replay.duration_ns for span in spans if span.closed is None)
    still = {span.rule for span in spans if span.closed is None}
    assert still == {rule for rule, is_active in enumerate(active) if is_active}


@given(cases())
def test_a_span_is_stale_as_its_activation_says(case: tuple[ir.Machine, list[Step]]) -> None:
    replay, _ = run(*case)
    for span in (span for row in active_spans(replay) for span in row):
        event = replay.events[span.opened]
        assert isinstance(event, Verdict)
        assert event.rule == span.rule
        assert span.stale == (event.change is Change.ACTIVATED_STALE)


@given(cases())
def test_summaries_add_up(case: tuple[ir.Machine, list[Step]]) -> None:
    replay, active = run(*case)
    for summary, spans, is_active in zip(
        summarize(replay), active_spans(replay), active, strict=True
    ):
        assert summary.activations == len(spans)
        assert summary.stale_activations == len([span for span in spans if span.stale])
        assert summary.total_ns == sum(span.end_ns - span.start_ns for span in spans)
        assert summary.longest_ns <= summary.total_ns <= replay.duration_ns
        assert summary.active_at_end == is_active
        assert (summary.first_ns is None) == (not spans)


@given(cases())
def test_positions_never_run_backwards(case: tuple[ir.Machine, list[Step]]) -> None:
    replay, _ = run(*case)
    positions = [placed.position_ns for placed in place(replay.events, replay.start_ns)]
    assert positions == sorted(positions)


@given(cases())
def test_samples_lie_on_the_axis_of_the_events(case: tuple[ir.Machine, list[Step]]) -> None:
    machine, trace = case
    stamps = np.array([step.at_ns for step in trace], dtype=np.int64)
    seconds = Axis().place(stamps) / 1e9
    replay, _ = run(machine, trace)
    assert seconds[-1] == replay.duration_ns / 1e9
    assert (np.diff(seconds) >= 0).all()


@given(cases(), st.integers(1, 5))
def test_blocks_of_stamps_lie_on_one_axis(case: tuple[ir.Machine, list[Step]], block: int) -> None:
    stamps = np.array([step.at_ns for step in case[1]], dtype=np.int64)
    axis = Axis()
    blocks = [axis.place(stamps[start : start + block]) for start in range(0, len(stamps), block)]
    assert np.concatenate(blocks).tolist() == Axis().place(stamps).tolist()
    assert len(axis.place(stamps[:0])) == 0


def jumping() -> Replay:
    """Active from 4 s; the clock falls from 6 s back to 1 s; cleared at 3 s on that clock."""
    draft = Draft()
    draft.rule(draft.above(draft.read(), 1.0))
    verdict = Verdict(0, 4 * SECOND, Change.ACTIVATED, (ir.TruthValue.TRUE,), (4 * SECOND,), (2.0,),
                      (ir.InputState.FRESH,))  # fmt: skip
    events = (
        verdict,
        TimeJump(6 * SECOND, SECOND),
        replace(
            verdict,
            at_ns=3 * SECOND,
            change=Change.CLEARED,
            truth_values=(ir.TruthValue.FALSE,),
            since_ns=(3 * SECOND,),
            values=(0.0,),
        ),
    )
    return Replay(draft.machine(), "a", "b", "native", 0, 5 * SECOND, events, (), ())


def test_a_span_goes_on_across_a_jump() -> None:
    ((span,),) = active_spans(jumping())
    assert (span.start_ns, span.end_ns) == (4 * SECOND, 8 * SECOND)
    assert jumping().duration_ns == 10 * SECOND


def test_the_first_cause_is_reported_on_the_axis(drive: Replay) -> None:
    bump = summarize(drive)[1]
    assert bump.rule == "slow_on_bump"
    assert "acceleration.z = 14.7958 m/s^2" in bump.first_cause
    assert "since 8.967 s" in bump.first_cause
