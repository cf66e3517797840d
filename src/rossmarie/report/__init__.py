"""The results of a replay, for readers: a table, JSON lines, and a timeline that opens in a
browser.

Beside it, in `wiring`, how the node of a rules file is connected.
"""

from rossmarie.report.axis import Axis
from rossmarie.report.envelope import share, thinned
from rossmarie.report.jsonl import event_lines, verdict_lines
from rossmarie.report.model import Plot, Replay, Threshold
from rossmarie.report.plots import PlotPlan, plan_plots
from rossmarie.report.rehearsal import Rehearsed, rehearse
from rossmarie.report.spans import ActiveSpan, Summary, active_spans, summarize
from rossmarie.report.table import write_table
from rossmarie.report.timeline import render_timeline

__all__ = [
    "ActiveSpan",
    "Axis",
    "Plot",
    "PlotPlan",
    "Rehearsed",
    "Replay",
    "Summary",
    "Threshold",
    "active_spans",
    "event_lines",
    "plan_plots",
    "rehearse",
    "render_timeline",
    "share",
    "summarize",
    "thinned",
    "verdict_lines",
    "write_table",
]
