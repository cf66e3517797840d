from __future__ import annotations

import json
import math
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

from hypothesis import given

from rossmarie import ir
from rossmarie.interpreter import Interpreter
from rossmarie.ir import ChannelValues
from rossmarie.report.jsonl import event_lines, verdict_lines
from rossmarie.report.model import Replay
from rossmarie.report.rehearsal import rehearse
from support.docking import docking
from support.drafts import SECOND, Draft
from support.golden import assert_golden
from support.machines import Step, cases, take

GOLDEN = Path(__file__).parent / "golden"


def lines(replay: Replay) -> list[dict[str, Any]]:
    return [json.loads(line) for line in verdict_lines(replay)]


def test_events_have_the_same_lines_without_a_recording() -> None:
    replay = small()
    machine, events = replay.machine, replay.events
    whole = replace(replay, rehearsed=rehearse(machine, events, replay.end_ns))
    _, *wanted = verdict_lines(whole)
    assert list(event_lines(machine, events, replay.start_ns, replay.end_ns)) == wanted


def small() -> Replay:
    """A level that is stale, back, too high, and still too high after the clock fell back."""
    draft = Draft()
    used = draft.input(draft.channel(), SECOND)
    draft.inputs[used] = replace(draft.inputs[used], name="level")
    signal = draft.signal(ir.Read(draft.slot(used)), "level", "cm", 100.0)
    limit = draft.signal(ir.Constant(0.5), "50 cm", "cm", 100.0)
    node = ir.Compare(ir.Comparison.GREATER, signal, limit)
    draft.rule(draft.proposition(node, "tank.full", "level > 50 cm"))
    machine = draft.machine()
    monitor = Interpreter(machine)
    events = [
        event
        for at_s, level in ((10, math.nan), (11, 0.25), (12, 0.75), (11, 0.8), (12, 0.1))
        for event in monitor.update(at_s * SECOND, {0: ChannelValues({0: level})})
    ]
    return Replay(machine, "tank.ross", "tank.csv", "native", 10 * SECOND, 12 * SECOND,
                  tuple(events), (), ("Two rows were skipped.",))  # fmt: skip


def test_the_schema_does_not_change_unnoticed(*, bless: bool) -> None:
    text = "".join(line + "\n" for line in verdict_lines(small()))
    assert_golden(GOLDEN / "tank.jsonl", text, bless=bless)


def test_task_commands_follow_the_verdicts_that_lead_to_them(*, bless: bool) -> None:
    text = "".join(line + "\n" for line in verdict_lines(docking()))
    assert_golden(GOLDEN / "dock.jsonl", text, bless=bless)


def test_seconds_go_on_over_a_jump() -> None:
    found = lines(small())
    assert [item["time_s"] for item in found[1:]] == [0.0, 1.0, 2.0, 2.0, 3.0]
    assert [item["type"] for item in found[3:]] == ["verdict", "time_jump", "verdict"]
    assert found[-1]["cause"]["conditions"][0]["since_s"] == 3.0


def test_unknown_is_null_and_says_which_input_is_stale() -> None:
    stale = lines(small())[1]
    assert stale["change"] == "activated_stale"
    assert stale["cause"]["conditions"][0]["values"][0]["value"] is None
    assert stale["cause"]["stale_inputs"] == [
        {"name": "level", "topic": "/topic_0", "state": "unusable"}
    ]


@given(cases())
def test_every_event_is_one_line_of_strict_json(case: tuple[ir.Machine, list[Step]]) -> None:
    machine, trace = case
    monitor = Interpreter(machine)
    events = tuple(event for step in trace for event in take(monitor, step))
    ends = (trace[0].at_ns, trace[-1].at_ns)
    replay = Replay(machine, "a\n.ross", "b", "python", *ends, events, (), ())
    found = list(verdict_lines(replay))
    assert len(found) == 1 + len(events)
    for line in found:
        assert "\n" not in line
        json.loads(line, parse_constant=_refuse)


def _refuse(word: str) -> None:
    raise AssertionError(f"{word} is not JSON")


def test_the_reference_shows_what_is_written() -> None:
    page = Path(__file__).parents[3] / "docs" / "reference" / "verdicts.md"
    examples = re.findall(r"```json\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)
    assert len(examples) == 4
    for example in examples:
        assert json.loads(example) in [*lines(small()), *lines(docking())]
