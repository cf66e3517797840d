"""A machine as a package for ROS: the files that ROS 1 and ROS 2 share, and their content.

The input is a machine that `ir.verify` has accepted and for which `unsupported` found nothing.
"""

from __future__ import annotations

from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined

from rossmarie import ir
from rossmarie.ir.beams import is_of_scan
from rossmarie.naming import node_name
from rossmarie.targets import c99, comments
from rossmarie.targets.c99.layout import CLayout, lay_out
from rossmarie.targets.manifest import Placement
from rossmarie.targets.ros import (
    actions,
    messages,
    names,
    needs,
    placement,
    reaction_test,
    readme,
    runtime,
    tables,
)
from rossmarie.targets.ros.dialect import Dialect, RosInterface, RuntimePart, message_package

OWNED_BY_USER = frozenset(("src/hooks.cpp", "config/parameters.yaml"))
"""Files that are written once and then left alone."""

_FIXED = (
    "config/parameters.yaml",
    "msg/Value.msg", "msg/Verdict.msg", "msg/TaskState.msg", "msg/State.msg",
    "srv/Reset.srv", "srv/Why.srv", "srv/Exempt.srv",
)  # fmt: skip

# The C functions that the node calls. The last two exist only if commands are bounded.
_FUNCTIONS = (
    "init", "latch", "step", "advance", "reset", "next_wake", "is_active", "input_state",
    "has_all_inputs", "reactor_init", "reactor_open", "react", "report", "reactor_next_wake",
    "task_state",
)  # fmt: skip
_BOUNDING = ("bounds_of", "bounded")


class PackageWriter:
    """Fills in the templates for one machine in one dialect."""

    def __init__(self, machine: ir.Machine, dialect: Dialect, placed: Placement) -> None:
        self._machine = machine
        self._dialect = dialect
        self._placed = placed
        self._layout: CLayout = lay_out(machine)
        targets = (f"rossmarie.targets.{each}" for each in (dialect.folder, "ros"))
        self._templates = Environment(
            loader=ChoiceLoader([PackageLoader(each) for each in targets]),
            undefined=StrictUndefined,
            autoescape=False,
            keep_trailing_newline=True,
        )

    def fill(self, template: str, **blanks: object) -> str:
        """The text of a template. `package` is the node's name and the name of its own package, if
        it has one. `home` is the package in which the node is built.
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
        """All files except those for building and starting the node."""
        core = {f"src/{name}": text for name, text in c99.generate(self._machine).items()}
        settings = [(each.name, *tables.words_of(each)) for each in ir.settings_of(self._machine)]
        fixed = {path: self.fill(path, own_parameters=settings) for path in _FIXED}
        return fixed | self._source_files() | core | runtime.files(self._dialect.folder)

    def packages(self) -> set[str]:
        """The packages of all types that the node receives, sends and reports."""
        used = [*messages.types_of(self._machine)]
        used += [sent for sent, _ in actions.sent_types(self._machine, self._dialect)]
        found = {message_package(each) for each in used} | {"diagnostic_msgs"}
        return found.union(*(part.packages for part in self._parts()))

    def needs(self, used: set[str]) -> dict[str, str]:
        """The build settings of the node, in its own package or in another one."""
        hooks = "".join(f" {hook}" for hook in names.hooks(self._machine).values())
        components = "\n  ".join(sorted(used))
        return {"needs.cmake": self.fill("needs.cmake", hooks=hooks, components=components)}

    def own_package(self, used: set[str], **blanks: object) -> dict[str, str]:
        """The files that only a separate package has: its build files. `used` are the packages that
        the node needs.
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

    def _parts(self) -> list[RuntimePart]:
        return needs.parts(self._machine, self._dialect)

    def _source_files(self) -> dict[str, str]:
        """The sources that differ from machine to machine."""
        machine, hooks = self._machine, names.hooks(self._machine).values()
        blanks: dict[str, dict[str, object]] = {
            "src/rules.h": self._core(),
            "src/rules.cpp": self._rules(),
            "test/test_reactions.c": reaction_test.blanks(machine, self._layout.name),
            "src/hooks.h": {
                "declarations": "".join(f"void {hook}(Moment moment);\n" for hook in hooks)
            },
            "src/hooks.cpp": {"definitions": "\n".join(map(_hook_definition, hooks))},
        }
        return {path: self.fill(path, **each) for path, each in blanks.items()}

    def _rules(self) -> dict[str, object]:
        """The values for the placeholders of the template of `rules.cpp`."""
        machine, dialect = self._machine, self._dialect
        return {
            "includes": "\n".join(f"#include <{header}>" for header in self._message_headers()),
            "headers": "\n".join(f'#include "{header}"' for header in self._headers()),
            "channels": messages.channels(self._layout, dialect),
            "channel_types": ", ".join(names.channel_classes(self._layout).values()),
            "given": messages.given(self._layout),
            "commands": messages.commands(machine, dialect),
            "sources": messages.sources(machine),
            **actions.TasksText(machine, dialect).blanks(),
            **tables.blanks(machine, dialect, self._layout.name),
        }

    def _core(self) -> dict[str, object]:
        """The values for the placeholders of the template of `rules.h`."""
        has_commands = bool(self._machine.reactions.commands)
        return {
            "arrays": messages.arrays(self._layout),
            "has_commands": has_commands,
            "retraces": bool(self._machine.reactions.memories),
            "has_lists": bool(self._machine.lists),
            "functions": (*_FUNCTIONS, *(_BOUNDING if has_commands else ())),
        }

    def _message_headers(self) -> list[str]:
        """The headers of all types that the node receives and sends."""
        taken = ((each, RosInterface.MESSAGE) for each in messages.types_of(self._machine))
        used = {*taken, *actions.sent_types(self._machine, self._dialect)}
        return sorted(self._dialect.header(*each) for each in used)

    def _headers(self) -> list[str]:
        """The headers of the package, including the headers of tasks if the node has tasks."""
        used = ["messages.h", "parts.h", "task.h", f"{self._dialect.folder}/interfaces.h"]
        used += ["command_task.h"] if self._machine.reactions.commands else []
        used += ["clouds.h"] if any(ir.POINTS in each.path for each in self._machine.lists) else []
        used += ["scans.h"] if any(is_of_scan(each) for each in self._machine.arrays) else []
        used += ["skills.h"] if self._asks_skills() else []
        used += ["transforms.h"] if any(each.edge for each in self._machine.channels) else []
        used += [part.header for part in self._parts()]
        return sorted(["hooks.h", *(f"{runtime.FOLDER}/{header}" for header in used)])

    def _asks_skills(self) -> bool:
        steps = (step for slot in self._machine.slots for step in slot.path)
        return any(isinstance(step, ir.Doing | ir.Quantity) for step in steps)


def _hook_definition(hook: str) -> str:
    return (
        f"void {hook}(Moment moment)\n{{\n"
        f"    say::information(moment == Moment::START ?"
        f' "hook {hook} starts" : "hook {hook} ends");\n}}\n'
    )
