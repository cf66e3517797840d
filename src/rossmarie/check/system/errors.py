"""Mistakes in system models and inputs."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class Here(Remark):
    """The label of the second of two statements."""

    says = "{what} here"
    what: str


class UnknownMessageType(Error, code="ROSS109", name="unknown-message-type"):
    """A message type without a definition."""

    title = "there is no message type `{identifier}`"
    label = "no definition of this type is known"
    note = "known are the types of the common ROS packages and the .msg files of message folders"
    identifier: str

    class Package(Remark):
        says = "`{package}` is the package itself: name the folder that contains the package"
        package: str

    class Folder(Remark):
        says = (
            "give the folder that contains the package `{package}` with `--messages FOLDER`, or in "
            'a system model: `messages "FOLDER";`'
        )
        package: str

    class Tried(Remark):
        says = "looked for {places}; put the file there, or name another folder"
        places: str


class TopicWithoutType(Error, code="ROSS110", name="topic-without-type"):
    """An input in the short form whose topic no system model declares."""

    title = "the message type of topic `{topic}` is not known"
    label = "no system model declares this topic"
    note = (
        "without a type after the topic (`topic /imu/data : sensor_msgs/Imu`) the type comes "
        "from a system model"
    )
    topic: str

    class DeclaredTopics(Remark):
        says = "declared topics: {known}"
        known: str

    class Declare(Remark):
        says = "declare it in the system model: `topic {topic} : PACKAGE/TYPE;`"
        topic: str

    class NoSystemModel(Remark):
        says = (
            "declare it in a file `system.ross` in the same folder: `system robot {{ topic "
            "{topic} : PACKAGE/TYPE; }}`, or write its type here: `topic {topic} : PACKAGE/TYPE`"
        )
        topic: str


class TopicTypeConflict(Error, code="ROSS111", name="topic-type-conflict"):
    """One topic with two message types."""

    title = "topic `{topic}` cannot be both {found} and {expected}"
    label = "{found} here"
    note = "a topic carries messages of one type"
    help = "write `{expected}` here, or correct the other declaration"
    topic: str
    found: str
    expected: str


class UndeclaredTopic(Error, code="ROSS112", name="undeclared-topic"):
    """A topic that a node of the system model uses but nothing declares."""

    title = "topic `{topic}` is not declared"
    label = "no system model declares this topic"
    help = "declare it in the system model: `topic {topic} : PACKAGE/TYPE;`"
    topic: str


class MalformedMessageDefinition(Error, code="ROSS116", name="malformed-message-definition"):
    """A .msg file that cannot be parsed."""

    title = "the definition of `{identifier}` cannot be read"
    label = "this type is needed here"
    note = "{problem}"
    help = "correct the .msg file"
    identifier: str
    problem: str


class MessageFolderMissing(Error, code="ROSS117", name="message-folder-missing"):
    """A `messages` declaration with a folder that does not exist."""

    title = "there is no folder `{path}`"
    label = "looked for `{looked_for}`"
    note = "the path is relative to the file that declares it"
    help = "name the folder that holds PACKAGE/msg/TYPE.msg"
    path: str
    looked_for: str


class MisplacedNames(Error, code="ROSS243", name="misplaced-names"):
    """Names for elements of a value that has none, or whose elements already have names."""

    title = "`{field}` cannot be given names of elements"
    label = "{reason}"
    field: str
    reason: str

    class ChooseField(Remark):
        says = "choose the array before `names`: {fields}"
        fields: str

    class LeaveOut(Remark):
        says = "leave the names out"

    class OfMessage(Remark):
        says = 'remove the list; `{input}["NAME"]` uses the names in each message'
        input: str


class RepeatedName(Error, code="ROSS244", name="repeated-name"):
    """A list of names with a repeated name."""

    title = "two elements have the name `{identifier}`"
    label = "the list already contains this name"
    help = "give each element a name of its own, in the order of the array"
    identifier: str


class UnitContradictsField(Error, code="ROSS308", name="unit-contradicts-field"):
    """A unit given to an input whose field has a unit of another dimension."""

    title = "{field} is in {known}, not in {found}"
    label = "this unit has another dimension"
    note = "the unit after `in` selects a unit of the dimension of the field"
    help = (
        "remove `in {found}`; if the field does carry {found}, declare this in the system model: "
        "`unit {field} = {found};`"
    )
    field: str
    known: str
    found: str

    class OfSkill(Remark):
        says = "remove `in {found}`: the skills file declares the property in {known}"
        found: str
        known: str


class FieldUnitConflict(Error, code="ROSS311", name="field-unit-conflict"):
    """One field of one topic with two units."""

    title = "{field} of topic `{topic}` cannot arrive both in {found} and in {expected}"
    label = "{found} here"
    note = "each message carries one number in this field; at least one of the two units is wrong"
    help = "find out which unit the topic carries, and write the same unit in both places"
    topic: str
    field: str
    found: str
    expected: str


class UnitDeclarationConflict(Error, code="ROSS313", name="unit-declaration-conflict"):
    """One field of one message that system models declare with two units."""

    title = "{field} cannot be both in {found} and in {expected}"
    label = "{found} here"
    note = "a field carries one number; one of the two units is wrong"
    help = "find out which unit the publishers send, and declare this unit once"
    field: str
    found: str
    expected: str


class RateConflict(Error, code="ROSS328", name="rate-conflict"):
    """One topic with two message rates."""

    title = "messages on `{topic}` cannot arrive both at {found} and at {expected}"
    label = "this rate differs"
    help = "declare one rate, or a range that contains both rates: `at [8, 12] Hz`"
    topic: str
    found: str
    expected: str


class BoundWithoutList(Error, code="ROSS238", name="bound-without-list"):
    """`up to` on an input without a list of messages."""

    title = "`up to` is only for lists of messages"
    label = "`{field}` has no list of messages"
    note = "numbers, strings and arrays need no bound"
    help = "leave `up to {bound}` out"
    field: str
    bound: str


class ListBound(Error, code="ROSS239", name="list-bound"):
    """A bound of lists that is not a possible number of elements."""

    title = "a bound must be a whole number from 1 to {most}"
    label = "this is {found}"
    help = "write the largest number of elements that a message has on this robot, as in `up to 64`"
    most: int
    found: str


class SharedDiagnostics(Warning, code="ROSS256", name="shared-diagnostics"):
    """An input on the topic on which every node reports its status, including the monitor."""

    title = "the node of these rules publishes on `{topic}` itself"
    label = "each message of this node replaces the last message"
    note = (
        "the node reports the state of the rules and their inputs every second, so this input "
        "never reaches its timeout, and reads messages about something else"
    )
    help = "publish the values for the rules on a topic of their own, as in `/drives/status`"
    topic: str


ALL: tuple[type[Template], ...] = (
    UnknownMessageType,
    TopicWithoutType,
    TopicTypeConflict,
    UndeclaredTopic,
    MalformedMessageDefinition,
    MessageFolderMissing,
    MisplacedNames,
    RepeatedName,
    UnitContradictsField,
    FieldUnitConflict,
    UnitDeclarationConflict,
    RateConflict,
    BoundWithoutList,
    ListBound,
    SharedDiagnostics,
)
