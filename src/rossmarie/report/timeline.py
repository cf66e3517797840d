"""A replay as one HTML page that needs only a browser: no network, no other file.

The page contains the data that `page.py` prepares; its scripts draw the picture. The template
contains the text for readers without scripts, or on paper.
"""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime, timezone
from pathlib import PurePath

from markupsafe import Markup

from rossmarie.ir import Verdict
from rossmarie.report.model import Replay
from rossmarie.report.page import MOST_DETAILED, page_data
from rossmarie.report.runs import NamedReplay, compared_rules, runs_of, sources_of
from rossmarie.report.spans import summarize
from rossmarie.report.templates import asset, template
from rossmarie.report.wording import format_length, format_position

_FIRST_DATED_NS = 10**18
"""Stamps from this one on (the year 2001) count from the Unix epoch. Smaller stamps may have any
origin.
"""

_SCRIPTS = (
    "times.js", "series.js", "shapes.js", "runs.js", "card.js", "rows.js", "plot.js", "view.js",
    "signals.js", "image.js", "main.js",
)  # fmt: skip


def render_timeline(replay: Replay, compared: Replay | None = None) -> str:
    """The text of the page. With `compared`, it shows both replays on one time axis."""
    summaries = summarize(replay)
    runs = runs_of(replay, compared)
    sources = sources_of(runs)
    return template("timeline.html.j2").render(
        rules_file=PurePath(replay.rules_file).name,
        recording=PurePath(replay.recording).name,
        duration=format_length(replay.duration_ns),
        recorded=_recorded(replay.start_ns),
        monitor=replay.monitor,
        notes=_notes(runs),
        runs=runs,
        compared=compared_rules(runs),
        sources=[(PurePath(each.path).name, each.text.splitlines()) for each in sources],
        rules=list(zip(replay.machine.rules, summaries, strict=True)),
        activations=sum(summary.activations for summary in summaries),
        format_length=format_length,
        format_position=format_position,
        percent=lambda length_ns: _percent(length_ns, replay.duration_ns),
        style=Markup(asset("palette.css") + asset("timeline.css")),
        script=Markup("\n".join(asset(name) for name in _SCRIPTS)),
        listed=_listed(runs),
        data=Markup(page_data(runs, sources)),
    )


def _notes(runs: Sequence[NamedReplay]) -> list[str]:
    """The findings about the recordings. With two runs, each begins with the name of its run."""
    return [
        f"{run.label}: {note}" if run.label else note for run in runs for note in run.replay.notes
    ]


def _listed(runs: Sequence[NamedReplay]) -> str:
    """Describe the list of changes: the page contains only the first changes of a run."""
    counts = [sum(isinstance(each, Verdict) for each in run.replay.events) for run in runs]
    most = max(counts)
    if most <= MOST_DETAILED:
        return "Every change, in order"
    return f"The first {MOST_DETAILED} of {most} changes, in order; all are in the verdicts file"


def _recorded(start_ns: int) -> str:
    if start_ns < _FIRST_DATED_NS:
        return ""
    start = datetime.fromtimestamp(start_ns // 10**9, tz=timezone.utc)
    return start.strftime("%Y-%m-%d %H:%M:%S UTC")


def _percent(length_ns: int, duration_ns: int) -> str:
    share = 100 * length_ns / duration_ns if duration_ns > 0 else 0
    return f"{share:.1f} %" if 0 < share < 9.95 else f"{share:.0f} %"
