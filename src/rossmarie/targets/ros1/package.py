"""A machine as a catkin package: `generate` gives its files by name.

Takes a machine that `ir.verify` has passed and for which `unsupported` found nothing.
"""

from __future__ import annotations

from pathlib import PurePath

from jinja2 import Environment, PackageLoader, StrictUndefined

from rossmarie import ir
from rossmarie.targets import c99
from rossmarie.targets.c99.layout import Layout, lay_out
from rossmarie.targets.ros1 import actions, messages, names, readme, tables

OWNED_BY_USER = frozenset(("src/hooks.cpp", "config/parameters.yaml"))
"""Files that are written once and then left alone."""

_FIXED = (
    "src/clock.h", "src/input.h", "src/any_filter.h", "src/worker.h", "src/task.h",
    "src/latched_rules.h", "src/host.h", "src/services.cpp", "src/telling.cpp",
    "msg/Value.msg", "msg/Verdict.msg", "msg/TaskState.msg", "msg/State.msg",
    "srv/Reset.srv", "srv/Why.srv", "srv/Exempt.srv",
)  # fmt: skip

# Only where commands pass.
_FILTERS = ("src/filter.h", "src/command_task.h")

# Only where goals are cancelled, and what that uses.
_CANCEL = ("src/cancel_task.h",)
_CANCEL_PACKAGES = {"actionlib_msgs", "topic_tools"}

# What the node itself uses.
_ALWAYS = ("diagnostic_msgs", "roscpp", "std_msgs")

_SHOWN_TEXT = """\
    if (text.kind == ValueText::TEXT)
        return value < 0.0 ? "another text" : {name}_texts[static_cast<int>(value)];
"""


def generate(machine: ir.Machine) -> dict[str, str]:
    """The files of the package, by their paths in it."""
    writer = _Writer(machine)
    core = {f"src/{name}": text for name, text in c99.generate(machine).items()}
    used = (
        *_FIXED,
        *(_FILTERS if machine.reactions.commands else ()),
        *(_CANCEL if actions.cancels(machine) else ()),
    )
    fixed = {path: writer.fill(f"{path}.j2") for path in used}
    return {**writer.package_files(), **fixed, **writer.source_files(), **core}


class _Writer:
    """Fills in the templates for one machine."""

    def __init__(self, machine: ir.Machine) -> None:
        self._machine = machine
        self._layout: Layout = lay_out(machine)
        self._templates = Environment(
            loader=PackageLoader("rossmarie.targets.ros1"),
            undefined=StrictUndefined,
            autoescape=False,
            keep_trailing_newline=True,
        )

    def fill(self, template: str, **blanks: object) -> str:
        known = {
            "name": self._layout.name,
            "upper": self._layout.name.upper(),
            "package": names.package(self._machine),
            "files": _files(self._machine),
            "files_in_xml": names.xml(_files(self._machine)),
        }
        return self._templates.get_template(template).render(**known, **blanks)

    def package_files(self) -> dict[str, str]:
        """What catkin, roslaunch and people read."""
        machine, package = self._machine, names.package(self._machine)
        used = sorted({*_ALWAYS, *_packages(machine)})
        commands = [command.topic for command in machine.reactions.commands]
        remaps = [f'    <remap from="{t}" to="{names.unfiltered(t)}"/>' for t in commands]
        depends = "\n".join(f"  <depend>{name}</depend>" for name in used)
        return {
            "package.xml": self.fill("package.xml.j2", depends=depends),
            "CMakeLists.txt": self.fill("CMakeLists.txt.j2", components="\n  ".join(used)),
            "README.md": self.fill("README.md.j2", **readme.blanks(machine)),
            f"launch/{package}.launch": self.fill("safety.launch.j2", remaps="\n".join(remaps)),
            "config/parameters.yaml": self.fill("parameters.yaml.j2"),
        }

    def source_files(self) -> dict[str, str]:
        """The node, as far as it differs from machine to machine."""
        machine = self._machine
        texts = _SHOWN_TEXT.format(name=self._layout.name) if machine.texts else ""
        hooks = names.hooks(machine).values()
        return {
            "src/node.h": self.fill(
                "src/node.h.j2",
                rule_rows=max(1, len(machine.rules)),
                channel_rows=max(1, len(machine.channels)),
            ),
            "src/node.cpp": self.fill("src/node.cpp.j2", subscriptions=self._subscriptions()),
            "src/messages.h": self.fill(
                "src/messages.h.j2",
                includes=messages.includes(machine),
                text_index=messages.text_index(self._layout),
                arrays=messages.arrays(self._layout),
                fills=messages.fills(self._layout),
                commands=messages.commands(machine),
            ),
            "src/actions.h": self.fill("src/actions.h.j2", **actions.blanks(machine)),
            "src/descriptions.h": self.fill("src/descriptions.h.j2", **tables.blanks(machine)),
            "src/reports.h": self.fill("src/reports.h.j2", shown_text=texts),
            "src/hooks.h": self.fill(
                "src/hooks.h.j2",
                declarations="".join(f"void {hook}(Moment moment);\n" for hook in hooks),
            ),
            "src/hooks.cpp": self.fill(
                "src/hooks.cpp.j2", definitions="\n".join(map(_hook_definition, hooks))
            ),
        }

    def _subscriptions(self) -> str:
        """The lines that subscribe to the input topics."""
        return "\n".join(
            self._subscription(channel) for channel in range(len(self._layout.channel_names))
        )

    def _subscription(self, channel: int) -> str:
        topic, name = self._machine.channels[channel], self._layout.channel_names[channel]
        kind = names.cpp_type(topic.message_type)
        return (
            f"    inputs_.push_back(std::make_unique<Input<{kind}>>(\n"
            f'        node_, clock_, "{topic.topic}", channel_timeouts_ns[{channel}], '
            f'by_stamp("{topic.topic}"),\n'
            f"        [this](const {kind} &message, int64_t at_ns) {{\n"
            f"            fill_{name}(values_, arrays_, message);\n"
            f"            take({channel}, at_ns);\n"
            f"        }}));"
        )


def _hook_definition(hook: str) -> str:
    return (
        f"void {hook}(Moment moment)\n{{\n"
        f'    ROS_INFO("hook {hook} %s", moment == Moment::START ? "starts" : "ends");\n}}\n'
    )


def _packages(machine: ir.Machine) -> set[str]:
    """The packages that the node uses for what it takes and sends."""
    used = [channel.message_type for channel in machine.channels]
    used += [command.message_type for command in machine.reactions.commands]
    used += actions.sent_types(machine)
    found = {names.message_package(each) for each in used}
    return found | _CANCEL_PACKAGES if actions.cancels(machine) else found


def _files(machine: ir.Machine) -> str:
    found = {PurePath(rule.span.file.path).name for rule in machine.rules}
    return ", ".join(sorted(found)) or machine.name
