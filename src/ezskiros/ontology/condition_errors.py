"""EZS3xx: what is said about things."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class UnknownProperty(Error, code="EZS301", name="unknown-property"):
    """A relation or data property that the ontology does not have."""

    title = "the ontology has no relation or property `{spelled}`"
    label = "said of `{subject}`, a {subject_class}"
    spelled: str
    subject: str
    subject_class: str


class AmbiguousProperty(Error, code="EZS302", name="ambiguous-property"):
    """A name that several namespaces have."""

    title = "`{spelled}` can be {properties}"
    label = "which one?"
    help = "say it by its namespace: `{example}`"
    spelled: str
    properties: str
    example: str


class OneObject(Error, code="EZS303", name="one-object"):
    """A relation that is called with none or several things."""

    title = "`{relation}` needs one thing in its brackets, and has {count}"
    help = "write one line for each: `{subject}.{relation}(...)`"
    relation: str
    subject: str
    count: int


class NoThing(Error, code="EZS304", name="no-thing"):
    """A relation with something that is no thing of the world."""

    title = "`{relation}` is for things of the world, not for {found}"
    label = "a parameter is needed whose type is a class of the ontology"
    relation: str
    found: str


class NoValue(Error, code="EZS305", name="no-value"):
    """A data property that is compared with something that is no value."""

    title = "`{property}` is compared with {found}"
    label = "values are texts, numbers and truth values"
    note = "SkiROS2 compares with a value that is written down, the same each time the skill runs"
    property: str
    found: str


class NotCalled(Error, code="EZS306", name="not-called"):
    """A relation without an object."""

    title = "`{relation}` is a relation: it needs what it relates to"
    help = "write `{subject}.{relation}(...)`"
    relation: str
    subject: str


class NoTruthValue(Error, code="EZS307", name="no-truth-value"):
    """`and`, `or`, `not`, `if`, or a chained comparison of conditions."""

    title = "a condition is neither true nor false before the robot runs"
    label = "Python asks here whether it is true"
    help = (
        "for `and` write two lines, for `or` write `(first) | (second)`, for `not` write `~`, for "
        "`low < x < high` write two lines; `if` cannot ask for a condition"
    )


class NeedsBrackets(Error, code="EZS310", name="needs-brackets"):
    """A condition that is compared, as in `a | b.Weight < 3`."""

    title = "a condition is compared with something"
    label = "`|` binds tighter than a comparison"
    help = "put brackets around each comparison: `first | (Object.Weight < 3)`"


class NoRelation(Error, code="EZS311", name="no-relation-but-value"):
    """A data property that is called like a relation."""

    title = "`{property}` is a data property: it has values, and relates no things"
    help = "compare it, `{subject}.{property} == value`, or leave the brackets out"
    property: str
    subject: str


class ValueRelates(Error, code="EZS312", name="value-relates"):
    """A relation of a parameter that is no thing."""

    title = "`{parameter}` is of type {type}, and has no `{spelled}`"
    label = "only things of the world are related"
    help = "declare `{parameter}` with a class of the ontology, or use another parameter"
    parameter: str
    type: str
    spelled: str


class Assigned(Error, code="EZS314", name="assigned-property"):
    """`=` where `==` is meant."""

    title = "`{subject}.{spelled}` is assigned {found}, which a description cannot do"
    help = "say what has to hold: `self.post_conditions += {subject}.{spelled} == ...`"
    subject: str
    spelled: str
    found: str


class NoOpposite(Error, code="EZS308", name="no-opposite"):
    """`~` of a condition that has no opposite."""

    title = "the type of a thing cannot be negated: SkiROS2 has no such condition"
    help = "ask for the type that is meant"


class NoCondition(Error, code="EZS309", name="no-condition"):
    """Something else in the place of a condition."""

    title = "this is no condition, but {found}"
    label = "expected what a relation or property of a parameter gives"
    help = "write `Subject.relation(Object)` or `Subject.property == value`"
    found: str


class ThingAsTruth(Error, code="EZS313", name="thing-as-truth"):
    """`if Tool:`, or another query whether there is a thing."""

    title = "whether there is a `{parameter}` is not known before the robot runs"
    label = "Python asks here"
    help = "as a condition, write `specified({parameter})`; for two ways, write two skills"
    parameter: str


ALL: tuple[type[Template], ...] = (
    UnknownProperty,
    AmbiguousProperty,
    OneObject,
    NoThing,
    NoValue,
    NotCalled,
    NoTruthValue,
    NoOpposite,
    NoCondition,
    NeedsBrackets,
    NoRelation,
    ValueRelates,
    ThingAsTruth,
    Assigned,
)
