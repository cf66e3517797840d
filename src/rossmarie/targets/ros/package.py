"""A machine as a package for ROS: the files that ROS 1 and ROS 2 share, and what fills them in.

Takes a machine that `ir.verify` has passed and for which `unsupported` found nothing.
"""

from __future__ import annotations

from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined

from rossmarie import ir
from rossmarie.ir.reactions import CommandTopic
from rossmarie.naming import node_name, unfiltered
from rossmarie.targets import c99, comments
from rossmarie.targets.c99.layout import Layout, lay_out
from rossmarie.targets.manifest import Placement
from rossmarie.targets.ros import (
    actions,
    messages,
    names,
    needs,
    parameters,
    placement,
    reaction_test,
    readme,
    runtime,
    tables,
)
from rossmarie.targets.ros.dialect import Dialect, Interface, Part, message_package

OWNED_BY_USER = frozenset(("src/hooks.cpp", "config/parameters.yaml"))
"""Files that are written once and then left alone."""

_FIXED = (
    "src/operators.cpp", "src/telling.cpp", "src/interfaces.h", "src/latched_rules.h",
    "msg/Value.msg", "msg/Verdict.msg", "msg/TaskState.msg", "msg/State.msg",
    "srv/Reset.srv", "srv/Why.srv", "srv/Exempt.srv",
)  # fmt: skip

# Only where commands pass.
_FILTERS = ("src/filter.h",)

_SHOWN_TEXT = """\
    if (text.kind == ValueText::TEXT)
        return value < 0.0 ? "another text" : {name}_texts[static_cast<int>(value)];
"""


class PackageWriter:
    """Fills in the templates for one machine in one dialect."""

    def __init__(self, machine: ir.Machine, dialect: Dialect, placed: Placement) -> None:
        self._machine = machine
        self._dialect = dialect
        self._placed = placed
        self._layout: Layout = lay_out(machine)
        targets = (f"rossmarie.targets.{each}" for each in (dialect.folder, "ros"))
        self._templates = Environment(
            loader=ChoiceLoader([PackageLoader(each) for each in targets]),
            undefined=StrictUndefined,
            autoescape=False,
            keep_trailing_newline=True,
        )

    def fill(self, template: str, **blanks: object) -> str:
        """The text of a template. `package` is the node, and its own package if it has one; `home`
        is the package that it is built in.
        """
        known = {
            **placement.blanks(self._machine, self._placed),
            "name": self._layout.name,
            "upper": self._layout.name.upper(),
            "package": node_name(self._machine),
            "files": comments.inside(template, comments.rules_files(self._machine)),
            "primitives": self._dialect.primitives,
            "generation": self._dialect.generation,
        }
        return self._templates.get_template(f"{template}.j2").render(**known, **blanks)

    def shared_files(self) -> dict[str, str]:
        """All files but those that say how to build and to start, and what is the node itself."""
        machine = self._machine
        core = {f"src/{name}": text for name, text in c99.generate(machine).items()}
        used = (
            *_FIXED,
            *(_FILTERS if machine.reactions.commands else ()),
        )
        copies = runtime.copies(self._dialect.folder)
        return {path: self.fill(path) for path in used} | self._source_files() | core | copies

    def packages(self) -> set[str]:
        """The packages of what the node takes and sends, and of what it tells."""
        used = [*messages.types_of(self._machine)]
        used += [sent for sent, _ in actions.sent_types(self._machine)]
        found = {message_package(each) for each in used} | {"diagnostic_msgs"}
        return found.union(*(part.packages for part in self._parts()))

    def guard(self, used: set[str]) -> dict[str, str]:
        """How the node is built, in its own package or in another."""
        hooks = " ".join(names.hooks(self._machine).values())
        components = "\n  ".join(sorted(used))
        return {
            "needs.cmake": self.fill("needs.cmake", hooks=hooks, components=components),
            "guard.cmake": self.fill("guard.cmake"),
        }

    def own_package(self, used: set[str], **blanks: object) -> dict[str, str]:
        """The files that only a package of its own has: they say how to build it. `used` are the
        packages that the node needs.
        """
        if self._placed.part_of is not None:
            return {}
        fields = placement.manifest_fields(
            self._placed.manifest, comments.rules_files(self._machine)
        )
        depends = "\n".join(f"  <depend>{name}</depend>" for name in sorted(used))
        return {
            "package.xml": self.fill("package.xml", depends=depends, **fields),
            "CMakeLists.txt": self.fill("CMakeLists.txt", **blanks),
            "README.md": self.fill("README.md", **readme.blanks(self._machine, self._dialect)),
        }

    def _parts(self) -> list[Part]:
        return needs.parts(self._machine, self._dialect)

    def _source_files(self) -> dict[str, str]:
        """The sources, as far as they differ from machine to machine."""
        machine, dialect, package = self._machine, self._dialect, node_name(self._machine)
        hooks = names.hooks(machine).values()
        channels = range(len(self._layout.channel_names))
        texts = _SHOWN_TEXT.format(name=self._layout.name) if machine.texts else ""
        blanks: dict[str, dict[str, object]] = {
            "src/guard.h": {
                "rule_rows": max(1, len(machine.rules)),
                "channel_rows": max(1, len(machine.channels)),
            },
            "src/guard.cpp": {
                "subscriptions": "\n".join(map(self._subscription, channels)),
                "channels": "\n".join(map(self._channel, channels)) or "    {},",
                "sources": "\n".join(map(self._source, machine.reactions.commands)),
            },
            "src/settings.cpp": {"parameters": parameters.table(package)},
            "config/parameters.yaml": {"parameters": parameters.yaml(package)},
            "src/messages.h": {
                "includes": messages.includes(machine, dialect),
                "text_index": messages.text_index(self._layout),
                "arrays": messages.arrays(self._layout),
                "fills": messages.fills(self._layout, dialect),
                "commands": messages.commands(machine, dialect),
            },
            "src/actions.h": actions.TasksText(machine, dialect).blanks(),
            "src/descriptions.h": tables.blanks(machine, dialect),
            "src/reports.h": {"shown_text": texts},
            "test/test_reactions.c": reaction_test.blanks(machine, self._layout.name),
            "src/hooks.h": {
                "declarations": "".join(f"void {hook}(Moment moment);\n" for hook in hooks)
            },
            "src/hooks.cpp": {"definitions": "\n".join(map(_hook_definition, hooks))},
        }
        return {path: self.fill(path, **each) for path, each in blanks.items()}

    def _channel(self, channel: int) -> str:
        """An input topic, and whether its messages have a stamp."""
        topic = self._machine.channels[channel]
        kind = self._dialect.cpp_type(topic.message_type, Interface.MESSAGE)
        return f"    {{{names.relative(topic.topic)}, has_stamp<{kind}>()}},"

    def _source(self, command: CommandTopic) -> str:
        """Where commands come from."""
        return f"    topics.push_back({names.relative(unfiltered(command.topic))});"

    def _subscription(self, channel: int) -> str:
        """The lines that subscribe to an input topic."""
        topic, name = self._machine.channels[channel], self._layout.channel_names[channel]
        kind = self._dialect.cpp_type(topic.message_type, Interface.MESSAGE)
        literal = names.relative(topic.topic)
        return (
            f"    inputs_.push_back(std::make_unique<Input<{kind}>>(\n"
            f"        middleware_, clock_, {literal}, channel_timeouts_ns[{channel}], "
            f"by_stamp({literal}),\n"
            f"        [this](const {kind} &message, int64_t at_ns) {{\n"
            f"            fill_{name}(values_, arrays_, message);\n"
            f"            take({channel}, at_ns);\n"
            f"        }}));"
        )


def _hook_definition(hook: str) -> str:
    return (
        f"void {hook}(Moment moment)\n{{\n"
        f"    say::information(moment == Moment::START ?"
        f' "hook {hook} starts" : "hook {hook} ends");\n}}\n'
    )
