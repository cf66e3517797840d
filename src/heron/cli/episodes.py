"""Episodes on the terminal: what the guard said, and the measures."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from rich.console import Console
from rich.table import Table

from heron.experiments import HumanEpisode, NavigationEpisode, PlacingEpisode

Rows = Iterable[tuple[str, str]]


def print_navigation(episode: NavigationEpisode) -> None:
    """An episode of experiment I."""
    on = f"on {episode.terrain.value} terrain"
    _print(f"{episode.arm.value} {on}, seed {episode.seed}", episode.told, _of_navigation(episode))


def print_placing(episode: PlacingEpisode) -> None:
    """An episode of experiment II."""
    height = 100 * episode.parameters.too_high
    title = f"{episode.arm.value}, table {height:.1f} cm too high, seed {episode.seed}"
    _print(title, episode.told, _of_placing(episode))


def print_human(episode: HumanEpisode) -> None:
    """An episode of experiment III."""
    title = f"{episode.arm.value}, somebody {episode.person.value}, seed {episode.seed}"
    _print(title, episode.told, _of_human(episode))


def _print(title: str, told: Iterable[tuple[float, str]], rows: Rows) -> None:
    console = Console(highlight=False)
    for at_s, words in told:
        console.print(f"{at_s:8.2f} s  {words}", soft_wrap=True, markup=False)
    table = Table("measure", "value", title=title, title_justify="left")
    table.columns[1].justify = "right"
    for name, value in rows:
        table.add_row(name, value)
    console.print(table)


def _of_navigation(episode: NavigationEpisode) -> Iterator[tuple[str, str]]:
    found = episode.measures
    yield "task", "completed" if found.is_completed else episode.outcome.value
    yield "time", f"{found.duration:.1f} s"
    yield "visits of the operator", str(found.interventions)
    yield "other ways taken", str(found.replanned)
    for axle, peak in found.peaks.items():
        yield f"peak acceleration, {axle} axle", f"{peak:.1f} m/s²"
    yield "at the limit of torque", f"{found.time_at_torque_limit:.1f} s"
    yield from _of_rules(found.reactions, found.time_restricted, found.time_restricted_without_need)


def _of_placing(episode: PlacingEpisode) -> Iterator[tuple[str, str]]:
    found = episode.measures
    yield "task", "completed" if found.is_completed else "not completed"
    yield "time", f"{found.duration:.1f} s"
    yield "visits of the operator", str(found.interventions)
    yield "attempts", str(found.attempts)
    yield "peak force", f"{found.peak_force:.0f} N"
    yield "above 30 N", f"{found.time_above_30_n:.2f} s"
    yield "peak torque of a joint", f"{100 * found.peak_effort:.0f} % of its limit"
    yield "above 60 % of it", f"{found.time_over_torque:.2f} s"
    yield from _of_rules(found.reactions, found.time_restricted, found.time_restricted_without_need)


def _of_human(episode: HumanEpisode) -> Iterator[tuple[str, str]]:
    found = episode.measures
    yield "task", "completed" if found.is_completed else episode.outcome.value
    yield "time", f"{found.duration:.1f} s"
    yield "visits of the operator", str(found.interventions)
    yield "least distance to the person", f"{found.nearest:.2f} m"
    yield "fastest within 1 m of them", f"{found.fastest_near:.2f} m/s"
    yield "greatest product of speed and closeness", f"{found.risk:.2f} m/s"
    yield "above 0.25 m/s within 1 m", f"{found.time_too_fast:.1f} s"
    yield from _of_rules(found.reactions, found.time_restricted, found.time_restricted_without_need)


def _of_rules(
    reactions: Mapping[str, float], restricted: float, without_need: float
) -> Iterator[tuple[str, str]]:
    for hazard, reaction in reactions.items():
        yield f"reaction, {hazard}", f"{reaction:.2f} s"
    yield "restricted", f"{restricted:.1f} s"
    yield "restricted without need", f"{without_need:.1f} s"
