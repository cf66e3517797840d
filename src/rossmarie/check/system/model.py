"""System models: topics, their types, and the units of their fields.

The result is a `SystemModel` in which every topic has a full name and a message type, and the
catalog of messages with the declared units. All errors in a system model are reported here.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from dslkit.diagnostics import Collector, DidYouMean, Edit, Fix, Remark
from dslkit.source import is_folder
from rossmarie.check.names.fields import has_no_number, select, unit_of
from rossmarie.check.scopes.declarations import ProgramDeclarations
from rossmarie.check.scopes.errors import DuplicateName
from rossmarie.check.system.errors import (
    FieldUnitConflict,
    Here,
    MalformedMessageDefinition,
    MessageFolderMissing,
    TopicTypeConflict,
    UndeclaredTopic,
    UnitContradictsField,
    UnitDeclarationConflict,
    UnknownMessageType,
)
from rossmarie.check.units.errors import MisplacedUnit
from rossmarie.check.units.quantities import is_same_unit, read_unit
from rossmarie.check.wording.suggestions import Suggestions, near_name, rename
from rossmarie.syntax import ast
from rossmarie.types import (
    AXES,
    List,
    Message,
    MessageCatalog,
    MessageDefinitionError,
    Type,
    Unknown,
    Vector,
    message_value,
    std_msgs_data,
)
from rossmarie.units import Unit


@dataclass(frozen=True)
class DeclaredTopic:
    """A declared topic. `unit` is the unit of a std_msgs value, if the declaration gives one."""

    name: str
    message_type: str
    unit: Unit | None
    declaration: ast.TopicDeclaration


DeclaredUnit = tuple[Unit, ast.UnitDeclaration]
Field = tuple[str, tuple[str, ...]]


@dataclass(frozen=True)
class SystemModel:
    """The topics by full name, their full names by alias, and the messages. If `is_whole` is False,
    a file that could not be read may declare more topics and messages.
    """

    messages: MessageCatalog
    suggestions: Suggestions
    is_whole: bool
    topics: dict[str, DeclaredTopic] = field(default_factory=dict)
    aliases: dict[str, str] = field(default_factory=dict)

    def find(self, name: str) -> DeclaredTopic | None:
        """The topic for a name in a rules file: an alias, else the topic's own name."""
        return self.topics.get(self.aliases.get(name) or full_name(name))

    def near_topic(self, name: str) -> str | None:
        """A name similar to `name` for which `find` returns a topic."""
        if not self.suggestions.take(len(self.aliases) + 2 * len(self.topics)):
            return None
        bare = (topic.lstrip("/") for topic in self.topics)
        return near_name(name, [*self.aliases, *self.topics, *bare])

    def near_type(self, name: str) -> str | None:
        """A known type with the same name in another package, or else a type with similar spelling.
        If the package is unknown, only a small misspelling counts; otherwise its folder is missing.
        """
        known = self.messages.known_names()
        if not self.suggestions.take(len(known)):
            return None
        package, _, own = name.partition("/")
        same = [each for each in known if each.partition("/")[2].lower() == own.lower()]
        if any(each.startswith(f"{package}/") for each in known):
            return near_name(name, same) or next(iter(same), None) or near_name(name, known)
        packages = {each.partition("/")[0] for each in same}
        meant = near_name(package, packages)
        return next((each for each in same if each.startswith(f"{meant}/")), None)


def full_name(topic: str) -> str:
    """`/imu/data` for itself and for `imu/data`."""
    return topic if topic.startswith("/") else f"/{topic}"


def type_name(name: str) -> str:
    """`sensor_msgs/Imu`, also for `sensor_msgs/msg/Imu`."""
    return name.replace("/msg/", "/")


def read_system_model(
    declarations: ProgramDeclarations,
    message_folders: Sequence[Path],
    suggestions: Suggestions,
    collector: Collector,
) -> SystemModel:
    """Collect the members of all system models. `message_folders` are searched after the folders of
    the models.
    """
    members = [member for system in declarations.systems for member in system.members]
    folders = [*_folders(members, collector), *message_folders]
    declared = [
        (read_unit(member.unit, collector), member)
        for member in members
        if isinstance(member, ast.UnitDeclaration)
    ]
    # The first declaration of a field counts.
    units = {_field_of(member): unit for unit, member in reversed(declared) if unit is not None}
    model = SystemModel(MessageCatalog(folders, units), suggestions, declarations.is_whole)
    for member in members:
        if isinstance(member, ast.TopicDeclaration):
            _add_topic(member, model, collector)
    first: dict[Field, DeclaredUnit] = {}
    for unit, declaration in declared:
        _check_unit_declaration(unit, declaration, first, model, collector)
    for member in members:
        if isinstance(member, ast.NodeDeclaration):
            _check_node(member, model, collector)
    return model


def find_message(name: ast.Name, model: SystemModel, collector: Collector) -> Message | None:
    """The definition of a message type; None if there is none. A missing definition is reported,
    unless a file that could not be read may contain it.
    """
    if not name.text:
        return None
    try:
        found = model.messages.find(type_name(name.text))
    except MessageDefinitionError as error:
        finding = MalformedMessageDefinition(identifier=name.text, problem=str(error))
        collector.add(finding.at(name.span))
        return None
    if found is None and model.is_whole:
        _report_unknown_type(name, model, collector)
    return found


def _report_unknown_type(name: ast.Name, model: SystemModel, collector: Collector) -> None:
    finding = UnknownMessageType(identifier=name.text)
    package = model.messages.package_of(name.text)
    near = model.near_type(type_name(name.text)) if package is None else None
    help: Remark
    if package is not None:
        help = finding.Package(package=str(package))
    elif near is not None:
        help = DidYouMean(near=near)
    elif tried := model.messages.places_of(name.text):
        help = finding.Tried(places=", ".join(f"`{place}`" for place in tried))
    else:
        help = finding.Folder(package=name.text.partition("/")[0])
    fix = rename(name, near) if near is not None else None
    collector.add(finding.at(name.span, help=help, fix=fix))


def _folders(members: Sequence[ast.SystemMember], collector: Collector) -> Iterator[Path]:
    for member in members:
        if isinstance(member, ast.MessagesDeclaration):
            folder = Path(member.span.file.path).parent / member.path.value
            if is_folder(folder):
                yield folder
            else:
                finding = MessageFolderMissing(path=member.path.value, looked_for=str(folder))
                collector.add(finding.at(member.path.span))


def _field_of(declaration: ast.UnitDeclaration) -> Field:
    path = tuple(name.text for name in declaration.path)
    return type_name(declaration.message_type.text), path


def _check_unit_declaration(
    unit: Unit | None,
    declaration: ast.UnitDeclaration,
    first: dict[Field, DeclaredUnit],
    model: SystemModel,
    collector: Collector,
) -> None:
    """Check that the field exists, and that no earlier declaration in `first` gives it another
    unit.
    """
    message = find_message(declaration.message_type, model, collector)
    if message is None:
        return
    name, path = _field_of(declaration)
    type_: Type = message_value(message)
    text, before = declaration.message_type.text, declaration.message_type.span
    for step in declaration.path:
        if isinstance(type_, Vector) and step.text in AXES:
            path = path[:-1]  # a vector has one unit, for all its components
        type_ = _point_in(select(type_, step, text, before, collector))
        text, before = f"{text}.{step.text}", step.span
    if isinstance(type_, Unknown):
        return
    if has_no_number(type_):
        _report_misplaced(declaration.unit, text, MisplacedUnit.NameNumber(), collector)
    elif unit is not None:
        _check_declared_once(unit, declaration, (name, path), first, collector)


def _point_in(type_: Type) -> Type:
    """The message of the points of a cloud. It has no type that a user could name, so units are
    declared through the list of points.
    """
    return type_.element if isinstance(type_, List) and type_.is_of_points else type_


def _check_declared_once(
    unit: Unit,
    declaration: ast.UnitDeclaration,
    field: Field,
    first: dict[Field, DeclaredUnit],
    collector: Collector,
) -> None:
    name, path = field
    expected, earlier = first.setdefault(field, (unit, declaration))
    if not is_same_unit(unit, expected):
        finding = UnitDeclarationConflict(
            field=".".join((name, *path)), found=unit.symbol, expected=expected.symbol
        )
        place = Here(what=expected.symbol).at(earlier.unit.span)
        collector.add(finding.at(declaration.unit.span, place))


def _report_misplaced(unit: ast.Unit, text: str, help: Remark, collector: Collector) -> None:
    finding = MisplacedUnit(reason=f"`{text}` is not a number")
    collector.add(finding.at(unit.span, help=help))


def _add_topic(declaration: ast.TopicDeclaration, model: SystemModel, collector: Collector) -> None:
    name = full_name(declaration.topic.text)
    message = find_message(declaration.message_type, model, collector)
    unit = _topic_unit(declaration, message, collector)
    topic = DeclaredTopic(name, type_name(declaration.message_type.text), unit, declaration)
    first = model.topics.setdefault(name, topic)
    if first.message_type != topic.message_type:
        report_conflict(declaration.message_type, first, collector)
    elif first.unit is None and unit is not None:
        model.topics[name] = topic
    elif first.unit is not None and unit is not None and not is_same_unit(unit, first.unit):
        _report_other_unit(declaration, unit, first, collector)
    alias = declaration.alias
    if alias is None:
        return
    other = model.topics[model.aliases.setdefault(alias.text, name)]
    if other.name != name:
        finding = DuplicateName(
            identifier=alias.text,
            kind="alias",
            other=f"topic {other.name}",
            reason="an alias stands for one topic",
        )
        place = finding.First().at(other.declaration.span)
        collector.add(finding.at(alias.span, place))


def _report_other_unit(
    declaration: ast.TopicDeclaration, unit: Unit, first: DeclaredTopic, collector: Collector
) -> None:
    """Report that an earlier declaration gives the values of a topic another unit."""
    written, earlier = declaration.unit, first.declaration.unit
    if written is None or earlier is None or first.unit is None:
        return
    finding = FieldUnitConflict(
        topic=first.name,
        field=f"{first.message_type}.data",
        found=unit.symbol,
        expected=first.unit.symbol,
    )
    place = Here(what=first.unit.symbol).at(earlier.span)
    collector.add(finding.at(written.span, place))


def report_conflict(written: ast.Name, topic: DeclaredTopic, collector: Collector) -> None:
    """Report an error if `written` is not the message type that a system model gives `topic`,
    unless one of the two could not be read.
    """
    found = type_name(written.text)
    if not written.text or not topic.message_type or found == topic.message_type:
        return
    finding = TopicTypeConflict(topic=topic.name, found=found, expected=topic.message_type)
    place = Here(what=topic.message_type).at(topic.declaration.message_type.span)
    fix = Fix(f"write `{topic.message_type}`", (Edit(written.span, topic.message_type),))
    collector.add(finding.at(written.span, place, fix=fix))


def _topic_unit(
    declaration: ast.TopicDeclaration, message: Message | None, collector: Collector
) -> Unit | None:
    """The unit of a topic. Only std_msgs values, which have no field to name, accept a unit."""
    if declaration.unit is None:
        return None
    unit = read_unit(declaration.unit, collector)
    if message is None or unit is None:
        return unit
    data = std_msgs_data(message)
    if data is None or has_no_number(data):
        written = declaration.unit.text
        help: Remark = MisplacedUnit.LeaveOut(unit=written)
        if data is None:
            help = MisplacedUnit.NameField(message=message.name, unit=written)
        _report_misplaced(declaration.unit, message.name, help, collector)
        return None
    contradiction = contradicts(unit_of(data), unit, f"{message.name}.data")
    if contradiction is not None:
        collector.add(contradiction.at(declaration.unit.span))
        return None
    return unit


def contradicts(known: Unit | None, stated: Unit, field_name: str) -> UnitContradictsField | None:
    """The finding that a stated unit and the unit of the field have different dimensions; None if
    the dimensions are equal.
    """
    if known is None or known.dimension == stated.dimension:
        return None
    return UnitContradictsField(field=field_name, known=known.symbol, found=stated.symbol)


def _check_node(node: ast.NodeDeclaration, model: SystemModel, collector: Collector) -> None:
    for name in (*node.publishes, *node.subscribes):
        if model.find(name.text) is None and model.is_whole:
            near = model.near_topic(name.text)
            help = DidYouMean(near=near) if near is not None else None
            fix = rename(name, near) if near is not None else None
            finding = UndeclaredTopic(topic=full_name(name.text))
            collector.add(finding.at(name.span, help=help, fix=fix))
