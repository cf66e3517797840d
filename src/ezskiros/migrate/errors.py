"""EZS701 to EZS720: descriptions of SkiROS2 that cannot be translated, and are left as they are."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dslkit.diagnostics import Error, Template, Warning

if TYPE_CHECKING:  # the catalog of all diagnostics does without it
    import libcst


class LeftError(Exception):
    """Part of a skill has no translation: `template` says why, `node` is the part."""

    def __init__(self, template: Template, node: libcst.CSTNode) -> None:
        super().__init__(template.code)
        self.template, self.node = template, node


class UnreadableSource(Error, code="EZS701", name="unreadable-source"):
    """A file that is not Python 3."""

    title = "this is not Python 3: {said}"
    note = "the file is left as it is"
    help = "files for Python 2 can be turned into Python 3 by `2to3` first"
    said: str


class ComputedArgument(Error, code="EZS702", name="computed-argument"):
    """A key, a relation or a truth value that is no literal."""

    title = "`{argument}` of `{call}` is computed"
    label = "what it is cannot be read here"
    help = "write {wanted} itself"
    argument: str
    call: str
    wanted: str


class UntypedParameter(Error, code="EZS704", name="untyped-parameter"):
    """A value whose type parameters of EzSkiROS cannot have."""

    title = "the parameter `{key}` is {found}, which EzSkiROS has no type for"
    note = (
        "parameters are things of the ontology, str, int, float, bool or enumerations; lists and "
        "dictionaries would hide from every check what is in them (thesis, Paper IV, section 6)"
    )
    help = "use one parameter for each value, an enumeration, or a class of the ontology"
    key: str
    found: str


class NoKind(Error, code="EZS705", name="no-parameter-kind"):
    """A type of parameter that SkiROS2 does not have, or that is computed."""

    title = "`{found}` is no type of parameter that SkiROS2 has"
    help = "write ParamTypes.Required, ParamTypes.Optional or ParamTypes.Inferred"
    found: str


class InferredBasic(Error, code="EZS706", name="inferred-basic"):
    """An inferred parameter that is no thing."""

    title = "`{key}` is inferred, but SkiROS2 infers only things of the world"
    help = "make it ParamTypes.Required, with its default, or ParamTypes.Optional"
    key: str


class ParticularElement(Error, code="EZS707", name="particular-element"):
    """An element that is more than a class, or less."""

    title = "the parameter `{key}` stands for {found}"
    label = "EzSkiROS knows parameters by their class alone"
    help = "write `Element(CLASS)`, and give the label or identifier where the skill is used"
    key: str
    found: str


class NoOption(Error, code="EZS708", name="no-parameter-option"):
    """An option that SkiROS2 does not have, or that is computed."""

    title = "`{found}` is no option of parameters that SkiROS2 has"
    help = "options are Consume, Output, Unspecify, Lock and RespectType, in a list"
    found: str


class RepeatedParameter(Error, code="EZS709", name="repeated-parameter"):
    """A parameter that is declared twice."""

    title = "the parameter `{key}` is declared twice"
    note = "SkiROS2 silently takes the last declaration"
    help = "leave one of them"
    key: str


class UnknownStatement(Error, code="EZS710", name="unknown-statement"):
    """Something that is neither a parameter nor a condition."""

    title = "{found} cannot be part of a translated description"
    label = "only parameters and conditions are translated"
    help = "write it with addParam, addPreCondition, addHoldCondition and addPostCondition"
    found: str


class NotAThing(Error, code="EZS711", name="not-a-thing"):
    """A condition about a parameter that does not stand for a thing."""

    title = "a condition is about `{key}`, which {found}"
    note = "SkiROS2 would fail when the skill starts"
    help = "declare it as `Element(...)`, or name another parameter"
    key: str
    found: str


class NoOperator(Error, code="EZS712", name="no-operator"):
    """A comparison that SkiROS2 does not know."""

    title = "`{found}` is no operator that SkiROS2 has"
    note = "SkiROS2 would fail when the skill starts"
    help = "operators are =, <, >, <= and >=; for an opposite the last argument is False"
    found: str


class NoNamespace(Error, code="EZS713", name="no-namespace"):
    """A name that is in no namespace of an ontology for robots."""

    title = "`{found}` is no class or property of a loaded ontology"
    label = "EzSkiROS has no Python name for it"
    help = "use a name such as `skiros:Product`"
    found: str


class UntypedValue(Error, code="EZS714", name="untyped-value"):
    """A property that is compared with something that is no value."""

    title = "{found} is no value that a property is known to have"
    help = "compare with a text, a number or a truth value"
    found: str


class UnusableOr(Error, code="EZS715", name="unusable-or"):
    """An `or` that `|` cannot say."""

    title = "this `or` {found}"
    help = "build it from two or more conditions, then add it to the description"
    found: str


class DerivedDescription(Error, code="EZS716", name="derived-description"):
    """A description that is built on another one, or the one that it is built on."""

    title = "`{skill}` {found}"
    label = "the two can only be translated together, by hand"
    help = "write all parameters and conditions into each description"
    skill: str
    found: str


class IgnoredOptions(Warning, code="EZS717", name="ignored-options"):
    """Options of a parameter that is no thing."""

    title = "the options of `{key}` are left out: SkiROS2 ignores them"
    label = "options are for parameters that stand for things"
    key: str


class WrongArguments(Error, code="EZS718", name="wrong-arguments"):
    """A call that SkiROS2 would refuse, or whose arguments are packed."""

    title = "`{call}` is called with other arguments than it has"
    help = "write {call}({wanted})"
    call: str
    wanted: str


class EmptyKey(Error, code="EZS719", name="empty-key"):
    """A parameter whose key is an empty text."""

    title = "the key of a parameter is empty"
    help = "give it a key that says what it is, here and in each skill that uses it"


class LeftOutput(Warning, code="EZS720", name="left-output"):
    """The option Output of a parameter that cannot be one."""

    title = "the option Output of `{key}` is left out: SkiROS2 ignores it"
    note = "an output of EzSkiROS is optional, and has no default and no other option"
    help = "make it ParamTypes.Optional, without a default, if the skill gives it its value"
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
    NotAThing,
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
