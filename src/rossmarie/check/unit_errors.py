"""ROSS3xx: units and durations."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class UnitMismatch(Error, code="ROSS301", name="unit-mismatch"):
    """Two quantities of different dimensions where one dimension is needed."""

    title = "{found} does not fit {expected}"
    label = "{words}"
    note = "only quantities of one dimension can be {purpose}"
    help = "give both sides a unit of one dimension, such as {expected}"
    found: str
    words: str
    expected: str
    purpose: str


class RateAgainstQuantity(Error, code="ROSS302", name="rate-against-quantity"):
    """A quantity compared with a rate of change of that quantity."""

    title = "{rate} is the rate of change of {quantity}, and does not fit it"
    label = "{words}"
    note = "how much something is and how fast it changes are different things"
    help = "write a value in {expected}"
    rate: str
    quantity: str
    words: str
    expected: str


class MissingUnit(Error, code="ROSS303", name="missing-unit"):
    """A plain number where a quantity with a unit is needed."""

    title = "this number needs a unit"
    label = "a plain number"
    note = "the other side is in {expected} ({dimension}); {reason}"
    help = "write `{corrected}`"
    expected: str
    dimension: str
    reason: str
    corrected: str


class FieldWithoutUnit(Error, code="ROSS304", name="field-without-unit"):
    """A message field of unknown unit where the unit matters."""

    title = "the unit of this field is not known"
    label = "no unit is known for this"
    note = "it meets a quantity in {other}, and ROS message definitions carry no units"
    help = "say in which unit it arrives, with `in {other}` after the input"
    other: str


class UnknownUnit(Error, code="ROSS305", name="unknown-unit"):
    """A unit that does not exist."""

    title = "there is no unit `{text}`"
    label = "`{part}` is not a unit"
    text: str
    part: str


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


class UnitContradictsField(Error, code="ROSS308", name="unit-contradicts-field"):
    """A unit given to an input whose field has a unit of another dimension."""

    title = "{field} is in {known}, not in {found}"
    label = "this is of another dimension"
    note = "the unit after `in` says in which unit of its dimension a field arrives"
    help = (
        "leave `in {found}` out; if the field does carry {found}, say so in the system model: "
        "`unit {field} = {found};`"
    )
    field: str
    known: str
    found: str


class MisplacedUnit(Error, code="ROSS309", name="misplaced-unit"):
    """A unit on something that cannot have one."""

    title = "a unit does not belong here"
    label = "{reason}"
    help = "{advice}"
    reason: str
    advice: str


class TemperatureArithmetic(Error, code="ROSS310", name="temperature-arithmetic"):
    """A sum, product or negation of temperatures whose zero is arbitrary."""

    title = "a temperature in {unit} is no amount to calculate with"
    label = "this is in {unit}"
    note = "zero {unit} is not the absence of temperature: twice 10 {unit} is not 20 {unit}"
    help = "compare temperatures as they are, or calculate in K"
    unit: str


class FieldUnitConflict(Error, code="ROSS311", name="field-unit-conflict"):
    """One field of one topic, said to arrive in two units."""

    title = "{field} of topic `{topic}` cannot arrive both in {found} and in {expected}"
    label = "{found} here"
    note = "each message carries one number there; at least one of the two would be misread"
    help = "find out what the topic carries, and say the same in both places"
    topic: str
    field: str
    found: str
    expected: str


class SpacedUnit(Error, code="ROSS312", name="spaced-unit"):
    """A unit with white space in it, so that its rest is taken for a value."""

    title = "`{identifier}` is a unit here, not a value"
    label = "`{operator} {identifier}` calculates with something called `{identifier}`"
    note = (
        "a unit stands directly after its number and has no white space in itself; "
        "no constant or input is called `{identifier}`"
    )
    help = "write `{corrected}`"
    identifier: str
    operator: str
    corrected: str


class UnitDeclarationConflict(Error, code="ROSS313", name="unit-declaration-conflict"):
    """One field of one message, declared to be in two units by system models."""

    title = "{field} cannot be both in {found} and in {expected}"
    label = "{found} here"
    note = "a field carries one number; with one of the two units it would be misread"
    help = "find out what the publishers send, and declare its unit once"
    field: str
    found: str
    expected: str


class RatioOutOfRange(Error, code="ROSS314", name="ratio-out-of-range"):
    """A field that carries a share from 0 to 1, compared with a plain number above 1."""

    title = "{field} is a share from 0 to 1, and {text} is beyond that"
    label = "as a share, 1 means 100 %"
    note = "whatever the name of the field says, a message carries 0.2 there for 20 %"
    help = "write `{text} %`"
    field: str
    text: str


class RateConflict(Error, code="ROSS328", name="rate-conflict"):
    """One topic, said to carry messages at two rates."""

    title = "messages on `{topic}` cannot come both at {found} and at {expected}"
    label = "another rate here"
    help = "declare one rate, or a range that holds both: `at [8, 12] Hz`"
    topic: str
    found: str
    expected: str


ALL: tuple[type[Template], ...] = (
    UnitMismatch,
    RateAgainstQuantity,
    MissingUnit,
    FieldWithoutUnit,
    UnknownUnit,
    NotADuration,
    DurationOutOfRange,
    UnitContradictsField,
    MisplacedUnit,
    TemperatureArithmetic,
    FieldUnitConflict,
    SpacedUnit,
    UnitDeclarationConflict,
    RatioOutOfRange,
    RateConflict,
)
