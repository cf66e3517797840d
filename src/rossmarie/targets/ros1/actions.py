"""What each task does, as C++: an object for each, made by `make_tasks`."""

from __future__ import annotations

from collections.abc import Sequence

from rossmarie import ir
from rossmarie.ir import reactions
from rossmarie.targets.c99.names import comment, place, string
from rossmarie.targets.c99.text import indented
from rossmarie.targets.c99.types import duration
from rossmarie.targets.ros1 import names
from rossmarie.targets.ros1.tables import rule_of_task
from rossmarie.targets.ros1.words import effect_words

_LOG_LEVELS = {
    reactions.Level.DEBUG: "Debug",
    reactions.Level.INFORMATION: "Info",
    reactions.Level.WARNING: "Warn",
    reactions.Level.ERROR: "Error",
}
_WIDTH = 92
_STATUS_LEVELS = {
    reactions.Level.INFORMATION: "OK",
    reactions.Level.WARNING: "WARN",
    reactions.Level.ERROR: "ERROR",
}


def blanks(machine: ir.Machine) -> dict[str, object]:
    """What the template leaves open."""
    sending = [i for i, t in enumerate(machine.reactions.tasks) if _sent_type(t.effect)]
    makers = names.message_makers(machine, sending)
    members = names.command_members(machine)
    classes = names.command_classes(machine)
    pairs = tuple(zip(classes, members, strict=True))
    filters = [f"std::unique_ptr<Filter<{word}>> {name};" for word, name in pairs]
    made = [
        f"{name} = std::make_unique<Filter<{word}>>(node, clock, reactor, settings);"
        for word, name in pairs
    ]
    unused = ["(void)node, (void)clock, (void)reactor, (void)settings;"]
    return {
        "includes": "\n".join([*map(names.header, sent_types(machine)), ""]),
        "filter_header": '#include "command_task.h"\n' if members else "",
        "cancel_header": '#include "cancel_task.h"\n' if cancels(machine) else "",
        "members": indented(filters) + "\n",
        "initializers": indented(made or unused, 2),
        "handing_over": indented((f"all.push_back(std::move({name}));" for name in members), 2),
        "messages": "\n".join(_maker(machine, task, name) for task, name in makers.items()),
        "tasks": indented(
            line for index in range(len(machine.reactions.tasks))
            for line in _task(machine, index, makers.get(index, ""))
        ),
    }  # fmt: skip


def cancels(machine: ir.Machine) -> bool:
    """Whether goals of action servers are cancelled."""
    effects = (task.effect for task in machine.reactions.tasks)
    return any(isinstance(effect, reactions.CancelGoal) for effect in effects)


def _sent_type(effect: reactions.Effect) -> str | None:
    """The type of what an effect sends, as in ROS."""
    match effect:
        case reactions.Publish(message_type=message_type):
            return message_type
        case reactions.Call(service_type=service_type):
            return service_type
        case _:
            return None


def sent_types(machine: ir.Machine) -> list[str]:
    """The types of all messages and services that tasks send, sorted."""
    found = (_sent_type(task.effect) for task in machine.reactions.tasks)
    return sorted({sent for sent in found if sent})


def _cpp_type(effect: reactions.Effect) -> str:
    sent = _sent_type(effect)
    assert sent, "only what sends something has a maker"
    return names.cpp_type(sent) + ("::Request" if isinstance(effect, reactions.Call) else "")


def _maker(machine: ir.Machine, task: int, name: str) -> str:
    """A function that makes the message of a task."""
    effect = machine.reactions.tasks[task].effect
    assert isinstance(effect, reactions.Publish | reactions.Call), "only these send something"
    lines = [_assignment(assignment) for assignment in effect.assignments]
    body = indented([f"{_cpp_type(effect)} message;", *lines, "return message;"])
    words = comment(f"{place(machine.reactions.tasks[task].span)}  {effect_words(machine, effect)}")
    return f"// {words}\ninline {_cpp_type(effect)} {name}()\n{{\n{body}\n}}\n"


def _assignment(assignment: reactions.Assignment) -> str:
    field = f"message{names.member(assignment.path)}"
    value = assignment.value
    if isinstance(value, bool):
        return f"{field} = {str(value).lower()};"
    if isinstance(value, str):
        return f"{field} = {string(value)};"
    if isinstance(value, tuple):
        return _list_assignment(field, value)
    return f"assign({field}, {value!r});"


def _list_assignment(field: str, values: Sequence[reactions.Scalar]) -> str:
    texts = [string(value) for value in values if isinstance(value, str)]
    if texts:
        return f"{field} = {{{', '.join(texts)}}};"
    numbers = [repr(value) for value in values if not isinstance(value, str)]
    return f"assign({field}, {{{', '.join(numbers)}}});"


def _task(machine: ir.Machine, index: int, maker: str) -> list[str]:
    """The lines that make the object of a task."""
    task = machine.reactions.tasks[index]
    rule = machine.rules[rule_of_task(machine)[index]].name
    action = machine.reactions.actions[task.action].name
    words = f"{place(task.span)}  rule {rule}, {action}: {effect_words(machine, task.effect)}"
    kind, arguments = _object(machine, index, maker)
    head = f"tasks.push_back(std::make_unique<{kind}>("
    line = f"{head}{', '.join(arguments)}));"
    lines = [line] if len(line) <= _WIDTH else _broken(head, arguments)
    return [f"// {index}: {comment(words)}", *lines]


def _broken(head: str, arguments: Sequence[str]) -> list[str]:
    """A call with an argument on each line."""
    *first, last = arguments
    return [head, *(f"    {argument}," for argument in first), f"    {last}));"]


def _object(machine: ir.Machine, index: int, maker: str) -> tuple[str, list[str]]:
    """The class of a task, and what it is made of."""
    effect = machine.reactions.tasks[index].effect
    match effect:
        case reactions.Publish(command=None):
            kind = f"PublishTask<{names.cpp_type(effect.message_type)}>"
            return kind, ["host.node()", string(effect.topic), _period(effect), f"{maker}()"]
        case reactions.Publish(command=int(command)):
            member = names.command_members(machine)[command]
            kind = f"CommandTask<{names.command_classes(machine)[command]}>"
            return kind, [f"*filters.{member}", _period(effect), f"{maker}()"]
        case reactions.Call(service=service, service_type=service_type):
            where = ["host.node()", "host.queue()", string(service)]
            arguments = [*where, f"{maker}()", _report(index)]
            return f"CallTask<{names.cpp_type(service_type)}>", arguments
        case reactions.CancelGoal(server=server):
            resend = str(effect.interrupted is reactions.Interrupted.RESEND).lower()
            return "CancelTask", ["host.node()", string(server), resend, _report(index)]
        case reactions.Limit() | reactions.Scale():
            return "BoundTask", []
        case _:
            return "DoTask", _doing(machine, index, effect)


def _report(index: int) -> str:
    """What is to be called when the end of a task is known."""
    return f"[&host](bool success) {{ host.report({index}, success); }}"


def _period(effect: reactions.Publish) -> str:
    return "0" if effect.period_ns is None else duration(effect.period_ns)


def _doing(machine: ir.Machine, index: int, effect: reactions.Effect) -> list[str]:
    """What is done at the start, and at the end if anything is."""
    match effect:
        case reactions.Log(level=level, text=text):
            logged = f"ros::console::levels::{_LOG_LEVELS[level]}, {string(text)}"
            return [f"[&host] {{ host.log({index}, {logged}); }}"]
        case reactions.Diagnose(level=level, text=text):
            said = f"diagnostic_msgs::DiagnosticStatus::{_STATUS_LEVELS[level]}, {string(text)}"
            return [
                f"[&host] {{ host.diagnose({index}, {said}); }}",
                f"[&host] {{ host.end_diagnosis({index}); }}",
            ]
        case reactions.Hook(name=name):
            function = f"hooks::{names.hooks(machine)[name]}"
            moments = ("START", "END")
            return [f"[] {{ {function}(hooks::Moment::{moment}); }}" for moment in moments]
        case reactions.Reset():
            return ["[&host] { host.reset_all(); }"]
        case _:
            raise AssertionError(f"refused by `unsupported`: {effect}")
