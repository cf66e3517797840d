"""The data of the timeline page of one replay, or of two to compare, as JSON for the page's
scripts.

All data is bounded, so that the page of a long or noisy recording stays small: signals by their
`share` of samples, causes by `MOST_DETAILED`. Instants are seconds on the axis of the replay.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Sequence
from pathlib import PurePath

import numpy as np
from numpy.typing import NDArray

from dslkit.source import SourceFile
from rossmarie.ir import Rule, TaskCommand, TaskCommandKind, TimeJump, Verdict, explain
from rossmarie.report.axis import PlacedEvent, place
from rossmarie.report.envelope import envelope, share
from rossmarie.report.jsonl import CHANGES, cause_data, json_number
from rossmarie.report.model import Plot, PlotThreshold, Replay
from rossmarie.report.rehearsal import task_words
from rossmarie.report.runs import NamedReplay, rule_line
from rossmarie.report.spans import ActiveSpan, active_spans
from rossmarie.report.wording import format_length

MOST_DETAILED = 1_000
"""The most verdicts whose cause a page contains. Further verdicts are drawn without a cause."""

_WEIGHT = 2
"""A signal that a reader may add has this many times fewer samples than a displayed signal."""

_MOST_TASK_COMMANDS = 12
"""The most task commands that are shown for one activation."""

_TICKS = 2**32 - 1
"""Times of samples are fractions of the duration, in this number of ticks."""

_Data = dict[str, object]


def page_data(runs: Sequence[NamedReplay], sources: Sequence[SourceFile]) -> str:
    """JSON that cannot end the script element around it, whatever names it contains.

    `sources` are the files with rules that the page shows.
    """
    data = {"runs": [_run(run, sources) for run in runs]}
    text = json.dumps(data, allow_nan=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def _run(run: NamedReplay, sources: Sequence[SourceFile]) -> _Data:
    replay = run.replay
    duration = replay.duration_ns / 1e9
    limit = share(len(replay.plots))
    sparse = share(_WEIGHT * len(replay.recorded))
    placed = list(place(replay.events, replay.start_ns))
    changes, places = _changes(replay, placed)
    rows = zip(replay.machine.rules, active_spans(replay), strict=True)
    return {
        "label": run.label,
        "duration": duration,
        "rules": [_rule(rule, spans, places, sources) for rule, spans in rows],
        "changes": changes,
        "jumps": [
            [item.position_ns / 1e9, format_length(item.event.from_ns - item.event.to_ns)]
            for item in placed
            if isinstance(item.event, TimeJump)
        ],
        "plots": [_plot(plot, limit, duration) for plot in replay.plots],
        "recorded": [_plot(plot, sparse, duration) for plot in replay.recorded],
    }


# --- rules and verdicts ----------------------------------------------------------------------


def _rule(
    rule: Rule,
    spans: tuple[ActiveSpan, ...],
    places: dict[int, int],
    sources: Sequence[SourceFile],
) -> _Data:
    source, line = rule_line(rule, sources)
    return {
        "name": rule.name,
        "source": source,
        "line": line,
        "file": PurePath(sources[source].path).name,
        "contract": rule.contract,
        "actions": rule.actions,
        "categories": [each.value for each in rule.categories],
        "latched": rule.release is None,
        "total": format_length(sum(span.end_ns - span.start_ns for span in spans)),
        "spans": [
            [
                span.start_ns / 1e9,
                span.end_ns / 1e9,
                int(span.stale),
                places.get(span.opened),
                None if span.closed is None else places.get(span.closed),
                int(span.closed is None),
                format_length(span.end_ns - span.start_ns),
            ]
            for span in spans
        ],
    }


def _changes(replay: Replay, placed: list[PlacedEvent]) -> tuple[list[_Data], dict[int, int]]:
    """The first verdicts with all details. The dictionary maps their places in the events to their
    places in the result.
    """
    changes: list[_Data] = []
    places: dict[int, int] = {}
    done = _done(replay, placed)
    for index, item in enumerate(placed):
        if isinstance(item.event, Verdict) and len(changes) < MOST_DETAILED:
            places[index] = len(changes)
            changes.append(_change(replay, item.event, item, done.get(index, [])))
    return changes, places


def _change(replay: Replay, verdict: Verdict, placed: PlacedEvent, done: list[str]) -> _Data:
    return {
        "rule": verdict.rule,
        "at": placed.position_ns / 1e9,
        "change": CHANGES[verdict.change],
        "cause": cause_data(explain(replay.machine, verdict), placed.origin_ns),
        "done": done,
    }


def _done(replay: Replay, placed: list[PlacedEvent]) -> dict[int, list[str]]:
    """The effects that each activation would have had, by the place of its verdict. The ends of
    effects are left out.
    """
    lines: dict[int, list[str]] = {}
    for each in replay.rehearsed:
        if each.command.kind is TaskCommandKind.STOP:
            continue
        found = lines.setdefault(each.activation, [])
        if len(found) < _MOST_TASK_COMMANDS:
            at_ns = placed[each.after].position_ns + each.later_ns
            since_ns = at_ns - placed[each.activation].position_ns
            found.append(_task_command(replay, each.command, since_ns))
        elif len(found) == _MOST_TASK_COMMANDS:
            found.append("more is in the verdicts file")
    return lines


def _task_command(replay: Replay, command: TaskCommand, since_ns: int) -> str:
    action, effect = task_words(replay.machine, command.task)
    after = f"after {format_length(since_ns)}, " if since_ns else ""
    if command.by is not None:
        ending = f" (overruled by {replay.machine.rules[command.by].name})"
    else:
        ending = " (failed)" if command.kind is TaskCommandKind.FAILED else ""
    return f"{after}{action}: {effect}{ending}"


# --- signals ---------------------------------------------------------------------------------


def _plot(plot: Plot, limit: int, duration: float) -> _Data:
    times, values = envelope(plot, limit)
    ticks = np.round(np.clip(times / max(duration, 1e-9), 0, 1) * _TICKS)
    with np.errstate(over="ignore"):
        shown = values.astype("<f4")
    return {
        "text": plot.text,
        "unit": plot.unit,
        "times": _base64(ticks.astype("<u4")),
        "values": _base64(shown),
        "thresholds": [_threshold(threshold) for threshold in plot.thresholds],
    }


def _base64(array: NDArray[np.uint32] | NDArray[np.float32]) -> str:
    return base64.b64encode(array.tobytes()).decode("ascii")


def _threshold(threshold: PlotThreshold) -> _Data:
    return {
        "limits": threshold.limits,
        "regions": [[json_number(low), json_number(high)] for low, high in threshold.regions],
        "text": threshold.text,
        "rules": threshold.rules,
        "releases": threshold.releases,
    }
