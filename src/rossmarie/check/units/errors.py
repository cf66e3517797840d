"""Mistakes in units."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class OfUnknownUnit(Remark):
    """The label of a number of unknown unit."""

    says = "the unit of this value is not known"


class PlainNumber(Remark):
    """The label of a number without a unit."""

    says = "this is a plain number"


class InUnit(Remark):
    """The label of a number with a unit."""

    says = "this is in {unit} ({dimension})"
    unit: str
    dimension: str


class OfField(Remark):
    """The label of an input whose unit comes from its field."""

    says = "`{name}` is {field}"
    name: str
    field: str


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

    class NoUnit(Remark):
        says = "leave the unit out, or use a value with a unit on the other side"

    class Gram(Remark):
        says = "`{gram}` is gram; standard gravity is `{gravity}`"
        gram: str
        gravity: str


class RateAgainstQuantity(Error, code="ROSS302", name="rate-against-quantity"):
    """A quantity compared with a rate of change of that quantity."""

    title = "{rate} is the rate of change of {quantity}, and does not fit it"
    label = "{words}"
    note = "a quantity and its rate of change are different quantities"
    help = "write a value in {expected}"
    rate: str
    quantity: str
    words: str
    expected: str

    class Unit(Remark):
        says = "write a value in {unit}"
        unit: str

    class UnitOrRate(Remark):
        says = "write a value in {unit}, or compare the rate of change, `rate({text})`"
        unit: str
        text: str


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

    title = "this field needs a unit"
    label = "the unit of this field is not known"
    note = (
        "the field is combined with a quantity in {other}, and ROS message definitions carry no "
        "units"
    )
    help = "write the unit in which the field arrives after the input: `in {other}`"
    other: str

    class KnownUnit(Remark):
        says = "use inputs that declare their units, `in {unit}`"
        unit: str

    class InSystemModel(Remark):
        says = "declare the unit in a system model, `unit {field} = {unit};`"
        field: str
        unit: str


class UnknownUnit(Error, code="ROSS305", name="unknown-unit"):
    """A unit that does not exist."""

    title = "there is no unit `{text}`"
    label = "`{part}` is not a unit"
    text: str
    part: str

    class Factor(Remark):
        says = "calculate it: {factor}"
        factor: str

    class Examples(Remark):
        says = "units look like `m/s^2`, `N*m`, `deg`, `sec`, `%`"


class MisplacedUnit(Error, code="ROSS309", name="misplaced-unit"):
    """A unit on an expression that cannot have one."""

    title = "no unit is allowed here"
    label = "{reason}"
    reason: str

    class OfBothEnds(Remark):
        says = "this unit applies to both ends"

    class OfParameter(Remark):
        says = "write the unit of the parameter: `in {unit} to ...`"
        unit: str

    class Value(Remark):
        says = "write a value in {unit}"
        unit: str

    class OnceInList(Remark):
        says = "write the unit once, `[...] {unit}`"
        unit: str

    class OnceInRange(Remark):
        says = "write the unit once, `[low, high] {unit}`"
        unit: str

    class LeaveOut(Remark):
        says = "leave `in {unit}` out"
        unit: str

    class NameField(Remark):
        says = "name the field: `unit {message}.FIELD = {unit};`"
        message: str
        unit: str

    class NameNumber(Remark):
        says = "name a field that holds numbers"

    class ChooseField(Remark):
        says = "choose the field that is in {unit}, or leave `in {unit}` out"
        unit: str


class SpacedUnit(Error, code="ROSS312", name="spaced-unit"):
    """A unit with a space in it, so that the part behind the space looks like a value."""

    title = "`{identifier}` is a unit here, not a value"
    label = "`{operator} {identifier}` calculates with a value named `{identifier}`"
    note = (
        "a unit directly follows its number and contains no white space; no constant or input is "
        "named `{identifier}`"
    )
    help = "write `{corrected}`"
    identifier: str
    operator: str
    corrected: str

    class OnePiece(Remark):
        says = "write the unit without spaces, such as `10 km/h`"


class RatioOutOfRange(Error, code="ROSS314", name="ratio-out-of-range"):
    """A field with a ratio from 0 to 1, compared with a plain number above 1."""

    title = "{field} is a fraction from 0 to 1, but {text} is greater than 1"
    label = "as a fraction, 1 means 100 %"
    note = "whatever the name of the field suggests, a message carries 0.2 for 20 %"
    help = "write `{text} %`"
    field: str
    text: str


ALL: tuple[type[Template], ...] = (
    UnitMismatch,
    RateAgainstQuantity,
    MissingUnit,
    FieldWithoutUnit,
    UnknownUnit,
    MisplacedUnit,
    SpacedUnit,
    RatioOutOfRange,
)
