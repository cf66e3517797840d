"""The times during which each rule was active, and a summary of each rule, from the verdicts.

Verdicts of one rule alternate between activations and clearings (monitors guarantee this). All
instants are positions in ns on the axis of the replay.
"""

from __future__ import annotations

from dataclasses import dataclass

from rossmarie.ir import Change, Event, InputState, Machine, Verdict, explain
from rossmarie.report.axis import PlacedEvent, place
from rossmarie.report.model import Replay


@dataclass(frozen=True)
class ActiveSpan:
    """A rule is active from `start_ns` up to `end_ns` (positions on the axis of the replay).

    `opened` and `closed` are the places of the two verdicts in `Replay.events`. If the rule is
    still active when the recording ends, `closed` is None and `end_ns` is the end of the replay.
    `stale` is True if the rule became active because of a stale input.
    """

    rule: int
    start_ns: int
    end_ns: int
    opened: int
    closed: int | None
    stale: bool

    @property
    def length_ns(self) -> int:
        """The duration."""
        return self.end_ns - self.start_ns


@dataclass(frozen=True)
class Summary:
    """One rule over a whole replay; `first_ns` is on the axis of the replay.

    The first cause is the cause of the first activation that is not a start, because waiting for
    the first message of an input is not informative. If a rule only waited, the first cause is this
    wait.
    """

    rule: str
    activations: int
    stale_activations: int
    total_ns: int
    longest_ns: int
    first_ns: int | None
    first_cause: str
    active_at_end: bool


def active_spans(replay: Replay) -> tuple[tuple[ActiveSpan, ...], ...]:
    """The active spans of each rule, in time order."""
    spans: list[list[ActiveSpan]] = [[] for _ in replay.machine.rules]
    opened: dict[int, tuple[int, PlacedEvent]] = {}
    for index, placed in enumerate(place(replay.events, replay.start_ns)):
        event = placed.event
        if not isinstance(event, Verdict):
            continue
        if event.change is not Change.CLEARED:
            opened[event.rule] = (index, placed)
            continue
        start, first = opened.pop(event.rule)
        spans[event.rule].append(_span(event.rule, start, first, index, placed.position_ns))
    for rule, (start, first) in opened.items():
        end = max(replay.duration_ns, first.position_ns)
        spans[rule].append(_span(rule, start, first, None, end))
    return tuple(tuple(row) for row in spans)


def _span(
    rule: int, opened: int, first: PlacedEvent, closed: int | None, end_ns: int
) -> ActiveSpan:
    stale = isinstance(first.event, Verdict) and first.event.change is Change.ACTIVATED_STALE
    return ActiveSpan(rule, first.position_ns, end_ns, opened, closed, stale)


def summarize(replay: Replay) -> tuple[Summary, ...]:
    """A summary of each rule, in the order of the rules file."""
    placed = tuple(place(replay.events, replay.start_ns))
    return tuple(
        _summary(replay.machine, rule.name, spans, placed)
        for rule, spans in zip(replay.machine.rules, active_spans(replay), strict=True)
    )


def _summary(
    machine: Machine, rule: str, spans: tuple[ActiveSpan, ...], placed: tuple[PlacedEvent, ...]
) -> Summary:
    lengths = [span.length_ns for span in spans]
    telling = (span for span in spans if not _is_start(placed[span.opened].event))
    first = next(telling, spans[0] if spans else None)
    return Summary(
        rule=rule,
        activations=len(spans),
        stale_activations=sum(span.stale for span in spans),
        total_ns=sum(lengths),
        longest_ns=max(lengths, default=0),
        first_ns=first.start_ns if first else None,
        first_cause=_cause(machine, placed[first.opened]) if first else "",
        active_at_end=bool(spans) and spans[-1].closed is None,
    )


def _is_start(event: Event) -> bool:
    """Say whether a rule became active because the first message of an input had not arrived."""
    return (
        isinstance(event, Verdict)
        and event.change is Change.ACTIVATED_STALE
        and InputState.NEVER in event.inputs
        and InputState.EXPIRED not in event.inputs
    )


def _cause(machine: Machine, placed: PlacedEvent) -> str:
    verdict = placed.event
    return explain(machine, verdict).line(placed.origin_ns) if isinstance(verdict, Verdict) else ""
