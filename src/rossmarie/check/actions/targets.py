"""The targets of effects: topics, services and action servers, with their types."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from dslkit.diagnostics import Collector, DidYouMean, Edit, Fix, Remark, listed
from dslkit.source import Span
from rossmarie.check.actions.errors import UncommandedTopic, UnknownSentType, UntypedTarget
from rossmarie.check.scopes.context import Context
from rossmarie.check.system.errors import Here, MalformedMessageDefinition, TopicTypeConflict
from rossmarie.check.system.model import (
    SystemModel,
    find_message,
    full_name,
    report_conflict,
    type_name,
)
from rossmarie.check.wording.suggestions import near_name, rename, suggesting
from rossmarie.syntax import ast
from rossmarie.types import InterfaceKind, Message, MessageDefinitionError

_WORDS: Mapping[InterfaceKind, str] = {
    InterfaceKind.SERVICE: "service",
    InterfaceKind.ACTION: "action server",
}


@dataclass(frozen=True)
class SentMessage:
    """The target of a message: its full name, the name of its type, and the definition of the
    type.
    """

    name: str
    type: str
    message: Message


@dataclass
class TargetResolver:
    """Resolves targets. `stated` are the types that inputs, effects and system models state, with
    their places. `commanded` are the topics that effects limit, scale or block, with the names used
    there. If `is_parsed` is False, a file that could not be read may state more types.
    """

    model: SystemModel
    context: Context
    is_parsed: bool
    stated: dict[tuple[InterfaceKind, str], ast.Name] = field(default_factory=dict)
    commanded: dict[str, str] = field(default_factory=dict)

    @property
    def _collector(self) -> Collector:
        return self.context.collector

    def gather(self) -> None:
        """Collect the types that inputs, system models and effects state."""
        for found in self.context.inputs.values():
            written = found.declaration.message_type
            if written is not None:
                self.stated.setdefault((InterfaceKind.MESSAGE, found.topic), written)
        for member in self._members():
            if isinstance(member, ast.ServiceDeclaration):
                self._declare(InterfaceKind.SERVICE, member.name, member.service_type)
            elif isinstance(member, ast.ServerDeclaration):
                self._declare(InterfaceKind.ACTION, member.name, member.action_type)
        for item in self.context.declarations.items:
            if isinstance(item, ast.Action):
                for effect in item.effects:
                    self._gather_effect(effect)

    def _members(self) -> list[ast.SystemMember]:
        systems = self.context.declarations.systems
        return [member for system in systems for member in system.members]

    def _gather_effect(self, effect: ast.Effect) -> None:
        match effect:
            case ast.CallService(target=target):
                kind = InterfaceKind.SERVICE
            case ast.SendGoal(target=target):
                kind = InterfaceKind.ACTION
            case ast.Limit(target=target) | ast.Scale(target=target) | ast.Block(target=target):
                kind = InterfaceKind.MESSAGE
                full = self.full_name(kind, target.name)
                self.commanded.setdefault(full, target.name.text)
            case ast.Publish(target=target) | ast.Retrace(target=target):
                kind = InterfaceKind.MESSAGE
            case (
                ast.SetParameter() | ast.SwitchControllers() | ast.CancelGoal() | ast.Log()
                | ast.RunTree() | ast.Diagnose() | ast.Hook() | ast.Reset()
            ):  # fmt: skip
                return
        if target.type is not None:
            self._state(kind, target.name, target.type)

    def _declare(self, kind: InterfaceKind, name: ast.Name, written: ast.Name) -> None:
        self._find_sent(written, kind)
        self._state(kind, name, written)

    def _state(self, kind: InterfaceKind, name: ast.Name, written: ast.Name) -> None:
        full = self.full_name(kind, name)
        if kind is InterfaceKind.MESSAGE and full in self.model.topics:
            report_conflict(written, self.model.topics[full], self._collector)
            return
        first = self.stated.setdefault((kind, full), written)
        if _short(first) != _short(written):
            finding = TopicTypeConflict(topic=full, found=_short(written), expected=_short(first))
            place = Here(what=_short(first)).at(first.span)
            self._collector.add(finding.at(written.span, place))

    def full_name(self, kind: InterfaceKind, name: ast.Name) -> str:
        """`/cmd_vel` for `cmd_vel` and for an alias of it."""
        topic = self.model.find(name.text) if kind is InterfaceKind.MESSAGE else None
        return full_name(name.text) if topic is None else topic.name

    # --- types -------------------------------------------------------------------------------

    def topic(self, target: ast.Target, example: str = "geometry_msgs/Twist") -> SentMessage | None:
        """The topic; None after reporting that its type is unknown. `example` is a possible
        type.
        """
        name = self.full_name(InterfaceKind.MESSAGE, target.name)
        topic = self.model.topics.get(name)
        written = self.stated.get((InterfaceKind.MESSAGE, name))
        if topic is not None:
            written = topic.declaration.message_type
        if written is None:
            self._report_untyped(target.name, "topic", example)
            return None
        if _contradicts(target, written):
            return None
        # A mistake in a type is reported once, however many effects use the type.
        message = find_message(written, self.model, self._collector)
        return None if message is None else SentMessage(name, type_name(written.text), message)

    def is_commanded(self, name: ast.Name) -> bool:
        """Say whether an action commands the topic. Report an error if no action does."""
        if self.full_name(InterfaceKind.MESSAGE, name) in self.commanded:
            return True
        if self.model.is_whole and self.is_parsed:
            self._report_uncommanded(name)
        return False

    def _report_uncommanded(self, name: ast.Name) -> None:
        full = self.full_name(InterfaceKind.MESSAGE, name)
        finding = UncommandedTopic(topic=full)
        bare = (topic.lstrip("/") for topic in self.commanded)
        known = [*self.commanded, *self.commanded.values(), *bare]
        near = near_name(name.text, known) if self.context.may_suggest() else None
        if near is not None:
            self._collector.add(suggesting(finding, name, near))
            return
        commanded = finding.Commanded(known=listed(tuple(self.commanded)))
        self._collector.add(finding.at(name.span, notes=(commanded,) if self.commanded else ()))

    def sent(self, target: ast.Target, kind: InterfaceKind) -> SentMessage | None:
        """The service or action server; None after reporting that its type is unknown."""
        name = full_name(target.name.text)
        written = self.stated.get((kind, name))
        if written is None:
            self._report_untyped(target.name, _WORDS[kind], "PACKAGE/TYPE")
            return None
        message = None if _contradicts(target, written) else self._find_sent(written, kind)
        return None if message is None else SentMessage(name, _short(written), message)

    def _find_sent(self, written: ast.Name, kind: InterfaceKind) -> Message | None:
        try:
            found = self.model.messages.find_sent(written.text, kind)
        except MessageDefinitionError as error:
            finding = MalformedMessageDefinition(identifier=written.text, problem=str(error))
            self._collector.add(finding.at(written.span))
            return None
        if found is None and self.model.is_whole:
            known = self.model.messages.known_names(kind)
            near = near_name(_short(written), known) if self.context.may_suggest() else None
            word = "service" if kind is InterfaceKind.SERVICE else "action"
            unknown = UnknownSentType(kind=word, identifier=written.text)
            if near is None:
                self._collector.add(unknown.at(written.span))
            else:
                self._collector.add(suggesting(unknown, written, near))
        return found

    def _report_untyped(self, name: ast.Name, kind: str, example: str) -> None:
        if not (self.model.is_whole and self.is_parsed):
            return
        word = {"topic": "topic", "service": "service", "action server": "server"}[kind]
        declaration = f"{word} {full_name(name.text)} : {example};"
        near = self.model.near_topic(name.text) if kind == "topic" else None
        finding = UntypedTarget(kind=kind, identifier=name.text)
        help: Remark = finding.DeclareOrWrite(declaration=declaration, name=name.text, type=example)
        fix = None
        if kind == "action server":
            help = finding.DeclareOrSend(declaration=declaration, type=example)
        if near is not None:
            help, fix = DidYouMean(near=near), rename(name, near)
        self._collector.add(finding.at(name.span, help=help, fix=fix))


def insertion(behind: Span, text: str) -> Fix:
    """The fix that inserts a text after a place."""
    place = Span(behind.file, behind.end, behind.end)
    return Fix(f"insert `{text.strip()}`", (Edit(place, text),))


def _contradicts(target: ast.Target, known: ast.Name) -> bool:
    """Say whether a target states a type other than the known type. The contradiction is reported
    at the target.
    """
    return target.type is not None and _short(target.type) != _short(known)


def _short(name: ast.Name) -> str:
    return name.text.replace("/msg/", "/").replace("/srv/", "/").replace("/action/", "/")
