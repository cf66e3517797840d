"""EZS2xx: skill descriptions and their parameters."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class HasKey(Remark):
    """The note with a parameter's key in SkiROS2."""

    says = "`{parameter}` has the key {key}"
    parameter: str
    key: str


class NoDescription(Error, code="EZS201", name="no-description"):
    """A skill without the method `description`."""

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
    """A quoted type that is not a Python expression."""

    title = "the type of `{parameter}` is a string: {text}"
    note = "the string is not a Python expression: {reason}"
    help = "write {example}, without quotes"
    parameter: str
    text: str
    reason: str
    example: str


class NoParameterType(Error, code="EZS204", name="no-parameter-type"):
    """A type that a skill parameter cannot have."""

    title = "a skill parameter cannot be {found}"
    label = "the type of `{parameter}`"
    note = (
        "the type of a parameter is a class of the ontology, str, int, float, bool or an "
        "enumeration; the checks cannot see the elements of a list or dictionary (thesis, "
        "Paper IV, section 6)"
    )
    help = "use one parameter per value, an enumeration, or a class of the ontology"
    parameter: str
    found: str


class WrongDefault(Error, code="EZS205", name="wrong-default"):
    """A default value of another type than the parameter."""

    title = "the default of `{parameter}` is {found}, not {expected}"
    help = "give a value of type {expected}, or no default"
    parameter: str
    found: str
    expected: str


class IndividualDefault(Error, code="EZS206", name="individual-default"):
    """A default for a parameter that stands for an individual of the world model."""

    title = "`{parameter}` stands for an individual of the world model and cannot have a default"
    help = "write `INFERRED[...]` to find it in the world model, `OPTIONAL[...]` to allow no value"
    parameter: str


class MarkedBasic(Error, code="EZS207", name="marked-basic"):
    """INFERRED or an option on a basic type."""

    title = "`{marker}` applies to individuals of the world model, not to {type}"
    label = "the type of `{parameter}`"
    help = "give `{parameter}` a default value, or remove `{marker}`"
    marker: str
    type: str
    parameter: str


class TwoKinds(Error, code="EZS216", name="two-kinds"):
    """A parameter that is both inferred and optional."""

    title = "`{parameter}` cannot be both INFERRED and OPTIONAL"
    label = "the type of `{parameter}`"
    help = "write `OPTIONAL[...]` if the skill works without a value, `INFERRED[...]` if not"
    parameter: str


class PackedParameters(Error, code="EZS208", name="packed-parameters"):
    """`*args` or `**kwargs` in a description."""

    title = "a skill has a fixed set of parameters, so `{spelling}` is not allowed"
    help = "write each parameter with its name and type"
    spelling: str


class ReplacedConditions(Error, code="EZS209", name="replaced-conditions"):
    """`=` instead of `+=`."""

    title = "`=` replaces `{conditions}` and discards the conditions in it"
    help = "add a condition: `self.{conditions} += ...`"
    conditions: str


class NoClass(Error, code="EZS210", name="no-class"):
    """`of_type` without a class."""

    title = "`of_type` needs a class of the ontology, not {found}"
    help = "write `of_type(Object, skiros.Product)`"
    found: str


class NoRelation(Error, code="EZS211", name="no-relation"):
    """`abstract` without a relation."""

    title = "`abstract` needs a relation, not {found}"
    help = "write `abstract(Robot.hasA(Arm))`"
    found: str


class NoConditions(Error, code="EZS212", name="no-conditions"):
    """An unknown kind of conditions."""

    title = "a skill has no attribute `{spelled}`"
    help = "did you mean `{meant}`?"
    spelled: str
    meant: str


class UnknownParameter(Error, code="EZS213", name="unknown-parameter"):
    """A name that is neither a parameter nor defined in the module."""

    title = "`{spelled}` is not a parameter of `{skill}`"
    label = "this name is not defined"
    spelled: str
    skill: str

    class Signature(Remark):
        says = "write `def {method}(self, {parameter}):`"
        method: str
        parameter: str


class NoSelf(Error, code="EZS214", name="no-self"):
    """A description without `self` as its first parameter."""

    title = "the first parameter of `description` must be `self`"
    help = "write `def description(self, ...):`"


class AddedOtherwise(Error, code="EZS215", name="added-otherwise"):
    """A call such as `append` instead of `+=`."""

    title = "`self.{conditions}` has no method `{spelled}`"
    help = "write `self.{conditions} += ...`, one line per item"
    spelled: str
    conditions: str


class Raised(Error, code="EZS220", name="description-raised"):
    """A method that raises an exception."""

    title = "{method} raises {exception}"
    label = "{said}"
    method: str
    exception: str
    said: str

    class Added(Remark):
        says = "write `self.{conditions} += ...`"
        conditions: str


class SideEffect(Error, code="EZS221", name="side-effect"):
    """A method with a side effect during the check."""

    title = "{method} {deed}"
    label = "skipped: a check has no side effects"
    help = "{advice}"
    method: str
    advice: str
    deed: str


class NeverEnds(Error, code="EZS222", name="never-ends"):
    """A method that runs for too long."""

    title = "{method} does not end within {seconds} s"
    label = "it was still running here"
    method: str
    seconds: float


class DependsOnValue(Error, code="EZS223", name="depends-on-value"):
    """Conditions that depend on the value of a parameter."""

    title = "the conditions of `{skill}` depend on the value of `{parameter}`"
    label = "the decision is here"
    note = "SkiROS2 reads a description once, before any parameter has a value"
    help = "write two skills, or conditions that hold for every value"
    skill: str
    parameter: str


class TooManyPaths(Warning, code="EZS224", name="too-many-paths"):
    """A method with more paths than the check follows."""

    title = "{method} branches so often that only {count} paths are checked"
    help = "remove branches that do not change the result"
    method: str
    count: int


class DependsOnOutcome(Error, code="EZS225", name="depends-on-outcome"):
    """Conditions that depend on a call that the check skips."""

    title = "the conditions of `{skill}` depend on the result of `{call}`"
    label = "the decision is here"
    note = "a check skips calls with side effects, so the result is unknown before the robot runs"
    help = "write two skills, add a parameter, or write conditions that always hold"
    skill: str
    call: str


class DuplicateSkill(Error, code="EZS230", name="duplicate-skill"):
    """Two skills or implementations with the same name.

    SkiROS2 takes the first that it loads, Python the last.
    """

    title = "`{skill}` is defined twice"
    note = "one hides the other: SkiROS2 looks up skills and implementations only by name"
    help = "rename one of them"
    skill: str

    class Other(Remark):
        says = "the other definition"

    class OfLibraries(Remark):
        says = (
            "rename one of them: SkiROS2 takes the definition of the library that comes first in "
            "`libraries_list`"
        )


ALL: tuple[type[Template], ...] = (
    NoDescription,
    NoAnnotation,
    TextAnnotation,
    NoParameterType,
    WrongDefault,
    IndividualDefault,
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
