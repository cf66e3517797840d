"""A wiring as text for a terminal, without colours, and with lines of limited width."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from textwrap import wrap

from rich.console import Console
from rich.table import Table
from rich.text import Text

from rossmarie.ir.duration_text import duration_text
from rossmarie.report.wiring.model import PLANNER, ROBOT, EffectUse, NodeWiring, WiredCommand

_INDENT = 2
_UNBROKEN = 1_000_000
"""A width, in columns, at which no line needs a break."""


def wiring_text(wiring: NodeWiring, width: int | None = None) -> str:
    """The wiring in lines of at most `width` columns; without a width, unbroken lines."""
    room = (width or _UNBROKEN) - _INDENT
    sections = [
        *(_command(wiring.node, command, room) for command in wiring.commands),
        *([["Listens to", *_inputs(wiring, room)]] if wiring.inputs else []),
        *([["Acts on", *_outputs(wiring, room)]] if wiring.outputs else []),
        *([wrap(wiring.remark, room)] if wiring.remark else []),
    ]
    return "\n\n".join("\n".join(lines) for lines in [[wiring.node], *sections]) + "\n"


def _command(node: str, command: WiredCommand, room: int) -> list[str]:
    path = [PLANNER, command.unfiltered, node, command.topic, ROBOT]
    return [
        f"Commands: {command.message_type}",
        *_indented(_chain(path, room)),
        *_indented(_table(("Filtered by", "Action", "Rules"), map(_use, command.uses), room)),
    ]


def _chain(path: Sequence[str], room: int) -> list[str]:
    """The stations of a path with arrows between them. Lines are broken before arrows."""
    lines = [path[0]]
    for station in path[1:]:
        if len(lines[-1]) + len(station) + 5 <= room:
            lines[-1] += f" --> {station}"
        else:
            lines.append(f"--> {station}")
    return lines


def _inputs(wiring: NodeWiring, room: int) -> Iterator[str]:
    rows = [
        (
            each.topic,
            each.message_type,
            "none" if each.timeout_ns is None else duration_text(each.timeout_ns),
            ", ".join(each.rules),
        )
        for each in wiring.inputs
    ]
    return _indented(_table(("Topic", "Type", "Timeout", "Rules"), rows, room))


def _outputs(wiring: NodeWiring, room: int) -> Iterator[str]:
    """A line for each kind, followed by a line for each use."""
    rows: list[Sequence[str]] = []
    for kind, outputs in groupby(wiring.outputs, key=lambda each: each.kind):
        rows.append((kind.value,))
        for output in outputs:
            for effect, action, rules in map(_use, output.uses):
                rows.append((f"  {effect}", output.type or "", action, rules))
    return _indented(_table(("Effect", "Type", "Action", "Rules"), rows, room))


def _use(use: EffectUse) -> tuple[str, str, str]:
    return use.effect, use.action, ", ".join(use.rules)


def _table(head: Sequence[str], rows: Iterable[Sequence[str]], room: int) -> list[str]:
    table = Table(box=None, pad_edge=False)
    for title in head:
        table.add_column(title, overflow="fold")
    for row in rows:
        table.add_row(*map(Text, row))
    console = Console(width=room, no_color=True, highlight=False, force_terminal=False)
    with console.capture() as capture:
        console.print(table)
    return [line.rstrip() for line in capture.get().splitlines()]


def _indented(lines: Sequence[str]) -> Iterator[str]:
    return (" " * _INDENT + line for line in lines)
