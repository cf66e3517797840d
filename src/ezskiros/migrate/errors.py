"""EZS701 to EZS720: SkiROS2 descriptions that cannot be translated and stay unchanged."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dslkit.diagnostics import Error, Template, Warning

if TYPE_CHECKING:  # the catalog of all diagnostics does not need it
    import libcst


class LeftError(Exception):
    """Part of a skill has no translation: `template` gives the reason, `node` is the part."""

    def __init__(self, template: Template, node: libcst.CSTNode) -> None:
        super().__init__(template.code)
        self.template, self.node = template, node


class UnreadableSource(Error, code="EZS701", name="unreadable-source"):
    """A file that is not Python 3."""

    title = "this is not valid Python 3: {said}"
    note = "the file stays unchanged"
    help = "convert Python 2 files with `2to3` first"
    said: str


class ComputedArgument(Error, code="EZS702", name="computed-argument"):
    """A key, a relation or a Boolean that is not a literal."""

    title = "`{argument}` of `{call}` is computed"
    label = "its value is not visible here"
    help = "write {wanted} as a literal"
    argument: str
    call: str
    wanted: str


class UntypedParameter(Error, code="EZS704", name="untyped-parameter"):
    """A parameter with a type that EzSkiROS does not have."""

    title = "the parameter `{key}` is {found}, and EzSkiROS has no type for it"
    note = (
        "the type of a parameter is a class of the ontology, str, int, float, bool or an "
        "enumeration; the checks cannot see the elements of a list or dictionary (thesis, "
        "Paper IV, section 6)"
    )
    help = "use one parameter per value, an enumeration, or a class of the ontology"
    key: str
    found: str


class NoKind(Error, code="EZS705", name="no-parameter-kind"):
    """A parameter kind that SkiROS2 does not have, or that is computed."""

    title = "SkiROS2 has no parameter kind `{found}`"
    help = "write ParamTypes.Required, ParamTypes.Optional or ParamTypes.Inferred"
    found: str


class InferredBasic(Error, code="EZS706", name="inferred-basic"):
    """An inferred parameter with a basic type."""

    title = "`{key}` is inferred, but SkiROS2 only infers individuals of the world model"
    help = "use ParamTypes.Required with the default, or ParamTypes.Optional"
    key: str


class ParticularElement(Error, code="EZS707", name="particular-element"):
    """An element with a label or identifier, or without a class."""

    title = "the parameter `{key}` stands for {found}"
    label = "a parameter of EzSkiROS only has a class"
    help = "write `Element(CLASS)`, and pass the label or identifier when calling the skill"
    key: str
    found: str


class NoOption(Error, code="EZS708", name="no-parameter-option"):
    """An option that SkiROS2 does not have, or that is computed."""

    title = "SkiROS2 has no parameter option `{found}`"
    help = "write a list of Consume, Output, Unspecify, Lock and RespectType"
    found: str


class RepeatedParameter(Error, code="EZS709", name="repeated-parameter"):
    """A parameter that is declared twice."""

    title = "the parameter `{key}` is declared twice"
    note = "SkiROS2 silently uses the last declaration"
    help = "keep only one declaration"
    key: str


class UnknownStatement(Error, code="EZS710", name="unknown-statement"):
    """A statement that is neither a parameter nor a condition."""

    title = "{found} cannot be part of a translated description"
    label = "only parameters and conditions are translated"
    help = "use only addParam, addPreCondition, addHoldCondition and addPostCondition"
    found: str


class NotAnIndividual(Error, code="EZS711", name="not-an-individual"):
    """A condition about a parameter that does not stand for an individual."""

    title = "a condition uses `{key}`, which {found}"
    note = "SkiROS2 would fail when the skill starts"
    help = "declare `{key}` as `Element(...)`, or use another parameter"
    key: str
    found: str


class NoOperator(Error, code="EZS712", name="no-operator"):
    """A comparison that SkiROS2 does not know."""

    title = "SkiROS2 has no operator `{found}`"
    note = "SkiROS2 would fail when the skill starts"
    help = "the operators are =, <, >, <= and >=; negate with False as the last argument"
    found: str


class NoNamespace(Error, code="EZS713", name="no-namespace"):
    """A name that is in no namespace of a loaded ontology."""

    title = "`{found}` is not a class or property of a loaded ontology"
    label = "EzSkiROS has no Python name for it"
    help = "use a name such as `skiros:Product`"
    found: str


class UntypedValue(Error, code="EZS714", name="untyped-value"):
    """A property that is compared with an object that is not a value."""

    title = "a property cannot have the value {found}"
    help = "compare with a string, a number or a Boolean"
    found: str


class UnusableOr(Error, code="EZS715", name="unusable-or"):
    """An `or` that `|` cannot express."""

    title = "this `or` {found}"
    help = "build it from two or more conditions, then add it to the description"
    found: str


class DerivedDescription(Error, code="EZS716", name="derived-description"):
    """A description that inherits from another one, or is inherited."""

    title = "`{skill}` {found}"
    label = "translate both classes by hand"
    help = "write all parameters and conditions into each description"
    skill: str
    found: str


class IgnoredOptions(Warning, code="EZS717", name="ignored-options"):
    """Options of a parameter that does not stand for an individual."""

    title = "the options of `{key}` are dropped: SkiROS2 ignores them"
    label = "options are for parameters that stand for individuals"
    key: str


class WrongArguments(Error, code="EZS718", name="wrong-arguments"):
    """A call with arguments that SkiROS2 would refuse, or with packed arguments."""

    title = "`{call}` is called with wrong arguments"
    help = "write {call}({wanted})"
    call: str
    wanted: str


class EmptyKey(Error, code="EZS719", name="empty-key"):
    """A parameter whose key is an empty string."""

    title = "the key of a parameter is empty"
    help = "give the parameter a key, here and in each skill that uses it"


class LeftOutput(Warning, code="EZS720", name="left-output"):
    """The option Output on a parameter that cannot be an output."""

    title = "the option Output of `{key}` is dropped: SkiROS2 ignores it"
    note = "an output of EzSkiROS is optional and has no default and no other option"
    help = "use ParamTypes.Optional without a default if the skill sets the value"
    key: str


ALL: tuple[type[Template], ...] = (
    UnreadableSource,
    ComputedArgument,
    UntypedParameter,
    NoKind,
    InferredBasic,
    ParticularElement,
    NoOption,
    RepeatedParameter,
    UnknownStatement,
    NotAnIndividual,
    NoOperator,
    NoNamespace,
    UntypedValue,
    UnusableOr,
    DerivedDescription,
    IgnoredOptions,
    WrongArguments,
    EmptyKey,
    LeftOutput,
)
