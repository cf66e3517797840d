"""`rossmarie failures`: what rules do when an input is stale."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import typer

from rossmarie.analysis.failures import losses
from rossmarie.analysis.inquiry import Inquiry
from rossmarie.analysis.loss import Effect, Loss
from rossmarie.cli.output import output
from rossmarie.driver import RulesError, compile_file
from rossmarie.ir import Machine
from rossmarie.ir.duration_text import duration_text

_HEAD = ("Input", "Topic", "Stale after", "Becomes active", "May become active")


def run_failures(rules: Path, systems: Sequence[Path], message_folders: Sequence[Path]) -> None:
    """Print a paragraph for each input, as the table of failures of a rules file."""
    try:
        compiled = compile_file(rules, systems=systems, message_folders=message_folders)
    except RulesError as error:
        output.reject(error.diagnostics)
    machine = compiled.machine
    rows: list[tuple[str, ...]] = [_HEAD]
    rows += [_row(machine, loss) for loss in losses(Inquiry(machine))]
    for line in _table(rows):
        typer.echo(line)


def _row(machine: Machine, loss: Loss) -> tuple[str, ...]:
    declared = machine.inputs[loss.input]
    return (
        declared.name,
        machine.channels[declared.channel].topic,
        "never" if loss.after_ns is None else duration_text(loss.after_ns),
        _names(machine, loss, Effect.ACTIVATES),
        _names(machine, loss, Effect.DEPENDS),
    )


def _names(machine: Machine, loss: Loss, effect: Effect) -> str:
    return ", ".join(machine.rules[rule].name for rule in loss.rules(effect)) or "-"


def _table(rows: Sequence[tuple[str, ...]]) -> Iterator[str]:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        cells = (f"{cell:{width}}" for cell, width in zip(row, widths, strict=True))
        yield "  ".join(cells).rstrip()
