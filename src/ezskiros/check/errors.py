"""EZS4xx: conditions that contradict the ontology or each other."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning
from ezskiros.check.world_errors import Clashing


class OtherDirection(Remark):
    """The help for a relation that fits with its sides exchanged."""

    says = "exchange the sides: `{other}.{property}({subject})`"
    other: str
    property: str
    subject: str


class DeclaredAs(Remark):
    """The label of a parameter."""

    says = "declared as {owl_class}"
    owl_class: str


class Relates(Remark):
    """The label of a property of the ontology."""

    says = "its domain and range are declared here"


class DoesNotFit(Error, code="EZS401", name="does-not-fit"):
    """A relation of an individual outside its domain or range."""

    title = "{parameter} is a {found}, but {property} needs a {wanted}"
    label = "this is a {found}"
    help = "use a {wanted}, or add {found} to the domain or range of {property} in the ontology"
    parameter: str
    found: str
    property: str
    wanted: str


class MayNotFit(Warning, code="EZS402", name="may-not-fit"):
    """A relation of an individual that may be in its domain or range."""

    title = "{parameter} is a {found}, but {property} needs a {wanted}: it may not be one"
    label = "this may be a {found} of another class"
    help = "declare `{parameter}: {wanted}`"
    parameter: str
    found: str
    property: str
    wanted: str


class WrongValue(Error, code="EZS403", name="wrong-value"):
    """A value of another type than the property."""

    title = "{property} has values of type {wanted}, not {found}"
    help = "compare it with a value of type {wanted}"
    property: str
    wanted: str
    found: str


class UnlistedValue(Error, code="EZS404", name="unlisted-value"):
    """A value that the ontology does not list."""

    title = "{found} is not a value of {property}"
    note = "the values of {property} are {values}"
    found: str
    property: str
    values: str

    class Near(Remark):
        says = "did you mean {near}?"
        near: str


class NoOrder(Error, code="EZS405", name="no-order"):
    """An operator such as `<` on strings."""

    title = "`{operator}` compares numbers, not {found}"
    help = "use `==` or `!=` for strings and Booleans"
    operator: str
    found: str


class Repeated(Warning, code="EZS410", name="repeated-condition"):
    """A repeated condition."""

    title = "this {kind}-condition repeats an earlier one"
    help = "delete it: repeating a condition has no effect"
    kind: str

    class First(Remark):
        says = "the first one is here"


class Contradiction(Clashing, code="EZS411", name="contradiction"):
    """A condition and its opposite."""

    title = "this {kind}-condition contradicts another one"
    note = "no world model satisfies both, so {consequence}"


class TwoPlaces(Clashing, code="EZS412", name="two-places"):
    """A functional relation with two objects, or an inverse functional one with two subjects."""

    title = "{together} cannot both hold {when}"
    help = "delete the wrong condition, or negate it with `~`"


class UnusedParameter(Warning, code="EZS420", name="unused-parameter"):
    """An individual that no condition uses."""

    title = "no condition uses the parameter `{parameter}`"
    help = "add a condition about `{parameter}`, or delete the parameter"
    parameter: str


class NotInferable(Warning, code="EZS421", name="not-inferable"):
    """An inferred parameter that no pre-condition relates to a given parameter."""

    title = "no pre-condition determines the inferred parameter `{parameter}`"
    label = "SkiROS2 would choose any {candidates}"
    help = "add a pre-condition that relates `{parameter}` to a given parameter"
    parameter: str
    candidates: str


class BothDirections(Warning, code="EZS422", name="both-directions"):
    """A relation whose sides are exchanged in other conditions."""

    title = "{relation} relates a {subject} to a {object} here, but elsewhere the reverse"
    note = "the ontology gives no domain or range for {relation} that would reveal a swap"
    help = "if the sides are swapped here, write `{turned}`"
    relation: str
    subject: str
    object: str
    turned: str

    class Other(Remark):
        says = "the sides are exchanged here"


ALL: tuple[type[Template], ...] = (
    DoesNotFit,
    MayNotFit,
    WrongValue,
    UnlistedValue,
    NoOrder,
    Repeated,
    Contradiction,
    TwoPlaces,
    UnusedParameter,
    NotInferable,
    BothDirections,
)
