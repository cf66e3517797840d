"""EZS315 to EZS323: conditions that no world satisfies together."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class IriHere(Remark):
    """The label of a declaration of the ontology."""

    says = "{iri} is declared here"
    iri: str


class AtOneTime(Remark):
    """The label of another one of conditions that do not go together."""

    says = "this cannot hold at the same time"


class OfOneThing(Remark):
    """The label of another one of conditions that no thing fulfils."""

    says = "this cannot be so of the same thing"


class DeclaredAs(Remark):
    """The label of the parameter that stands for a thing."""

    says = "declared as a {owl_class}"
    owl_class: str


class Together(Template):
    """Conditions that do not go together at one time, and what the ontology says of it."""

    note = "{why}"
    help = "leave out what is not meant"
    together: str
    when: str
    why: str
    kind: str
    consequence: str


class Clashing(Together, Error):
    """Conditions that exclude each other."""


class OppositeFollows(Clashing, code="EZS315", name="opposite-follows"):
    """A fact that follows from conditions, by inverses and the like, is forbidden."""

    title = "by the ontology {together} contradict each other {when}"


class BothWays(Clashing, code="EZS316", name="both-ways"):
    """An asymmetric relation there and back."""

    title = "{together} cannot hold both ways {when}"


class ToItself(Clashing, code="EZS317", name="to-itself"):
    """An irreflexive relation of a thing to itself."""

    title = "by {together} a thing would be related to itself"


class HasNone(Clashing, code="EZS318", name="has-none"):
    """A relation, or a value, that things of a class do not have."""

    title = "{together} cannot hold {when}"


class ImpossibleThing(Clashing, code="EZS319", name="impossible-thing"):
    """A thing of two disjoint classes."""

    title = "by {together} a thing would be of disjoint classes"
    help = "declare the parameter, or relate it, as a thing of one of them"


class NoCommonValue(Clashing, code="EZS320", name="no-common-value"):
    """Comparisons that no value of a property satisfies."""

    title = "no value satisfies {together} {when}"


class TwoValues(Together, Warning, code="EZS321", name="two-values"):
    """Comparisons that only a thing with several values of a property satisfies."""

    title = "{together} hold together only of a thing with two values"
    note = "{why}"
    help = "leave out what is not meant; what has one value at a time is an owl:FunctionalProperty"


class EndsItsHold(Warning, code="EZS322", name="ends-its-hold"):
    """A post-condition that excludes a hold-condition."""

    title = "{together} cannot hold together: `{skill}` ends what has to hold while it runs"
    note = "{why}SkiROS2 looks at hold-conditions in each tick: unless what changes does so in the \
last one, the skill fails"
    help = "leave the hold-condition out, and hold it in those parts of the skill that need it"
    together: str
    skill: str
    why: str


class NoAlternative(Error, code="EZS323", name="no-alternative"):
    """An `or` of which each part is excluded."""

    title = "none of the alternatives of this {kind}-condition can hold {when}"
    help = "leave out the `or`, or what excludes it"
    kind: str
    when: str

    class Together(Remark):
        says = "excludes it together with others"

    class Excludes(Remark):
        says = "excludes {part}"
        part: str

    class Why(Remark):
        says = "{why}"
        why: str


class EmptyClass(Warning, code="EZS324", name="empty-class"):
    """A parameter of a class that nothing can be of."""

    title = "by the ontology nothing is a {owl_class}: it is {why}"
    help = "correct the ontology; SkiROS2 itself does not look at it"
    owl_class: str
    why: str


ALL: tuple[type[Template], ...] = (
    OppositeFollows,
    BothWays,
    ToItself,
    HasNone,
    ImpossibleThing,
    NoCommonValue,
    TwoValues,
    EndsItsHold,
    NoAlternative,
    EmptyClass,
)
