"""Lessons as tables on a terminal, or as plain text in a file or pipe."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from dslkit.diagnostics.visible import visible
from ezskiros.learning.lessons import Cost, Lessons, Places, Trip

_UNBROKEN = 1_000_000
"""A width in columns at which no plain line is wrapped."""
_MOST_COSTS = 20
"""The most rows of costs in the output. The file has all of them."""

Spell = Callable[[str], str]
"""Gives the name of an individual, by its IRI."""


def print_report(lessons: Lessons, console: Console, spell: Spell) -> None:
    """Print the lessons of runs: activations, failures and costs."""
    runs = f"{lessons.runs} run{'s' if lessons.runs != 1 else ''}"
    if not (lessons.trips or lessons.failures or lessons.stale):
        console.print(f"{runs}: no rule became active while skills ran, and no skill failed")
        return
    console.print(runs)
    for title, header, rows in _tables(lessons, spell):
        if rows:
            console.print()
            _print_table(title, header, rows, console)


def places_text(places: Places, spell: Spell) -> str:
    """Places for readers: `Target = skiros:Location-2`."""
    return ", ".join(f"{name} = {spell(iri)}" for name, iri in places)


def _tables(
    lessons: Lessons, spell: Spell
) -> Iterator[tuple[str, Sequence[str], Sequence[Sequence[str]]]]:
    trips = [row for each in lessons.trips for row in _trip_rows(each, spell)]
    header = ("Rule", "Skill", "Within", "With", "Runs", "Times", "Lost")
    yield "Rules that became active", header, trips
    failures = [(each.skill, str(each.share), each.reason) for each in lessons.failures]
    yield "Skills that failed", ("Skill", "Runs", "Most frequent reason"), failures
    costly = [each for each in lessons.costs if each.lost_s > 0][:_MOST_COSTS]
    costs = [_cost_row(each, spell) for each in costly]
    yield "Time lost to rules", ("Skill", "With", "Each time", "Executions"), costs
    stale = [(each.rule, str(each.share)) for each in lessons.stale]
    yield "Rules with a stale input", ("Rule", "Runs"), stale


def _trip_rows(trip: Trip, spell: Spell) -> Iterator[Sequence[str]]:
    """A row for the skill, and a row for each of its places at which the rule became active."""
    skill = trip.skill if trip.skill is not None else "(none)"
    within = ", ".join(trip.within)
    counts = (str(trip.share), str(trip.activations), f"{trip.lost_s:.1f} s")
    yield trip.rule, skill, within, "", *counts
    for places, share in trip.at.items():
        if places and share.runs:
            yield "", "", "", places_text(places, spell), str(share), "", ""


def _cost_row(cost: Cost, spell: Spell) -> Sequence[str]:
    places = places_text(cost.places, spell)
    return cost.skill, places, f"{cost.expected_s:.1f} s", str(cost.executions)


def _print_table(
    title: str, header: Sequence[str], rows: Iterable[Sequence[str]], console: Console
) -> None:
    """Print a table: on a terminal fitted to its width, otherwise with one line per row."""
    styled = console.is_terminal
    table = Table(box=SIMPLE_HEAD if styled else None, pad_edge=False, header_style="bold")
    for each in header:
        table.add_column(each, overflow="fold")
    for row in rows:
        table.add_row(*(Text(visible(cell)) for cell in row))
    console.print(Text(title, style="bold"))
    if styled:
        console.print(table)
        return
    plain = Console(width=_UNBROKEN, no_color=True, highlight=False)
    with plain.capture() as capture:
        plain.print(table)
    for line in capture.get().splitlines():
        console.print(Text(line.rstrip()), soft_wrap=True)
