"""EZS315 to EZS324: conditions that no world model satisfies together."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class IriHere(Remark):
    """The label of a declaration in the ontology."""

    says = "{iri} is declared here"
    iri: str


class AtOneTime(Remark):
    """The label of a condition that conflicts with the reported one."""

    says = "this cannot hold at the same time"


class OfOneIndividual(Remark):
    """The label of a condition that no individual satisfies together with the reported one."""

    says = "this cannot hold for the same individual"


class DeclaredAs(Remark):
    """The label of the parameter that stands for an individual."""

    says = "declared as a {owl_class}"
    owl_class: str


class Together(Template):
    """Conditions that cannot hold together, and the axioms of the ontology that show it."""

    note = "{why}"
    help = "delete the wrong condition"
    together: str
    when: str
    why: str
    kind: str
    consequence: str


class Clashing(Together, Error):
    """Conditions that exclude each other."""


class OppositeFollows(Clashing, code="EZS315", name="opposite-follows"):
    """Conditions that imply a contradiction through inverses and other axioms."""

    title = "with the ontology, {together} contradict each other {when}"


class BothWays(Clashing, code="EZS316", name="both-ways"):
    """An asymmetric relation in both directions."""

    title = "{together} cannot hold in both directions {when}"


class ToItself(Clashing, code="EZS317", name="to-itself"):
    """An irreflexive relation of an individual to itself."""

    title = "{together} would relate an individual to itself"


class HasNone(Clashing, code="EZS318", name="has-none"):
    """A relation or value that individuals of a class cannot have."""

    title = "{together} cannot hold {when}"


class ImpossibleIndividual(Clashing, code="EZS319", name="impossible-individual"):
    """An individual of two disjoint classes."""

    title = "{together} would make an individual a member of disjoint classes"
    help = "use an individual of only one of these classes"


class NoCommonValue(Clashing, code="EZS320", name="no-common-value"):
    """Comparisons that no value of a property satisfies."""

    title = "no value satisfies {together} {when}"


class TwoValues(Together, Warning, code="EZS321", name="two-values"):
    """Comparisons that only an individual with several values of a property satisfies."""

    title = "{together} hold together only for an individual with two values"
    note = "{why}"
    help = "delete the wrong condition; declare a single-valued property as owl:FunctionalProperty"


class EndsItsHold(Warning, code="EZS322", name="ends-its-hold"):
    """A post-condition that excludes a hold-condition."""

    title = "{together} cannot hold together: `{skill}` ends its own hold-condition"
    note = "{why}SkiROS2 tests hold-conditions in each tick, so the skill fails unless the \
change comes in the last tick"
    help = "delete the hold-condition, and add it to the children that need it"
    together: str
    skill: str
    why: str


class NoAlternative(Error, code="EZS323", name="no-alternative"):
    """An `or` whose alternatives are all excluded."""

    title = "none of the alternatives of this {kind}-condition can hold {when}"
    help = "delete the `or`, or the conditions that exclude its alternatives"
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
    """A parameter of a class that cannot have members."""

    title = "in the ontology {owl_class} cannot have members: it is {why}"
    help = "correct the ontology; SkiROS2 itself does not check this"
    owl_class: str
    why: str


ALL: tuple[type[Template], ...] = (
    OppositeFollows,
    BothWays,
    ToItself,
    HasNone,
    ImpossibleIndividual,
    NoCommonValue,
    TwoValues,
    EndsItsHold,
    NoAlternative,
    EmptyClass,
)
