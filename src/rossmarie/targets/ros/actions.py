"""The actions of each task as C++: an object for each task, made by `make_tasks`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from rossmarie import ir
from rossmarie.ir import reactions
from rossmarie.naming import effect_words, relayed_servers
from rossmarie.targets import comments
from rossmarie.targets.c99.names import place, string
from rossmarie.targets.c99.text import block, indented
from rossmarie.targets.c99.types import duration
from rossmarie.targets.ros import names, needs
from rossmarie.targets.ros.dialect import Dialect, RosInterface
from rossmarie.targets.ros.tables import rule_of_task

_SAY = {
    reactions.Level.DEBUG: "debug",
    reactions.Level.INFORMATION: "information",
    reactions.Level.WARNING: "warning",
    reactions.Level.ERROR: "error",
}
_WIDTH = 92
_STATUS_LEVELS = {
    reactions.Level.INFORMATION: "OK",
    reactions.Level.WARNING: "WARN",
    reactions.Level.ERROR: "ERROR",
}

Sending = reactions.Publish | reactions.Retrace | reactions.Call | reactions.SendGoal
Doing = reactions.Log | reactions.Diagnose | reactions.Hook | reactions.Reset
Sent = tuple[str, RosInterface]
"""The type of a sent message, request or goal, as in ROS."""


def _sent(effect: Sending) -> Sent:
    match effect:
        case (
            reactions.Publish(message_type=message_type)
            | reactions.Retrace(message_type=message_type)
        ):
            return message_type, RosInterface.MESSAGE
        case reactions.Call(service_type=service_type):
            return service_type, RosInterface.SERVICE
        case reactions.SendGoal(action_type=action_type):
            return action_type, RosInterface.ACTION


def sent_types(machine: ir.Machine, dialect: Dialect) -> list[Sent]:
    """The types of everything that tasks send, and of the goals that relays send again, sorted."""
    effects = (task.effect for task in machine.reactions.tasks)
    found = {_sent(effect) for effect in effects if isinstance(effect, Sending)}
    if dialect.relay:
        found |= {(kind, RosInterface.ACTION) for kind in relayed_servers(machine).values()}
    return sorted(found, key=lambda each: (each[0], each[1].value))


@dataclass(frozen=True)
class TasksText:
    """The text of the tasks for one machine in one dialect."""

    machine: ir.Machine
    dialect: Dialect

    def blanks(self) -> dict[str, object]:
        """The blanks that the template leaves open."""
        machine = self.machine
        tasks = range(len(machine.reactions.tasks))
        return {
            "messages": "".join(self._maker(task) for task in self._makers()),
            "filters": block(self._filters()),
            "shared": block(line for each in self._shared_objects() for line in each),
            "tasks": block(line for index in tasks for line in self._task(index)),
        }

    def _filters(self) -> Iterator[str]:
        pairs = (names.command_members(self.machine), names.command_classes(self.machine))
        for member, word in zip(*pairs, strict=True):
            yield (f"[[maybe_unused]] auto &{member} = add_filter<{word}>(made, host, filtering);")

    def _shared_objects(self) -> Iterator[list[str]]:
        for shared in needs.shared_objects(self.machine, self.dialect):
            head = f"const auto {shared.name} = std::make_shared<{shared.kind}>("
            yield _call(head, shared.arguments, ");")

    def _makers(self) -> dict[int, str]:
        """The name of the function that makes the message of each sending task."""
        tasks = enumerate(self.machine.reactions.tasks)
        sending = [index for index, task in tasks if isinstance(task.effect, Sending)]
        return names.message_makers(self.machine, sending)

    def _message_type(self, effect: Sending) -> str:
        """The C++ type of a sent message."""
        kind = self.dialect.cpp_type(*_sent(effect))
        match effect:
            case reactions.Publish() | reactions.Retrace():
                return kind
            case reactions.Call():
                return f"{kind}::Request"
            case reactions.SendGoal():
                return f"SendTask<{kind}>::Goal"

    def _maker(self, index: int) -> str:
        """A function that makes the message of a task."""
        task = self.machine.reactions.tasks[index]
        assert isinstance(task.effect, Sending), "only these send something"
        kind = self._message_type(task.effect)
        lines = map(_assignment, task.effect.assignments)
        body = indented([f"{kind} message;", *lines, "return message;"])
        words = comments.in_c(f"{place(task.span)}  {effect_words(self.machine, task.effect)}")
        made = f"// {words}\n{kind} {self._makers()[index]}()\n{{\n{body}\n}}\n\n"
        if not isinstance(task.effect, reactions.Retrace):
            return made
        numbers = enumerate(task.effect.numbers)
        puts = [f"assign(message{names.member(path)}, pose[{number}]);" for number, path in numbers]
        head = f"void {self._putter(index)}({kind} &message, const double *pose)"
        return f"{made}{head}\n{{\n{indented(puts)}\n}}\n\n"

    def _putter(self, index: int) -> str:
        """The function that puts a pose into the message of a task."""
        return self._makers()[index].replace("make_", "put_", 1)

    def _task(self, index: int) -> list[str]:
        """The lines that create the object of a task."""
        machine = self.machine
        task = machine.reactions.tasks[index]
        rule = machine.rules[rule_of_task(machine)[index]].name
        action = machine.reactions.actions[task.action].name
        words = f"{place(task.span)}  rule {rule}, {action}: {effect_words(machine, task.effect)}"
        kind, arguments = self._object(index)
        lines = _call(f"tasks.push_back(std::make_unique<{kind}>(", arguments, "));")
        return [f"// {index}: {comments.in_c(words)}", *lines]

    def _object(self, index: int) -> tuple[str, list[str]]:
        """The class of a task's object, and the arguments of its constructor."""
        effect = self.machine.reactions.tasks[index].effect
        match effect:
            case (
                reactions.Publish() | reactions.Retrace() | reactions.Call() | reactions.SendGoal()
            ):
                return self._sender(index, effect)
            case reactions.CancelGoal():
                return "CancelTask", [self._shared(index), _is_resent(effect), _report(index)]
            case reactions.SetParameter(value=value):
                return "SetTask", [self._shared(index), _parameter_value(value), _report(index)]
            case reactions.SwitchControllers():
                manager = [needs.MIDDLEWARE, needs.resolved(effect.manager)]
                change = f"Controllers::Change{{{_texts(effect.start)}, {_texts(effect.stop)}}}"
                return "SwitchTask", [*manager, self._shared(index), change, _report(index)]
            case reactions.Limit() | reactions.Scale():
                return "BoundTask", []
            case (
                reactions.Log() | reactions.Diagnose() | reactions.Hook() | reactions.Reset()
            ):  # fmt: skip
                return "DoTask", self._doing(index, effect)

    def _shared(self, index: int) -> str:
        """The object that a task shares with others."""
        return names.shared(self.machine)[index]

    def _sender(self, index: int, effect: Sending) -> tuple[str, list[str]]:
        message = f"{self._makers()[index]}()"
        kind = self.dialect.cpp_type(*_sent(effect))
        match effect:
            case reactions.Publish(command=None):
                where = [needs.MIDDLEWARE, names.relative(effect.topic)]
                return f"PublishTask<{kind}>", [*where, _period(effect), message]
            case reactions.Publish(command=int(command)):
                member = names.command_members(self.machine)[command]
                word = names.command_classes(self.machine)[command]
                return f"CommandTask<{word}>", [member, _period(effect), message]
            case reactions.Retrace(topic=topic):
                where = [needs.MIDDLEWARE, names.relative(topic)]
                return f"RetraceTask<{kind}>", [*where, message, self._putter(index)]
            case reactions.Call(service=service):
                arguments = [needs.MIDDLEWARE, names.relative(service), message, _report(index)]
                return f"CallTask<{kind}>", arguments
            case reactions.SendGoal():
                arguments = [self._shared(index), message, _is_resent(effect), _report(index)]
                return f"SendTask<{kind}>", arguments
            case reactions.Publish():
                raise AssertionError(effect)

    def _doing(self, index: int, effect: Doing) -> list[str]:
        """The statements at the start of a task, and at its end if there are any."""
        match effect:
            case reactions.Log(level=level, text=text):
                rule = self.machine.rules[rule_of_task(self.machine)[index]].name
                return [f"[] {{ say::{_SAY[level]}({string(f'rule {rule}: {text}')}); }}"]
            case reactions.Diagnose(level=level, text=text):
                said = f"DiagnosticStatus::{_STATUS_LEVELS[level]}, {string(text)}"
                return [
                    f"[&host] {{ host.diagnose({index}, {said}); }}",
                    f"[&host] {{ host.end_diagnosis({index}); }}",
                ]
            case reactions.Hook(name=name):
                function = f"hooks::{names.hooks(self.machine)[name]}"
                moments = ("START", "END")
                return [f"[] {{ {function}(hooks::Moment::{moment}); }}" for moment in moments]
            case reactions.Reset():
                return ["[&host] { host.reset_all(); }"]


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
    if not values:
        return f"{field} = {{}};"  # a list of texts, or of numbers, whose type is not certain
    if texts:
        return f"{field} = {{{', '.join(texts)}}};"
    numbers = [repr(value) for value in values if not isinstance(value, str)]
    return f"assign({field}, {{{', '.join(numbers)}}});"


def _call(head: str, arguments: Sequence[str], tail: str) -> list[str]:
    """A call on one line or, if that is too long, with one argument per line."""
    line = f"{head}{', '.join(arguments)}{tail}"
    if len(line) <= _WIDTH:
        return [line]
    *first, last = arguments
    return [head, *(f"    {argument}," for argument in first), f"    {last}{tail}"]


def _is_resent(effect: reactions.SendGoal | reactions.CancelGoal) -> str:
    """The C++ literal that states whether the interrupted goal is sent again."""
    return str(effect.interrupted is reactions.Interrupted.RESEND).lower()


def _parameter_value(value: reactions.Scalar) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return f"std::string({string(value)})" if isinstance(value, str) else repr(value)


def _texts(values: Sequence[str]) -> str:
    return f"{{{', '.join(map(string, values))}}}"


def _report(index: int) -> str:
    """The function to call when the end of a task is known."""
    return f"[&host](bool success) {{ host.report({index}, success); }}"


def _period(effect: reactions.Publish) -> str:
    return "0" if effect.period_ns is None else duration(effect.period_ns)
