"""Mistakes in operations: types, constants, times."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class NotACondition(Error, code="ROSS201", name="not-a-condition"):
    """A value that is not a condition where a condition is needed."""

    title = "a condition is needed here"
    label = "this is {found}, which is neither true nor false"
    help = "compare it with something, `{text} > ...`"
    found: str
    text: str

    class String(Remark):
        says = 'compare it with a string, `{text} == "..."`'
        text: str

    class Fields(Remark):
        says = "choose a field: {fields}"
        fields: str

    class InList(Remark):
        says = "look at its elements, `any(each in {text}: each. ...)`"
        text: str

    class Angle(Remark):
        says = "compare an angle of it, `{text}.pitch() > ...`"
        text: str

    class Length(Remark):
        says = "compare its length, `norm({text}) > ...`"
        text: str

    class Elements(Remark):
        says = "compare its elements, `any({text} > ...)`"
        text: str


class VectorAsScalar(Error, code="ROSS202", name="vector-as-scalar"):
    """A vector where one number is needed."""

    title = "a vector is not one number"
    label = "this is {found}"
    note = "it is not clear which of the three numbers is meant"
    help = "choose a component, `{text}.x`, `{text}.y` or `{text}.z`, or the length, `norm({text})`"
    found: str
    text: str


class Incomparable(Error, code="ROSS204", name="incomparable"):
    """A comparison of values of different kinds."""

    title = "{left} cannot be compared with {right}"
    label = "`{operator}` needs two numbers, or `==` and `!=` two strings"
    left: str
    right: str
    operator: str

    class Strings(Remark):
        says = "strings have no order; compare them with `==` or `!=`"

    class Boolean(Remark):
        says = "use the condition by itself, or `not` and the condition"

    class Constant(Remark):
        says = "`{constant}` is declared as {what}; declare the value that you want to compare"
        constant: str
        what: str

    class Quoted(Remark):
        says = "leave the quotes out: `{number}`"
        number: str

    class Unquoted(Remark):
        says = 'put it in quotes: `"{number}"`'
        number: str

    class OfOneKind(Remark):
        says = "a string never equals a number: compare with something of the same kind"


class NotANumber(Error, code="ROSS205", name="not-a-number"):
    """A value that is not a number where one number is needed."""

    title = "a number is needed here"
    label = "this is {found}"
    found: str

    class Boolean(Remark):
        says = "a condition is used by itself, or counted over an array: `count(...)`"

    class String(Remark):
        says = "strings can only be compared with strings, `==` and `!=`"

    class Range(Remark):
        says = "a range can only stand after `in`"

    class InList(Remark):
        says = "look at its elements, `any(each in {text}: each. ...)`"
        text: str

    class Fields(Remark):
        says = "choose a field: {fields}"
        fields: str


class ArrayAsScalar(Error, code="ROSS206", name="array-as-scalar"):
    """An array where one number or boolean is needed."""

    title = "an array is not one {expected}"
    label = "this has one {expected} for each element"
    expected: str

    class NotWatched(Remark):
        says = "single elements cannot be watched over time: put `for` after the whole condition"

    class WatchedOutside(Remark):
        says = (
            "single elements cannot be watched over time: move this part out of `{function}(...)`"
        )
        function: str

    class WatchedTogether(Remark):
        says = "single elements cannot be watched over time: write `{meant}`"
        meant: str

    class Number(Remark):
        says = "choose one: `min({text})`, `max({text})`, or an element, `{text}[0]`"
        text: str

    class Condition(Remark):
        says = "write `any({text})` or `all({text})`"
        text: str


class MessageAsValue(Error, code="ROSS207", name="message-as-value"):
    """A whole message where one value is needed."""

    title = "a whole message is not a value"
    label = "this is a {found}"
    found: str

    class Fields(Remark):
        says = "choose a field: {fields}"
        fields: str

    class NoFields(Remark):
        says = "this message has no fields; choose another message"


class OrientationAsScalar(Error, code="ROSS214", name="orientation-as-scalar"):
    """An orientation where one number is needed."""

    title = "an orientation is not one number"
    label = "this is a quaternion"
    help = "choose an angle: `{text}.roll()`, `{text}.pitch()` or `{text}.yaw()`"
    text: str


class NotConstant(Error, code="ROSS215", name="not-constant"):
    """A changing value where a constant is needed."""

    title = "{purpose} must be constant"
    label = "this is not constant"
    note = "the value must be known before the monitor runs"
    help = "use numbers, strings, `true`, `false`, other constants and operators on them"
    purpose: str


class DivisionByZero(Error, code="ROSS217", name="division-by-zero"):
    """A division by a constant that is zero."""

    title = "division by zero"
    label = "this is always zero"
    note = "the result would always be unknown, so no rule that uses the result could be decided"
    help = "divide by something else"


class ConstantTooLarge(Error, code="ROSS218", name="constant-too-large"):
    """A constant beyond the range of a double."""

    title = "this constant is too large"
    label = "beyond what a 64-bit floating-point number can hold"
    help = "write a number below 1e308, counted in SI units"


class NotAnArray(Error, code="ROSS221", name="not-an-array"):
    """An index, or a query about elements, on a value without elements."""

    title = "{purpose} needs an array"
    label = "this is {found}"
    purpose: str
    found: str

    class NoIndex(Remark):
        says = "leave the index out"

    class Components(Remark):
        says = "its components have names: `{text}.x`, `{text}.y`, `{text}.z`"
        text: str

    class AllElements(Remark):
        says = (
            "rules look at all messages of a list together: `{function}(each in {text}: each. ...)`"
        )
        function: str
        text: str

    class ByName(Remark):
        says = 'choose by name, and then a field: `{text}["NAME"].FIELD`'
        text: str


class ElementsWithoutNames(Error, code="ROSS231", name="elements-without-names"):
    """An element chosen by name, in a message without a list of names."""

    title = "the elements of `{text}` have no names"
    label = "the message has no list of names for these elements"
    text: str

    class Place(Remark):
        says = "choose the element by its place: `{text}[0]`"
        text: str

    class Fields(Remark):
        says = "choose a field of the message, by `.` and its name"


class UnlistedName(Error, code="ROSS242", name="unlisted-name"):
    """An element chosen by a name that its input does not declare."""

    title = "no element has the name `{identifier}`"
    label = "not in the list of names of this input"
    identifier: str

    class Known(Remark):
        says = "the names are {known}"
        known: str


class BooleanCompared(Error, code="ROSS222", name="boolean-compared"):
    """A condition that is compared like a number."""

    title = "conditions are not compared by `{operator}`"
    label = "this is already true or false"
    help = "write the condition itself, or `not` and the condition; join two by `and` and `or`"
    operator: str


class StringsCompared(Error, code="ROSS223", name="strings-compared"):
    """A comparison of two texts that both come from messages."""

    title = "a string can only be compared with a string literal"
    label = "neither side is known before the monitor runs"
    note = (
        "a monitor distinguishes only the strings that the rules mention: all other strings are "
        "equal to the monitor"
    )
    help = 'compare each with the strings that matter: `{left} == "..." and {right} == "..."`'
    left: str
    right: str


class NotADuration(Error, code="ROSS306", name="not-a-duration"):
    """A value that is not a duration where a duration is needed."""

    title = "{purpose} must be a duration"
    label = "this is {found}"
    help = "write a time, such as `0.5 sec`"
    purpose: str
    found: str


class DurationOutOfRange(Error, code="ROSS307", name="duration-out-of-range"):
    """A duration that is zero, negative, or too long."""

    title = "{purpose} must be {bound}"
    label = "this is {found}"
    note = "{reason}"
    help = "write a time, such as `0.5 sec`"
    purpose: str
    bound: str
    found: str
    reason: str

    class EveryTurn(Remark):
        says = "leave `by` out to count every turn"


class TemperatureArithmetic(Error, code="ROSS310", name="temperature-arithmetic"):
    """A sum, product or negation of temperatures on a scale with an arbitrary zero."""

    title = "a temperature in {unit} cannot be used in this calculation"
    label = "this is in {unit}"
    note = "zero {unit} is not the absence of temperature: twice 10 {unit} is not 20 {unit}"
    help = "compare temperatures as they are, or calculate in K"
    unit: str


class AmbiguousFor(Error, code="ROSS403", name="ambiguous-for"):
    """`for` behind two conditions without parentheses."""

    title = "it is not clear which condition must hold for {duration}"
    label = "only `{last}`, or the whole condition?"
    note = (
        "`for` binds tighter than `and` and `or`, but looks as if it covered everything before it"
    )
    help = "write `{narrow}` or `{wide}`"
    duration: str
    last: str
    narrow: str
    wide: str


class AmbiguousSince(Error, code="ROSS232", name="ambiguous-since"):
    """`since` beside `and` or `or` without parentheses."""

    title = "it is not clear how much of the condition `since` covers"
    label = "only `{near}`, or the whole condition?"
    note = (
        "`since` binds tighter than `and` and `or`, but looks as if it covered everything around it"
    )
    help = "write `{narrow}` or `{wide}`"
    near: str
    narrow: str
    wide: str


class ExactEquality(Warning, code="ROSS404", name="exact-equality"):
    """Measured numbers compared for equality."""

    title = "measured numbers are almost never exactly equal"
    label = "`{operator}` compares every last bit"
    help = "compare with a tolerance: `{advice}`"
    operator: str
    advice: str


class JumpingAngle(Warning, code="ROSS409", name="jumping-angle"):
    """A change of an angle that jumps by 360 deg at half a turn."""

    title = "`{angle}` jumps from 180 deg to -180 deg"
    label = "where it jumps, {effect}"
    note = "a robot that turns slowly past that point looks as if it had turned all the way round"
    help = (
        "compare an angular velocity that a message carries, such as "
        "`imu.angular_velocity.{axis}` or `odom.twist.twist.angular.{axis}`"
    )
    angle: str
    effect: str
    axis: str

    class Unfiltered(Remark):
        says = "compare `{angle}` itself, and use `for` to ignore single messages"
        angle: str


ALL: tuple[type[Template], ...] = (
    NotACondition,
    VectorAsScalar,
    Incomparable,
    NotANumber,
    ArrayAsScalar,
    MessageAsValue,
    OrientationAsScalar,
    NotConstant,
    DivisionByZero,
    ConstantTooLarge,
    NotAnArray,
    ElementsWithoutNames,
    UnlistedName,
    BooleanCompared,
    StringsCompared,
    NotADuration,
    DurationOutOfRange,
    TemperatureArithmetic,
    AmbiguousFor,
    AmbiguousSince,
    ExactEquality,
    JumpingAngle,
)
