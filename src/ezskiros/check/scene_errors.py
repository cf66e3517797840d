"""EZS6xx: scenes, the initial world models."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class Near(Remark):
    """The help for a misspelt name."""

    says = "did you mean {near}?"
    near: str


class NoOntologyForScene(Error, code="EZS600", name="scene-without-ontology"):
    """A scene without an ontology."""

    title = "a scene can only be checked with an ontology, and none is given"
    help = "add `--ontology DIR`"


class UnknownSceneClass(Error, code="EZS601", name="unknown-class-in-scene"):
    """An individual of a class that the ontology does not have."""

    title = "{individual} is a {owl_class}, but the ontology has no such class"
    individual: str
    owl_class: str


class UnknownSceneProperty(Error, code="EZS602", name="unknown-property-in-scene"):
    """A relation or data property that the ontology does not have."""

    title = "the ontology has no relation or property {property}"
    label = "used on {individual}"
    property: str
    individual: str


class UnknownIndividual(Error, code="EZS603", name="unknown-individual"):
    """A relation to an individual that the scene does not describe."""

    title = "{property} relates {individual} to {other}, which the scene does not describe"
    help = "add {other} to the scene, or correct its name"
    individual: str
    property: str
    other: str


class SceneDoesNotFit(Error, code="EZS604", name="scene-does-not-fit"):
    """A relation of an individual outside its domain or range."""

    title = "{individual} is a {found}, but {property} needs a {wanted}"
    label = "{property} is used here"
    individual: str
    found: str
    property: str
    wanted: str

    class Relates(Remark):
        says = "its domain and range are declared here"


class WrongSceneValue(Error, code="EZS605", name="wrong-value-in-scene"):
    """A value of another type than the property."""

    title = "{property} of {individual} is {found}, but its type is {wanted}"
    property: str
    individual: str
    found: str
    wanted: str


class KindOfProperty(Error, code="EZS606", name="kind-of-property"):
    """A relation with a value, or a data property with an individual."""

    title = "{property} is a {kind}, but {individual} gives it {found}"
    property: str
    kind: str
    individual: str
    found: str


class MissingRelation(Warning, code="EZS607", name="missing-relation"):
    """An individual without a relation that the ontology requires of its class."""

    title = "{individual} has no relation {property} to a {wanted}"
    note = "the ontology requires one for every {owl_class}"
    individual: str
    wanted: str
    property: str
    owl_class: str


class RepeatedNumber(Error, code="EZS608", name="repeated-number"):
    """Two individuals with the same number, which SkiROS2 uses as their identifier."""

    title = "{individual} and {other} have the same number"
    label = "SkiROS2 identifies individuals by their numbers"
    help = "give one of them an unused number"
    individual: str
    other: str

    class Other(Remark):
        says = "the other individual"


class TwoObjects(Error, code="EZS609", name="two-objects"):
    """A functional relation with two objects, or an inverse functional one with two subjects."""

    title = "{first} and {second} are both related to {individual} by {property}"
    note = "{property} is {kind} and allows only one"
    individual: str
    property: str
    first: str
    second: str
    kind: str


ALL: tuple[type[Template], ...] = (
    NoOntologyForScene,
    UnknownSceneClass,
    UnknownSceneProperty,
    UnknownIndividual,
    SceneDoesNotFit,
    WrongSceneValue,
    KindOfProperty,
    MissingRelation,
    RepeatedNumber,
    TwoObjects,
)
