"""`rossmarie failures`: the reaction of rules to stale inputs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import typer

from dslkit.diagnostics.render_json import Json
from dslkit.options import ReportFormat
from rossmarie.analysis.failures import losses
from rossmarie.analysis.inquiry import Inquiry
from rossmarie.analysis.loss import Effect, Loss
from rossmarie.cli.output import output
from rossmarie.driver import RulesError, compile_file
from rossmarie.ir import Machine
from rossmarie.ir.duration_text import duration_text

_HEAD = ("Input", "Topic", "Stale after", "Becomes active", "May become active")


def run_failures(
    rules: Path, form: ReportFormat, systems: Sequence[Path], message_folders: Sequence[Path]
) -> None:
    """Print a paragraph for each input, or the table of failures of a rules file."""
    with output.answering(form, "failures", files=1) as answer:
        try:
            compiled = compile_file(rules, systems=systems, message_folders=message_folders)
        except RulesError as error:
            output.reject(error.diagnostics)
        machine = compiled.machine
        found = list(losses(Inquiry(machine)))
        answer.result = failures_result(machine, found)
        if answer.is_printed:
            return
        for line in _table([_HEAD, *(_row(machine, loss) for loss in found)]):
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


def failures_result(machine: Machine, losses: Sequence[Loss]) -> Json:
    """Each input with the rules that become active while it is stale. Times are in ns."""
    return {"inputs": [_failure(machine, each) for each in losses]}


def _failure(machine: Machine, loss: Loss) -> Json:
    declared = machine.inputs[loss.input]
    return {
        "input": declared.name,
        "topic": machine.channels[declared.channel].topic,
        "stale_after_ns": loss.after_ns,
        "becomes_active": [machine.rules[each].name for each in loss.rules(Effect.ACTIVATES)],
        "may_become_active": [machine.rules[each].name for each in loss.rules(Effect.DEPENDS)],
    }
