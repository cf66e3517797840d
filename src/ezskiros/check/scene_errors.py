"""EZS6xx: scenes, the worlds that a robot starts in."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class Near(Remark):
    """The help where the name of an entity is misspelt."""

    says = "did you mean {near}?"
    near: str


class NoOntologyForScene(Error, code="EZS600", name="scene-without-ontology"):
    """A scene, and nothing to check it against."""

    title = "a scene is checked against an ontology, and none is named"
    help = "add `--ontology DIR`"


class UnknownSceneClass(Error, code="EZS601", name="unknown-class-in-scene"):
    """A thing of a class that the ontology does not have."""

    title = "{thing} is a {owl_class}, which is no class of the ontology"
    thing: str
    owl_class: str


class UnknownSceneProperty(Error, code="EZS602", name="unknown-property-in-scene"):
    """A relation or data property that the ontology does not have."""

    title = "the ontology has no relation or property {property}"
    label = "said of {thing}"
    property: str
    thing: str


class UnknownThing(Error, code="EZS603", name="unknown-thing"):
    """A relation to something that is nowhere described."""

    title = "{thing} is related by {property} to something that is not there: {other}"
    help = "describe {other}, or correct its name"
    thing: str
    property: str
    other: str


class SceneDoesNotFit(Error, code="EZS604", name="scene-does-not-fit"):
    """A relation of something that it does not relate."""

    title = "{thing} is a {found}, but {property} needs a {wanted}"
    label = "related by {property} here"
    thing: str
    found: str
    property: str
    wanted: str

    class Relates(Remark):
        says = "what it relates is declared here"


class WrongSceneValue(Error, code="EZS605", name="wrong-value-in-scene"):
    """A value of another type than the property has."""

    title = "{property} of {thing} is {found}, but its values are {wanted}"
    property: str
    thing: str
    found: str
    wanted: str


class KindOfProperty(Error, code="EZS606", name="kind-of-property"):
    """A relation with a value, or a data property with a thing."""

    title = "{property} is a {kind}, and {thing} gives it {found}"
    property: str
    kind: str
    thing: str
    found: str


class MissingRelation(Warning, code="EZS607", name="missing-relation"):
    """A thing without what the ontology says that each of its class has."""

    title = "{thing} has no {wanted} by {property}"
    note = "the ontology says that each {owl_class} has one"
    thing: str
    wanted: str
    property: str
    owl_class: str


class RepeatedNumber(Error, code="EZS608", name="repeated-number"):
    """Two things of one number: SkiROS2 tells things apart by it."""

    title = "{thing} and {other} have the same number"
    label = "SkiROS2 tells things apart by their numbers"
    help = "give one of them a number that no other has"
    thing: str
    other: str

    class Other(Remark):
        says = "the other one"


class TwoObjects(Error, code="EZS609", name="two-objects"):
    """A functional relation with two objects, or its inverse."""

    title = "{first} and {second} are both related to {thing} by {property}"
    note = "{property} is {kind}, and allows one"
    thing: str
    property: str
    first: str
    second: str
    kind: str


ALL: tuple[type[Template], ...] = (
    NoOntologyForScene,
    UnknownSceneClass,
    UnknownSceneProperty,
    UnknownThing,
    SceneDoesNotFit,
    WrongSceneValue,
    KindOfProperty,
    MissingRelation,
    RepeatedNumber,
    TwoObjects,
)
