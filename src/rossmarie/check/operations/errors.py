"""What is wrong with operations: types, constants, times."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template, Warning


class UnknownFunction(Error, code="ROSS107", name="unknown-function"):
    """A call of something that is not built in."""

    title = "there is no function `{identifier}`"
    label = "not a built-in function"
    identifier: str


class NotACondition(Error, code="ROSS201", name="not-a-condition"):
    """A value where something true or false is needed."""

    title = "a condition is needed here"
    label = "this is {found}, neither true nor false"
    help = "compare it with something, `{text} > ...`"
    found: str
    text: str


class VectorAsScalar(Error, code="ROSS202", name="vector-as-scalar"):
    """Three numbers where one is needed."""

    title = "a vector is not one number"
    label = "this is {found}"
    note = "nothing says which of its three numbers is meant"
    help = "choose a component, `{text}.x`, `{text}.y` or `{text}.z`, or the length, `norm({text})`"
    found: str
    text: str


class ScalarAsRange(Error, code="ROSS203", name="scalar-as-range"):
    """`in` followed by one number."""

    title = "`in` needs a range, not one number"
    label = "this is {found}"
    note = "one number has no inside; a range has two ends, `[low, high]`"
    found: str


class Incomparable(Error, code="ROSS204", name="incomparable"):
    """A comparison of things of different kinds."""

    title = "{left} cannot be compared with {right}"
    label = "`{operator}` needs two numbers, or `==` and `!=` two strings"
    left: str
    right: str
    operator: str


class NotANumber(Error, code="ROSS205", name="not-a-number"):
    """Something else where one number is needed."""

    title = "a number is needed here"
    label = "this is {found}"
    found: str


class ArrayAsScalar(Error, code="ROSS206", name="array-as-scalar"):
    """Many numbers, or many truths, where one is needed."""

    title = "an array is not one {expected}"
    label = "this has one {expected} for each element"
    help = "{advice}"
    expected: str
    advice: str


class MessageAsValue(Error, code="ROSS207", name="message-as-value"):
    """A whole message where one value is needed."""

    title = "a whole message is not a value"
    label = "this is a {found}"
    found: str


class WrongArgumentCount(Error, code="ROSS209", name="wrong-argument-count"):
    """A call with too few or too many arguments."""

    title = "`{function}` takes {expected}"
    label = "{found} given"
    help = "write `{usage}`"
    function: str
    expected: str
    found: str
    usage: str


class WrongArgument(Error, code="ROSS210", name="wrong-argument"):
    """A call of a function on something that it is not defined for."""

    title = "`{function}` needs {expected}"
    label = "this is {found}"
    help = "write `{usage}`"
    function: str
    expected: str
    found: str
    usage: str


class ElementwiseMixture(Error, code="ROSS211", name="elementwise-mixture"):
    """An elementwise expression over more than one array and constants."""

    title = "an elementwise expression may use one array and constants"
    label = "{found}"
    note = "`{function}` looks at the elements of one array, one by one"
    help = "compare the least or greatest element with `{text}`: `min(...)` or `max(...)`"
    found: str
    function: str
    text: str


class BracketLength(Error, code="ROSS212", name="bracket-length"):
    """A bracket that is neither an interval nor a box."""

    title = "a bracket holds 2 numbers (an interval) or 6 (a box), not {count}"
    label = "{count} here"
    help = "write `[low, high]`, or `[xmin, xmax, ymin, ymax, zmin, zmax]`"
    count: int


class RangeMismatch(Error, code="ROSS213", name="range-mismatch"):
    """`in` with a value that the range cannot hold."""

    title = "{value} cannot be in {container}"
    label = "this is {container}"
    note = "an interval holds numbers; a box holds vectors"
    value: str
    container: str


class OrientationAsScalar(Error, code="ROSS214", name="orientation-as-scalar"):
    """A quaternion where one number is needed."""

    title = "an orientation is not one number"
    label = "this is a quaternion"
    help = "choose an angle: `{text}.roll()`, `{text}.pitch()` or `{text}.yaw()`"
    text: str


class NotConstant(Error, code="ROSS215", name="not-constant"):
    """Something that changes where a constant is needed."""

    title = "{purpose} has to be constant"
    label = "this is not constant"
    note = "it has to be known before the monitor runs"
    help = "use numbers, strings, `true`, `false`, other constants and operators on them"
    purpose: str


class IntervalEndsSwapped(Error, code="ROSS216", name="interval-ends-swapped"):
    """An interval whose low end is above its high end."""

    title = "the ends of this interval are swapped"
    label = "no number is in here"
    note = "the low end comes first; {low} is more than {high}"
    help = "write `{corrected}`"
    low: str
    high: str
    corrected: str


class DivisionByZero(Error, code="ROSS217", name="division-by-zero"):
    """A division by a constant that is zero."""

    title = "division by zero"
    label = "this is always zero"
    note = "the result would never be known, and no rule on it could ever be decided"
    help = "divide by something else"


class ConstantTooLarge(Error, code="ROSS218", name="constant-too-large"):
    """A constant beyond the range of a double."""

    title = "this constant is too large"
    label = "beyond what a 64-bit floating-point number can hold"
    help = "write a number below 1e308, counted in SI units"


class AgeMisused(Error, code="ROSS219", name="age-misused"):
    """`age` other than as one side of a comparison with a constant time."""

    title = "`age` can only be compared with a constant time"
    label = "{reason}"
    note = "an age grows by itself; the monitor has to know the instant at which it matters"
    help = "write `age(INPUT) > 0.5 sec`; with `<`, `<=`, `>` or `>=`"
    reason: str


class OscillationCount(Error, code="ROSS220", name="oscillation-count"):
    """A number of turning points that cannot be counted."""

    title = "a number of turning points is a whole number from 1 to {most}"
    label = "this is {found}"
    help = "write `3 times`"
    found: str
    most: int


class NotAnArray(Error, code="ROSS221", name="not-an-array"):
    """An index, or a question about elements, on something without elements."""

    title = "{purpose} needs an array"
    label = "this is {found}"
    purpose: str
    found: str


class TruthCompared(Error, code="ROSS222", name="truth-compared"):
    """A condition compared as if it were a number."""

    title = "conditions are not compared by `{operator}`"
    label = "this is already true or false"
    help = "write the condition itself, or `not` and the condition; join two by `and` and `or`"
    operator: str


class StringsCompared(Error, code="ROSS223", name="strings-compared"):
    """A comparison of two texts that both arrive with messages."""

    title = "a string can only be compared with a string that is written down"
    label = "neither side is known before the monitor runs"
    note = (
        "a monitor keeps apart only the strings that the rules mention: "
        "all others are one and the same to it"
    )
    help = 'compare each with the strings that matter: `{left} == "..." and {right} == "..."`'
    left: str
    right: str


class StringsAsRange(Error, code="ROSS224", name="strings-as-range"):
    """Texts in brackets, as if `in` looked for one in a list."""

    title = "a bracket is a range of numbers, not a list of strings"
    label = "these are strings"
    note = "strings have no order, so nothing is between two of them"
    help = "compare with each string, `==` or `!=`, and join by `or` or `and`"


class NotADuration(Error, code="ROSS306", name="not-a-duration"):
    """Something else where a length of time is needed."""

    title = "{purpose} is a length of time"
    label = "this is {found}"
    help = "write a time, such as `0.5 sec`"
    purpose: str
    found: str


class DurationOutOfRange(Error, code="ROSS307", name="duration-out-of-range"):
    """A length of time that is zero, negative, or longer than any robot lives."""

    title = "{purpose} has to be {bound}"
    label = "this is {found}"
    note = "{reason}"
    help = "write a time, such as `0.5 sec`"
    purpose: str
    bound: str
    found: str
    reason: str


class TemperatureArithmetic(Error, code="ROSS310", name="temperature-arithmetic"):
    """A sum, product or negation of temperatures whose zero is arbitrary."""

    title = "a temperature in {unit} is no amount to calculate with"
    label = "this is in {unit}"
    note = "zero {unit} is not the absence of temperature: twice 10 {unit} is not 20 {unit}"
    help = "compare temperatures as they are, or calculate in K"
    unit: str


class AmbiguousFor(Error, code="ROSS403", name="ambiguous-for"):
    """`for` behind two conditions without parentheses."""

    title = "it is not clear what has to hold for {duration}"
    label = "`{last}` alone, or all of it?"
    note = "`for` binds tighter than `and` and `or`, but reads as if it covered all before it"
    help = "write `{narrow}` or `{wide}`"
    duration: str
    last: str
    narrow: str
    wide: str


class ExactEquality(Warning, code="ROSS404", name="exact-equality"):
    """Measured numbers compared for equality."""

    title = "measured numbers are hardly ever exactly equal"
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


ALL: tuple[type[Template], ...] = (
    UnknownFunction,
    NotACondition,
    VectorAsScalar,
    ScalarAsRange,
    Incomparable,
    NotANumber,
    ArrayAsScalar,
    MessageAsValue,
    WrongArgumentCount,
    WrongArgument,
    ElementwiseMixture,
    BracketLength,
    RangeMismatch,
    OrientationAsScalar,
    NotConstant,
    IntervalEndsSwapped,
    DivisionByZero,
    ConstantTooLarge,
    AgeMisused,
    OscillationCount,
    NotAnArray,
    TruthCompared,
    StringsCompared,
    StringsAsRange,
    NotADuration,
    DurationOutOfRange,
    TemperatureArithmetic,
    AmbiguousFor,
    ExactEquality,
    JumpingAngle,
)
