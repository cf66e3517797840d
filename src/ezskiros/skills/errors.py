"""EZS2xx: descriptions of skills, and their parameters."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class HasKey(Remark):
    """The note that tells what SkiROS2 calls a parameter."""

    says = "`{parameter}` has the key {key}"
    parameter: str
    key: str


class NoDescription(Error, code="EZS201", name="no-description"):
    """A skill without the method that describes it."""

    title = "the skill `{skill}` has no method `description`"
    help = "write `def description(self, Robot: INFERRED[cora.Robot], ...):`"
    skill: str

    class Near(Remark):
        says = "did you mean `description`?"

    class Migrate(Remark):
        says = "`ezskiros migrate` translates `createDescription`"


class NoAnnotation(Error, code="EZS202", name="no-annotation"):
    """A parameter without a type."""

    title = "the parameter `{parameter}` has no type"
    help = "write `{parameter}: skiros.Product`, or another class of the ontology, or a basic type"
    parameter: str


class TextAnnotation(Error, code="EZS203", name="text-annotation"):
    """A type in quotes that is not Python."""

    title = "the type of `{parameter}` is a text: {text}"
    note = "it is not an expression of Python: {reason}"
    help = "write {example}, without quotes"
    parameter: str
    text: str
    reason: str
    example: str


class NoParameterType(Error, code="EZS204", name="no-parameter-type"):
    """A type that parameters of skills cannot have."""

    title = "a parameter cannot be {found}"
    label = "the type of `{parameter}`"
    note = (
        "parameters are things of the ontology, str, int, float, bool or enumerations; lists and "
        "dictionaries would hide from every check what is in them (thesis, Paper IV, section 6)"
    )
    help = "use one parameter for each value, an enumeration, or a class of the ontology"
    parameter: str
    found: str


class WrongDefault(Error, code="EZS205", name="wrong-default"):
    """A default that is not of the parameter's type."""

    title = "the default of `{parameter}` is {found}, which is no {expected}"
    help = "give a value of type {expected}, or none"
    parameter: str
    found: str
    expected: str


class ThingDefault(Error, code="EZS206", name="thing-default"):
    """A default for a parameter that stands for a thing."""

    title = "`{parameter}` stands for a thing of the world, and cannot have a default"
    help = "write `INFERRED[...]` if it is found in the world, `OPTIONAL[...]` if it may be none"
    parameter: str


class MarkedBasic(Error, code="EZS207", name="marked-basic"):
    """INFERRED or an option around a basic type."""

    title = "`{marker}` is for things of the world, not for {type}"
    label = "the type of `{parameter}`"
    help = "give `{parameter}` a default value, or leave `{marker}` out"
    marker: str
    type: str
    parameter: str


class TwoKinds(Error, code="EZS216", name="two-kinds"):
    """A parameter that is inferred and optional."""

    title = "`{parameter}` cannot be both INFERRED and OPTIONAL"
    label = "the type of `{parameter}`"
    help = "write `OPTIONAL[...]` if the skill can do without it, `INFERRED[...]` if it cannot"
    parameter: str


class PackedParameters(Error, code="EZS208", name="packed-parameters"):
    """`*args` or `**kwargs` in a description."""

    title = "a skill has a fixed set of parameters: no `{spelling}`"
    help = "name each parameter, with its type"
    spelling: str


class ReplacedConditions(Error, code="EZS209", name="replaced-conditions"):
    """`=` where `+=` is meant."""

    title = "`{conditions}` is replaced, which would lose what it has"
    help = "add to it: `self.{conditions} += ...`"
    conditions: str


class NoClass(Error, code="EZS210", name="no-class"):
    """`of_type` with something that is no class."""

    title = "`of_type` needs a class of the ontology, not {found}"
    help = "write `of_type(Object, skiros.Product)`"
    found: str


class NoRelation(Error, code="EZS211", name="no-relation"):
    """`abstract` of something that is no relation."""

    title = "`abstract` needs a relation, not {found}"
    help = "write `abstract(Robot.hasA(Arm))`"
    found: str


class NoConditions(Error, code="EZS212", name="no-conditions"):
    """Conditions of a kind that there is not."""

    title = "a skill has no `{spelled}`"
    help = "did you mean `{meant}`?"
    spelled: str
    meant: str


class UnknownParameter(Error, code="EZS213", name="unknown-parameter"):
    """A name that is neither a parameter nor defined in the module."""

    title = "`{spelled}` is no parameter of `{skill}`"
    label = "nothing of this name is defined"
    spelled: str
    skill: str

    class Signature(Remark):
        says = "write `def {method}(self, {parameter}):`"
        method: str
        parameter: str


class NoSelf(Error, code="EZS214", name="no-self"):
    """A description without `self`, or with a parameter in its place."""

    title = "the first parameter of `description` has to be `self`"
    help = "write `def description(self, ...):`"


class AddedOtherwise(Error, code="EZS215", name="added-otherwise"):
    """`append` where `+=` is meant."""

    title = "`+=` adds to `self.{conditions}`: there is no `{spelled}`"
    help = "write `self.{conditions} += ...`, a line for each"
    spelled: str
    conditions: str


class Raised(Error, code="EZS220", name="description-raised"):
    """A method that ends with an exception."""

    title = "{method} raises {exception}"
    label = "{said}"
    method: str
    exception: str
    said: str

    class Added(Remark):
        says = "write `self.{conditions} += ...`"
        conditions: str


class SideEffect(Error, code="EZS221", name="side-effect"):
    """A method that does something to the world while it is checked."""

    title = "{method} {deed}"
    label = "not done: a check does nothing to the world"
    help = "{advice}"
    method: str
    advice: str
    deed: str


class NeverEnds(Error, code="EZS222", name="never-ends"):
    """A method that runs for too long."""

    title = "{method} does not end within {seconds} s"
    label = "it was here when its time was over"
    method: str
    seconds: float


class DependsOnValue(Error, code="EZS223", name="depends-on-value"):
    """Conditions that depend on the value of a parameter."""

    title = "the conditions of `{skill}` depend on the value of `{parameter}`"
    label = "decided here"
    note = "SkiROS2 reads a description once, before any parameter has a value"
    help = "write two skills, or conditions that hold for every value"
    skill: str
    parameter: str


class TooManyPaths(Warning, code="EZS224", name="too-many-paths"):
    """More branches than are looked into."""

    title = "{method} branches so often that only {count} ways are checked"
    help = "leave out what does not matter for what comes of it"
    method: str
    count: int


class DependsOnOutcome(Error, code="EZS225", name="depends-on-outcome"):
    """Conditions that depend on something that a check does not do."""

    title = "the conditions of `{skill}` depend on what `{call}` gives"
    label = "decided here"
    note = "a check does nothing to the world, so that nobody knows before the robot runs"
    help = "write two skills, a parameter, or conditions that hold in any case"
    skill: str
    call: str


class DuplicateSkill(Error, code="EZS230", name="duplicate-skill"):
    """Two skills or implementations of one name: SkiROS2 takes the one that it loads first, Python
    the last.
    """

    title = "there are two `{skill}`"
    note = "one hides the other: SkiROS2 looks skills and implementations up by their names alone"
    help = "give one of them another name"
    skill: str

    class Other(Remark):
        says = "the other one"

    class OfLibraries(Remark):
        says = (
            "give one of them another name: of two libraries SkiROS2 takes that of the first in "
            "`libraries_list`"
        )


ALL: tuple[type[Template], ...] = (
    NoDescription,
    NoAnnotation,
    TextAnnotation,
    NoParameterType,
    WrongDefault,
    ThingDefault,
    MarkedBasic,
    TwoKinds,
    PackedParameters,
    ReplacedConditions,
    NoClass,
    NoRelation,
    NoConditions,
    UnknownParameter,
    NoSelf,
    AddedOtherwise,
    Raised,
    SideEffect,
    NeverEnds,
    DependsOnValue,
    TooManyPaths,
    DependsOnOutcome,
    DuplicateSkill,
)
