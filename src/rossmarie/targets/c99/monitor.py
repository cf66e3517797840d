"""A machine as C99. `generate` gives the header and the source.

`generate_loadable` adds the files with which `rossmarie.native` runs a monitor in its own process.
`generate_guard` adds the files with which it runs a monitor with its reactor.

The input is a machine that `ir.verify` has accepted and for which `unsupported` found nothing. The
C behaves exactly like the interpreter; `docs/decisions/0004-c99-target.md` explains its speed.
"""

from __future__ import annotations

from collections.abc import Iterator

from jinja2 import Environment, PackageLoader, StrictUndefined

from rossmarie import ir
from rossmarie.ir import reactions
from rossmarie.targets import comments
from rossmarie.targets.c99 import describe, engine, functions, host, reactor, state, tables
from rossmarie.targets.c99.layout import lay_out
from rossmarie.targets.c99.messages import Messages
from rossmarie.targets.c99.nodes import derive
from rossmarie.targets.c99.text import indented, table
from rossmarie.targets.formulas import definitions, fixed_definitions


def generate(machine: ir.Machine) -> dict[str, str]:
    """The files of a machine, by name: NAME_monitor.h and NAME_monitor.c and, if its rules have
    actions, NAME_reactor.h and NAME_reactor.c; and the files of the engine.
    """
    return {**own_files(machine), **engine.files()}


def own_files(machine: ir.Machine) -> dict[str, str]:
    """The files of `generate` without the engine: the code of these rules."""
    writer = _Writer(machine)
    return {**writer.monitor_files(), **writer.reactor_files()}


def generate_loadable(machine: ir.Machine) -> dict[str, str]:
    """The files of a monitor and of the engine, and host.c. Compile host.c instead of the other
    files, because it includes them.
    """
    writer = _Writer(machine)
    return {**writer.monitor_files(), **engine.files(), "host.c": writer.host_file()}


def generate_guard(machine: ir.Machine) -> dict[str, str]:
    """The files of a monitor and its reactor, and guard.c. Compile guard.c after host.c, together
    with NAME_reactor.c if there is one.
    """
    writer = _Writer(machine)
    guarding = {**writer.reactor_files(), "guard.c": writer.guard_file()}
    return {**writer.monitor_files(), **engine.files(), "host.c": writer.host_file(), **guarding}


class _Writer:
    """Fills in the templates for one machine."""

    def __init__(self, machine: ir.Machine) -> None:
        self._layout = lay_out(machine)
        self._messages = Messages(self._layout)
        self._templates = Environment(
            loader=PackageLoader("rossmarie.targets.c99"),
            undefined=StrictUndefined,
            autoescape=False,
            trim_blocks=True,
            keep_trailing_newline=True,
        )

    def monitor_files(self) -> dict[str, str]:
        name = self._layout.name
        return {f"{name}_monitor.h": self._header(), f"{name}_monitor.c": self._source()}

    def reactor_files(self) -> dict[str, str]:
        if not self._layout.machine.reactions.tasks:
            return {}
        blanks = reactor.blanks(self._layout)
        return {
            f"{self._layout.name}_reactor.h": self._fill("reactor.h.j2", **blanks),
            f"{self._layout.name}_reactor.c": self._fill("reactor.c.j2", **blanks),
        }

    def host_file(self) -> str:
        return self._fill("host.c.j2", **host.blanks(self._layout, self._messages))

    def guard_file(self) -> str:
        found = self._layout.machine.reactions
        resets = [isinstance(task.effect, reactions.Reset) for task in found.tasks]
        margins = [each.signal for each in ir.margins_of(self._layout.machine)]
        return self._fill(
            "guard.c.j2",
            rules=len(self._layout.machine.rules),
            tasks=len(found.tasks),
            commands=len(found.commands) if found.tasks else 0,
            confirmed=any(reactions.confirmation(task.effect) is not None for task in found.tasks),
            poses=bool(found.memories),
            most_numbers=max((len(each.readings) for each in found.memories), default=0),
            resets=table("unsigned char", "task_resets", list(map(int, resets))),
            margins=len(margins),
            margin_signals=table("int", "guard_margin_signals", margins),
        )

    def _fill(self, template: str, **blanks: object) -> str:
        known = {
            "name": self._layout.name,
            "files": comments.in_c(comments.rules_files(self._layout.machine)),
            "version": engine.version(),
        }
        return self._templates.get_template(template).render(**known, **blanks)

    def _defined(self) -> Iterator[str]:
        """The called functions that take any number of operands. All other functions are in the
        engine.
        """
        names = self._messages.expressions.functions - {each.name for each in fixed_definitions()}
        called = definitions(self._layout.machine, lambda each: each.name in names)
        yield from map(functions.function, called)

    def _header(self) -> str:
        layout = self._layout
        return self._fill(
            "monitor.h.j2",
            guard=f"{layout.name.upper()}_MONITOR_H",
            upper=layout.name.upper(),
            rule_count=len(layout.machine.rules),
            rule_rows=max(1, len(layout.machine.rules)),
            most_evaluations=ir.most_evaluations(layout.machine),
            texts=describe.text_declaration(layout),
            rule_enum=describe.rule_enumeration(layout),
            max_terms=describe.most(len(rule.terms) for rule in layout.machine.rules),
            max_values=describe.most(len(rule.signals) for rule in layout.machine.rules),
            max_inputs=describe.most(len(rule.inputs) for rule in layout.machine.rules),
            members=indented(state.members(layout)),
            declarations=self._messages.declarations(),
            input_count=len(layout.machine.inputs),
            watch=self._fill("watch.h.j2") if layout.machine.watches else "",
            reading=self._fill("reading.h.j2") if layout.machine.readings else "",
        )

    def _source(self) -> str:
        layout = self._layout
        messages = self._messages.functions()
        return self._fill(
            "monitor.c.j2",
            tables=tables.tables(layout),
            functions="\n".join([*self._defined(), derive(layout), messages]),
            descriptions=describe.descriptions(layout),
        )
