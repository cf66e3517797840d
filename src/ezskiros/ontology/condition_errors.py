"""EZS3xx: conditions about individuals of the world model."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class UnknownProperty(Error, code="EZS301", name="unknown-property"):
    """A relation or data property that the ontology does not have."""

    title = "the ontology has no relation or property `{spelled}`"
    label = "used on `{subject}`, a {subject_class}"
    spelled: str
    subject: str
    subject_class: str


class AmbiguousProperty(Error, code="EZS302", name="ambiguous-property"):
    """A name that is defined in several namespaces."""

    title = "`{spelled}` is ambiguous: {properties}"
    label = "several namespaces have this name"
    help = "add the namespace: `{example}`"
    spelled: str
    properties: str
    example: str


class OneObject(Error, code="EZS303", name="one-object"):
    """A relation with no object, or with several."""

    title = "`{relation}` takes one individual in brackets, not {count}"
    help = "write one line per individual: `{subject}.{relation}(...)`"
    relation: str
    subject: str
    count: int


class NoIndividual(Error, code="EZS304", name="no-individual"):
    """A relation to a value that is not an individual of the world model."""

    title = "`{relation}` relates individuals of the world model, not {found}"
    label = "expected a parameter whose type is a class of the ontology"
    relation: str
    found: str


class NoValue(Error, code="EZS305", name="no-value"):
    """A data property that is compared with an object that is not a value."""

    title = "`{property}` is compared with {found}"
    label = "a value is a string, a number or a Boolean"
    note = "SkiROS2 compares with a constant that is the same each time the skill runs"
    property: str
    found: str


class NotCalled(Error, code="EZS306", name="not-called"):
    """A relation without an object."""

    title = "`{relation}` is a relation and needs an object"
    help = "write `{subject}.{relation}(...)`"
    relation: str
    subject: str


class NoTruthValue(Error, code="EZS307", name="no-truth-value"):
    """`and`, `or`, `not`, `if`, or a chained comparison of conditions."""

    title = "a condition has no truth value before the robot runs"
    label = "Python needs the truth value here"
    help = (
        "for `and` write two lines, for `or` write `(first) | (second)`, for `not` write `~`, for "
        "`low < x < high` write two lines; `if` cannot test a condition"
    )


class NeedsBrackets(Error, code="EZS310", name="needs-brackets"):
    """A condition that is compared, as in `a | b.Weight < 3`."""

    title = "a condition is compared with a value"
    label = "`|` binds tighter than a comparison"
    help = "put brackets around each comparison: `first | (Object.Weight < 3)`"


class NoRelation(Error, code="EZS311", name="no-relation-but-value"):
    """A data property that is called like a relation."""

    title = "`{property}` is a data property: it has values and does not relate individuals"
    help = "compare it, `{subject}.{property} == value`, or remove the brackets"
    property: str
    subject: str


class ValueRelates(Error, code="EZS312", name="value-relates"):
    """A relation of a parameter that does not stand for an individual."""

    title = "`{parameter}` has type {type} and has no `{spelled}`"
    label = "only individuals of the world model have relations"
    help = "declare `{parameter}` with a class of the ontology, or use another parameter"
    parameter: str
    type: str
    spelled: str


class Assigned(Error, code="EZS314", name="assigned-property"):
    """`=` instead of `==`."""

    title = "a description cannot assign {found} to `{subject}.{spelled}`"
    help = "write a condition: `self.post_conditions += {subject}.{spelled} == ...`"
    subject: str
    spelled: str
    found: str


class NoOpposite(Error, code="EZS308", name="no-opposite"):
    """`~` of a condition that SkiROS2 cannot negate."""

    title = "the type of an individual cannot be negated: SkiROS2 has no such condition"
    help = "name the required type"


class NoCondition(Error, code="EZS309", name="no-condition"):
    """An entry that is not a condition."""

    title = "this is {found}, not a condition"
    label = "expected a relation or property of a parameter"
    help = "write `Subject.relation(Object)` or `Subject.property == value`"
    found: str


class IndividualAsCondition(Error, code="EZS313", name="individual-as-condition"):
    """`if Tool:`, or another test of whether an individual exists."""

    title = "before the robot runs it is unknown whether `{parameter}` exists"
    label = "Python needs the truth value here"
    help = "write the condition `specified({parameter})`, or write two skills for the two cases"
    parameter: str


ALL: tuple[type[Template], ...] = (
    UnknownProperty,
    AmbiguousProperty,
    OneObject,
    NoIndividual,
    NoValue,
    NotCalled,
    NoTruthValue,
    NoOpposite,
    NoCondition,
    NeedsBrackets,
    NoRelation,
    ValueRelates,
    IndividualAsCondition,
    Assigned,
)
