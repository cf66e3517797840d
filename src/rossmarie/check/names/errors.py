"""Mistakes in names and fields."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class Declared(Remark):
    """The known names."""

    says = "declared are {known}"
    known: str


class UndeclaredName(Error, code="ROSS101", name="undeclared-name"):
    """A value that nothing declares."""

    title = "`{identifier}` is not declared"
    label = "no constant, input or condition in scope has this name"
    help = "declare it: `const {identifier} = ...` or `input {identifier} = topic ...`"
    identifier: str

    class Unsure(Remark):
        says = (
            "did you mean `{near}`? If not, declare it: `const {identifier} = ...` or "
            "`input {identifier} = ...`"
        )
        near: str
        identifier: str


class UndeclaredEntity(Error, code="ROSS102", name="undeclared-entity"):
    """An undeclared name before a dot."""

    title = "`{identifier}` is not declared"
    label = "neither an entity nor an input has this name"
    help = "declare it: `entity {identifier} {{ ... }}`"
    identifier: str

    class OtherCase(Remark):
        says = "upper and lower case differ"


class UnknownCondition(Error, code="ROSS103", name="unknown-condition"):
    """A condition that its entity does not have."""

    title = "entity `{entity}` has no condition `{identifier}`"
    label = "not a condition of `{entity}`"
    identifier: str
    entity: str

    class Known(Remark):
        says = "its conditions are {known}"
        known: str

    class NoneThere(Remark):
        says = "this entity has no conditions"


class UndeclaredAction(Error, code="ROSS104", name="undeclared-action"):
    """A rule that names an action that is not declared."""

    title = "action `{identifier}` is not declared"
    label = "no action has this name"
    note = "a rule can only start actions that this file or an imported file declares"
    help = "declare it: `action {identifier};`"
    identifier: str


class WrongKindOfName(Error, code="ROSS106", name="wrong-kind-of-name"):
    """A name of another kind than is needed here."""

    title = "`{identifier}` is {found}, not {expected}"
    label = "expected {expected}"
    identifier: str
    found: str
    expected: str

    class OfEntity(Remark):
        says = "choose a condition of this entity: {conditions}"
        conditions: str

    class EmptyEntity(Remark):
        says = "this entity has no conditions"

    class NoAction(Remark):
        says = "name one of {actions}, or declare an action"
        actions: str

    class NoValue(Remark):
        says = "name actions only after `then`; write conditions with inputs"


class UnknownField(Error, code="ROSS108", name="unknown-field"):
    """A field that a message, a vector or an orientation does not have."""

    title = "{owner} has no field `{identifier}`"
    label = "no such field"
    identifier: str
    owner: str

    class Function(Remark):
        says = "it is a function: write `{owner}.{name}()`"
        owner: str
        name: str

    class Known(Remark):
        says = "it has {known}"
        known: str

    class InList(Remark):
        says = (
            "a list has no fields, but its elements have fields: `any(each in LIST: each.{name} "
            "...)`"
        )
        name: str

    class AlreadyData(Remark):
        says = "`{owner}` already stands for its data: leave `.data` out"
        owner: str

    class NoFields(Remark):
        says = "there are no fields here: remove the name after the dot"


class UnknownMessageConstant(Error, code="ROSS134", name="unknown-message-constant"):
    """A constant that a message does not define."""

    title = "message `{message}` has no constant `{identifier}`"
    label = "no such constant"
    identifier: str
    message: str

    class Known(Remark):
        says = "it has {known}"
        known: str


class AmbiguousMessage(Error, code="ROSS135", name="ambiguous-message"):
    """A constant of several messages with the same name."""

    title = "several messages are named `{identifier}`"
    label = "of {messages}"
    note = (
        "the message of an input takes precedence; here no input, or more than one input, has such "
        "a message"
    )
    help = "write the number, and give it a name: `const aborted = 4;`"
    identifier: str
    messages: str


class FieldNotUsable(Error, code="ROSS208", name="field-not-usable"):
    """A message field that rules cannot read."""

    title = "field `{identifier}` cannot be used in rules"
    label = "{reason}"
    help = "choose another field, or publish the value on a topic of its own"
    identifier: str
    reason: str


class UnusedName(Warning, code="ROSS401", name="unused-name"):
    """A declaration that no rule needs."""

    title = "{kind} `{identifier}` is never used"
    label = "declared here, used nowhere"
    note = "{reason}"
    help = "use it, or remove it"
    kind: str
    identifier: str
    reason: str


ALL: tuple[type[Template], ...] = (
    UndeclaredName,
    UndeclaredEntity,
    UnknownCondition,
    UndeclaredAction,
    WrongKindOfName,
    UnknownField,
    UnknownMessageConstant,
    AmbiguousMessage,
    FieldNotUsable,
    UnusedName,
)
