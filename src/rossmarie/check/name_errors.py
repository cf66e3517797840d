"""ROSS1xx: names and declarations."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class UndeclaredName(Error, code="ROSS101", name="undeclared-name"):
    """A value that nothing declares."""

    title = "`{identifier}` is not declared"
    label = "no constant, input or condition in reach has this name"
    help = "declare it: `const {identifier} = ...` or `input {identifier} = topic ...`"
    identifier: str


class UndeclaredEntity(Error, code="ROSS102", name="undeclared-entity"):
    """Something before a dot that nothing declares."""

    title = "`{identifier}` is not declared"
    label = "neither an entity nor an input has this name"
    help = "declare it: `entity {identifier} {{ ... }}`"
    identifier: str


class UnknownCondition(Error, code="ROSS103", name="unknown-condition"):
    """A condition that its entity does not have."""

    title = "entity `{entity}` has no condition `{identifier}`"
    label = "not a condition of `{entity}`"
    identifier: str
    entity: str


class UndeclaredAction(Error, code="ROSS104", name="undeclared-action"):
    """A rule that names an action that does not exist."""

    title = "action `{identifier}` is not declared"
    label = "no action has this name"
    note = "a rule may only start actions that the file, or one that it imports, declares"
    help = "declare it: `action {identifier};`"
    identifier: str


class DuplicateName(Error, code="ROSS105", name="duplicate-name"):
    """Two declarations of one name."""

    title = "`{identifier}` is declared twice"
    label = "this {kind} takes a name that already stands for {other}"
    note = "{reason}"
    help = "give one of the two another name"
    identifier: str
    kind: str
    other: str
    reason: str


class WrongKindOfName(Error, code="ROSS106", name="wrong-kind-of-name"):
    """A name that stands for something else than what is needed here."""

    title = "`{identifier}` is {found}, not {expected}"
    label = "{expected} is needed here"
    identifier: str
    found: str
    expected: str


class UnknownFunction(Error, code="ROSS107", name="unknown-function"):
    """A call of something that is not built in."""

    title = "there is no function `{identifier}`"
    label = "not a built-in function"
    identifier: str


class UnknownField(Error, code="ROSS108", name="unknown-field"):
    """A field that a message, a vector or an orientation does not have."""

    title = "{owner} has no field `{identifier}`"
    label = "no such field"
    identifier: str
    owner: str


class UnknownMessageType(Error, code="ROSS109", name="unknown-message-type"):
    """A message type without a definition."""

    title = "there is no message type `{identifier}`"
    label = "no definition of this type is known"
    note = "known are the types of the common ROS packages and the .msg files of message folders"
    identifier: str


class TopicWithoutType(Error, code="ROSS110", name="topic-without-type"):
    """An input in the printed form whose topic no system model declares."""

    title = "the message type of topic `{topic}` is not known"
    label = "no system model declares this topic"
    note = (
        "without a type after the topic (`topic /imu/data : sensor_msgs/Imu`) the type comes "
        "from a system model"
    )
    topic: str


class TopicTypeConflict(Error, code="ROSS111", name="topic-type-conflict"):
    """One topic, two message types."""

    title = "topic `{topic}` cannot be both {found} and {expected}"
    label = "{found} here"
    note = "a topic carries messages of one type"
    help = "write `{expected}` here, or correct the other declaration"
    topic: str
    found: str
    expected: str


class UndeclaredTopic(Error, code="ROSS112", name="undeclared-topic"):
    """A topic that a node of the system model uses and nothing declares."""

    title = "topic `{topic}` is not declared"
    label = "no system model declares this topic"
    help = "declare it in the system model: `topic {topic} : PACKAGE/TYPE;`"
    topic: str


class CircularConstant(Error, code="ROSS113", name="circular-constant"):
    """A constant that is defined by itself."""

    title = "constant `{identifier}` is defined by itself"
    label = "{cycle}"
    note = "the value of a constant has to be known before it can be used"
    help = "write the value of one of them as a number"
    identifier: str
    cycle: str


class CircularCondition(Error, code="ROSS114", name="circular-condition"):
    """A condition that depends on itself."""

    title = "condition `{identifier}` depends on itself"
    label = "{cycle}"
    note = "the truth of a condition follows from inputs; a circle of conditions has no start"
    help = "write one of them without the others"
    identifier: str
    cycle: str


class SeveralContracts(Error, code="ROSS115", name="several-contracts"):
    """A rule with more than one resume contract."""

    title = "a rule has at most one resume contract"
    label = "this one contradicts the first"
    note = "it would not be clear which of them releases the actions"
    help = "keep one; two conditions for release can be joined: `clear when (A and B) for 2 sec`"


class MalformedMessageDefinition(Error, code="ROSS116", name="malformed-message-definition"):
    """A .msg file that cannot be understood."""

    title = "the definition of `{identifier}` cannot be read"
    label = "this type is needed here"
    note = "{problem}"
    help = "correct the .msg file"
    identifier: str
    problem: str


class MessageFolderMissing(Error, code="ROSS117", name="message-folder-missing"):
    """A `messages` declaration that leads nowhere."""

    title = "there is no folder `{path}`"
    label = "looked for `{looked_for}`"
    note = "the path is relative to the file that declares it"
    help = "name the folder that holds PACKAGE/msg/TYPE.msg"
    path: str
    looked_for: str


class UndeclaredHazard(Error, code="ROSS143", name="undeclared-hazard"):
    """A rule that mitigates a hazard that does not exist."""

    title = "there is no hazard `{identifier}`"
    label = "no hazard has this name"
    help = 'declare it: `hazard {identifier} "WHAT MAY HAPPEN";`'
    identifier: str


ALL: tuple[type[Template], ...] = (
    UndeclaredName,
    UndeclaredEntity,
    UnknownCondition,
    UndeclaredAction,
    DuplicateName,
    WrongKindOfName,
    UnknownFunction,
    UnknownField,
    UnknownMessageType,
    TopicWithoutType,
    TopicTypeConflict,
    UndeclaredTopic,
    CircularConstant,
    CircularCondition,
    SeveralContracts,
    MalformedMessageDefinition,
    MessageFolderMissing,
    UndeclaredHazard,
)
