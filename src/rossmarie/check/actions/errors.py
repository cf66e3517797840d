"""Mistakes in actions and their effects."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class UnknownSentType(Error, code="ROSS118", name="unknown-sent-type"):
    """A service or action server whose type has no definition."""

    title = "there is no {kind} type `{identifier}`"
    label = "no definition of this type is known"
    help = 'name the folder of the definition in a system model: `messages "msg";`'
    kind: str
    identifier: str


class UntypedTarget(Error, code="ROSS119", name="untyped-target"):
    """A topic, service or action server whose type is not declared."""

    title = "the type of {kind} `{identifier}` is not known"
    label = "no declaration gives the type"
    kind: str
    identifier: str

    class DeclareOrSend(Remark):
        says = "declare it in a system model, `{declaration}`, or write `send {type} {{ ... }}`"
        declaration: str
        type: str

    class DeclareOrWrite(Remark):
        says = "declare it in a system model, `{declaration}`, or write `{name} : {type}`"
        declaration: str
        name: str
        type: str


class UnknownLevel(Error, code="ROSS121", name="unknown-level"):
    """A level of a log or a diagnosis that does not exist."""

    title = "`{identifier}` is not a level"
    label = "not a level"
    help = "write one of {known}"
    identifier: str
    known: str


class FieldGivenTwice(Error, code="ROSS124", name="field-given-twice"):
    """A field that one effect bounds or sets twice."""

    title = "field `{field}` is given twice"
    label = "given again here"
    help = "keep one of the two"
    field: str

    class First(Remark):
        says = "first given here"


class ReservedHook(Error, code="ROSS125", name="reserved-hook"):
    """A hook name that cannot be the name of a function."""

    title = "`{identifier}` cannot be the name of a C++ function"
    label = "a C++ keyword"
    help = "choose another name, such as `{identifier}_hook`"
    identifier: str


class UncommandedTopic(Error, code="ROSS133", name="uncommanded-topic"):
    """A test with an expectation about commands that nothing limits."""

    title = "no action commands {topic}"
    label = "every message on this topic passes unchanged"
    help = "limit, scale or block {topic} in an action, or name a topic of an action"
    topic: str

    class Commanded(Remark):
        says = "actions command {known}"
        known: str


class UnknownTarget(Error, code="ROSS140", name="unknown-target"):
    """A member of a resource that occurs nowhere else."""

    title = "nothing is sent to `{identifier}`"
    label = "no system model declares it, and no action names it"
    help = "name a topic, a service, an action server, a node or a controller manager"
    identifier: str


class SharedTarget(Error, code="ROSS141", name="shared-target"):
    """A topic or the like that belongs to two resources, or to one resource twice."""

    title = "`{target}` already belongs to resource `{resource}`"
    label = "named again"
    help = "name `{target}` once; use one resource for everything that commands the same thing"
    target: str
    resource: str

    class Other(Remark):
        says = "also named here"


class NothingToBound(Error, code="ROSS225", name="nothing-to-bound"):
    """A command without any floating-point number."""

    title = "`{type}` has no numbers that can be bounded"
    label = "this carries `{type}`"
    note = (
        "the safety filter bounds the floating-point numbers of a message, except in headers and "
        "in arrays of messages"
    )
    help = "name a topic with commands, such as a topic of type `geometry_msgs/Twist`"
    type: str


class FieldNotBounded(Error, code="ROSS226", name="field-not-bounded"):
    """A field that a limit cannot bound."""

    title = "`{field}` cannot be bounded"
    label = "{reason}"
    field: str
    reason: str

    class OneOf(Remark):
        says = "bound one of {fields}"
        fields: str

    class Inside(Remark):
        says = "bound {fields}"
        fields: str

    class NoIndex(Remark):
        says = "leave the `[...]` out"


class NotAnInterval(Error, code="ROSS227", name="not-an-interval"):
    """An expression behind the `in` of a limit that is not an interval."""

    title = "a limit needs an interval, and this is {found}"
    label = "expected a lower and an upper bound"
    help = "write an interval, such as `[-0.2, 0.2] m/s`"
    found: str


class ValueMismatch(Error, code="ROSS228", name="value-mismatch"):
    """A value whose type differs from the type of its field."""

    title = "`{field}` is {expected}, and this is {found}"
    label = "{found}"
    help = "write a value of the type of the field"
    field: str
    expected: str
    found: str


class FieldNotAssignable(Error, code="ROSS229", name="field-not-assignable"):
    """A field that an action cannot set."""

    title = "`{field}` cannot be set here"
    label = "{reason}"
    field: str
    reason: str

    class Fields(Remark):
        says = "name one of its fields: {fields}"
        fields: str

    class SomeField(Remark):
        says = "name one of its fields"

    class Scalars(Remark):
        says = "only numbers, booleans and strings can be set"

    class Part(Remark):
        says = "name one of its parts, such as `{field}.x`"
        field: str

    class NoIndex(Remark):
        says = "leave the `[...]` out"


class IntegerMismatch(Error, code="ROSS230", name="integer-mismatch"):
    """A number that a field of whole numbers cannot hold."""

    title = "`{field}` cannot hold this number"
    label = "{reason}"
    help = "write a whole number from {low} to {high}{unit}"
    field: str
    reason: str
    low: int
    high: int
    unit: str


class FieldUnitMismatch(Error, code="ROSS315", name="field-unit-mismatch"):
    """A number whose unit differs from the unit of its field."""

    title = "{found} does not fit `{field}`"
    label = "`{field}` is {expected}"
    field: str
    found: str
    expected: str

    class Unit(Remark):
        says = "write the value in {unit}"
        unit: str

    class Unknown(Remark):
        says = (
            "leave the unit out (the number is sent unchanged), or declare the unit of the field "
            "in a system model: `unit PACKAGE/TYPE.{field} = {unit};`"
        )
        field: str
        unit: str

    class Angle(Remark):
        says = "write the value in deg or rad"

    class NoUnit(Remark):
        says = "leave the unit out"


class RampMismatch(Error, code="ROSS316", name="ramp-mismatch"):
    """A ramp that fits no field that the effect bounds."""

    title = "this ramp fits none of the fields that are bounded here"
    label = "{found}"
    note = "a ramp sets how fast a bound is lifted: the change of the bound per second"
    found: str

    class Number(Remark):
        says = "write a number, such as `ramp 0.3 m/s^2`"

    class Unit(Remark):
        says = "write the ramp in {unit}"
        unit: str


class RepeatedRamp(Error, code="ROSS317", name="repeated-ramp"):
    """Two ramps for the same fields."""

    title = "there are two ramps for the same fields"
    label = "the second ramp"
    help = "keep one of the two"


class BoundWithoutZero(Error, code="ROSS410", name="bound-without-zero"):
    """A limit that excludes zero, so that the robot could not stand still."""

    title = "a limit must let the robot stand still"
    label = "zero is outside this interval"
    note = "the filter would raise a smaller command to the limit: the limit would move the robot"
    help = "choose an interval that contains 0"


class ZeroIsAPose(Error, code="ROSS411", name="zero-is-a-pose"):
    """A position command that a rule scales or holds at zero."""

    title = "for `{field}`, zero is a position, not standstill"
    label = "this would move the robot to zero"
    note = "`{field}` is in {unit}"
    help = "cancel the goal, or block a topic of velocities"
    field: str
    unit: str


class FactorOutOfRange(Error, code="ROSS412", name="factor-out-of-range"):
    """A factor of a command that is not between 0 and 1."""

    title = "a command can be scaled by 0 to 100 %"
    label = "this is {found}"
    help = "write a percentage, as in `by 50 %`"
    found: str


class PartlyRamped(Warning, code="ROSS413", name="partly-ramped"):
    """A bound that is lifted at once while others are lifted along a ramp."""

    title = "the bound of `{field}` is lifted without a ramp"
    label = "no ramp applies to this field"
    note = "the other bounds follow a ramp; this bound jumps"
    help = "add a ramp: `ramp ..., {example}`"
    field: str
    example: str


class DoesNothing(Warning, code="ROSS414", name="does-nothing"):
    """An action, effect or rule that is written down and has nothing in it."""

    title = "this {what} does nothing"
    label = "empty"
    what: str

    class Words(Remark):
        says = "write a text that describes the situation"

    class Switch(Remark):
        says = "name the controllers: `{{ stop NAME; start NAME; }}`"

    class Limit(Remark):
        says = "bound a field: `{{ FIELD in [LOW, HIGH] UNIT; }}`"

    class Action(Remark):
        says = "write the effects of the action, or write `action {name};`"
        name: str

    class Rule(Remark):
        says = "name the action that it starts: `then {{ ACTION; }}`"


class MissingTimeLimit(Error, code="ROSS415", name="missing-time-limit"):
    """A goal without a time limit."""

    title = "this goal needs a time limit"
    label = "nothing defines when this goal has failed"
    note = "the right time limit depends on the goal, so there is no default"
    help = "write `within 30 sec` after {place}"
    place: str


class UnguardedConfirmation(Warning, code="ROSS416", name="unguarded-confirmation"):
    """A confirmation that may fail without an escalation."""

    title = "nothing happens if this confirmation fails"
    label = "the goal is cancelled, but the robot may not have stopped"
    note = "the confirmation exists because the reply of the server is not enough"
    help = "name an action for this case: `else ACTION`"


class ControllerConflict(Error, code="ROSS419", name="controller-conflict"):
    """A controller that is started and stopped by the same effect."""

    title = "controller `{identifier}` is both started and stopped"
    label = "named again here"
    help = "keep one of the two"
    identifier: str

    class First(Remark):
        says = "first named here"


ALL: tuple[type[Template], ...] = (
    UnknownSentType,
    UntypedTarget,
    UnknownLevel,
    FieldGivenTwice,
    ReservedHook,
    UncommandedTopic,
    UnknownTarget,
    SharedTarget,
    NothingToBound,
    FieldNotBounded,
    NotAnInterval,
    ValueMismatch,
    FieldNotAssignable,
    IntegerMismatch,
    FieldUnitMismatch,
    RampMismatch,
    RepeatedRamp,
    BoundWithoutZero,
    ZeroIsAPose,
    FactorOutOfRange,
    PartlyRamped,
    DoesNothing,
    MissingTimeLimit,
    UnguardedConfirmation,
    ControllerConflict,
)
