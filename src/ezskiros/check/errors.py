"""EZS4xx: conditions against the ontology, and against each other."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning
from ezskiros.check.world_errors import Clashing


class OtherWay(Remark):
    """The help where a relation fits if it is turned."""

    says = "the other way round: `{other}.{property}({subject})`"
    other: str
    property: str
    subject: str


class DeclaredAs(Remark):
    """The label of a parameter."""

    says = "declared as {owl_class}"
    owl_class: str


class Relates(Remark):
    """The label of a property of the ontology."""

    says = "what it relates is declared here"


class DoesNotFit(Error, code="EZS401", name="does-not-fit"):
    """A relation of something that it does not relate."""

    title = "{parameter} is a {found}, but {property} needs a {wanted}"
    label = "this is a {found}"
    help = "relate a {wanted}, or declare in the ontology that {property} relates a {found}"
    parameter: str
    found: str
    property: str
    wanted: str


class MayNotFit(Warning, code="EZS402", name="may-not-fit"):
    """A relation of something that may be of the right class."""

    title = "{parameter} is a {found}, and not each is a {wanted} that {property} needs"
    label = "may be another {found}"
    help = "declare `{parameter}: {wanted}`"
    parameter: str
    found: str
    property: str
    wanted: str


class WrongValue(Error, code="EZS403", name="wrong-value"):
    """A value of another type than the property has."""

    title = "{property} has values of type {wanted}, and {found} is none"
    help = "compare it with a value of type {wanted}"
    property: str
    wanted: str
    found: str


class UnlistedValue(Error, code="EZS404", name="unlisted-value"):
    """A value that the ontology does not list."""

    title = "{found} is no value of {property}"
    note = "its values are {values}"
    found: str
    property: str
    values: str

    class Near(Remark):
        says = "did you mean {near}?"
        near: str


class NoOrder(Error, code="EZS405", name="no-order"):
    """`<` of texts."""

    title = "`{operator}` compares numbers, and {found} is none"
    help = "only `==` and `!=` are for texts and truth values"
    operator: str
    found: str


class Repeated(Warning, code="EZS410", name="repeated-condition"):
    """A condition that is there already."""

    title = "this {kind}-condition is there already"
    help = "leave it out: conditions are a set"
    kind: str

    class First(Remark):
        says = "it is here"


class Contradiction(Clashing, code="EZS411", name="contradiction"):
    """A condition and its opposite."""

    title = "this {kind}-condition contradicts another"
    note = "no world satisfies both, so that {consequence}"


class TwoPlaces(Clashing, code="EZS412", name="two-places"):
    """A functional relation with two objects, or an inverse functional one with two subjects."""

    title = "{together} cannot be so at once {when}"
    help = "leave out what is not meant, or say with `~` which of them does not hold"


class UnusedParameter(Warning, code="EZS420", name="unused-parameter"):
    """A thing that no condition is about."""

    title = "no condition is about the parameter `{parameter}`"
    help = "say what has to hold of it, or leave it out"
    parameter: str


class NotInferable(Warning, code="EZS421", name="not-inferable"):
    """An inferred parameter that no pre-condition leads to."""

    title = "nothing leads to the inferred parameter `{parameter}`"
    label = "SkiROS2 would take any {candidates}"
    help = "add a pre-condition that relates `{parameter}` to a parameter that is given"
    parameter: str
    candidates: str


class BothDirections(Warning, code="EZS422", name="both-directions"):
    """A relation that other conditions have the other way round."""

    title = "{relation} relates a {subject} to a {object} here, and the other way round elsewhere"
    note = "the ontology does not say what {relation} relates, so a swap is seen in no other way"
    help = "if it is swapped here: `{turned}`"
    relation: str
    subject: str
    object: str
    turned: str

    class Other(Remark):
        says = "here it is the other way round"


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
