"""EZS5xx: the form of behavior trees."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class Signature(Remark):
    """The help for the signature of the method `conditions`."""

    says = "write `def {method}(self, {parameter}):`, with the parameter names of the skill"
    method: str
    parameter: str


class NoChildren(Error, code="EZS501", name="no-children"):
    """A processor without children."""

    title = "{processor} has no children"
    note = "in SkiROS2 a skill without children runs forever"
    help = "add the child skills: `self.serialstar(Drive(...), Pick(...))`"
    processor: str


class NoNode(Error, code="EZS502", name="no-node"):
    """A child that is neither a skill nor a processor nor a decorator."""

    title = "a child of a behavior tree must be a skill or a processor, not {found}"
    help = "write `Skill(Parameter=...)`, `Skill.implementation(...)` or `self.serialstar(...)`"
    found: str

    class Quoted(Remark):
        says = "write `{skill}(...)`, without quotes"
        skill: str

    class SkillClass(Remark):
        says = "write `{skill}(...)`"
        skill: str

    class List(Remark):
        says = "write `*[...]`, with an asterisk, to pass each element as a child"

    class Call(Remark):
        says = "call it: the children of a tree are the results of calls"


class WrongLimit(Error, code="EZS503", name="wrong-limit"):
    """A wrong number of tries or seconds."""

    title = "{decorator} needs a {numbers} above 0, not {found}"
    help = "write `self.retry(child, 3)` or `self.timeout(child, 5.0)`"
    decorator: str
    numbers: str
    found: str


class NoSkillBase(Error, code="EZS504", name="no-skill-base"):
    """A class that is derived from a missing attribute of a skill."""

    title = "`{skill}` has no base class `{spelled}`"
    help = "write `class name({skill}.SkillBase):`"
    skill: str
    spelled: str


class NamelessArgument(Error, code="EZS505", name="nameless-argument"):
    """An argument without the name of its parameter."""

    title = "an argument of `{skill}` does not name its parameter"
    help = "write `{skill}({named})`"
    skill: str
    named: str


class LooseSkill(Error, code="EZS506", name="loose-skill"):
    """A skill or subtree that is created in `expandBT` but not part of the tree."""

    title = "this is not part of the behavior tree of `{implementation}`"
    note = "a skill outside the tree never runs"
    help = "make it a child of a processor: `self.serialstar(...)`; a tree has one root"
    implementation: str


class EmptyTree(Error, code="EZS507", name="empty-tree"):
    """An `expandBT` that builds no tree."""

    title = "`{implementation}` has no behavior tree"
    note = "in SkiROS2 a skill without children runs forever"
    help = "write the tree: `self.serialstar(Drive(...), Pick(...))`"
    implementation: str

    class Branch(Remark):
        says = "on the path where this is {answer}"
        answer: str

    class Generator(Remark):
        says = "remove `yield`: the calls in `expandBT` build the tree"


class NoSuchParameter(Error, code="EZS508", name="no-such-parameter"):
    """A parameter in an implementation that the skill's description does not have."""

    title = "`{skill}` has no parameter `{spelled}`"
    skill: str
    spelled: str


class NoSkillImplemented(Error, code="EZS509", name="no-skill-implemented"):
    """An implementation whose skill is unknown."""

    title = "the skill that `{implementation}` implements is unknown"
    help = (
        "derive it from the base class of a skill, `class name(Pick.SkillBase):`, "
        "and name nothing in it `description`"
    )
    implementation: str


class UnknownSkill(Error, code="EZS510", name="unknown-skill"):
    """An undefined name in a behavior tree."""

    title = "`{spelled}` is not defined"
    note = "in SkiROS2 the task ends with an error when it reaches a missing skill"
    spelled: str

    class Processor(Remark):
        says = "write `self.{processor}(...)`"
        processor: str

    class Import(Remark):
        says = "import it: `from {module} import {skill}`"
        module: str
        skill: str


class ImplementationNamed(Error, code="EZS515", name="implementation-named"):
    """An implementation with the name of a skill."""

    title = "`{implementation}` is an implementation; a behavior tree calls the skill"
    help = "write `{skill}(...)`, or `{skill}.{implementation}(...)` to require this implementation"
    implementation: str
    skill: str


class ComparedByIdentity(Error, code="EZS516", name="compared-by-identity"):
    """A comparison by `is` with a parameter of the compound skill."""

    title = "`{spelled}` does not depend on the value of the parameter"
    note = "`is` compares object identity, and `params` contains placeholders"
    help = "write `==` to compare a value, `if params.Name:` to test for an individual"
    spelled: str


class NoParams(Error, code="EZS517", name="no-params"):
    """An `expandBT` without the argument `params`."""

    title = "`expandBT` of `{implementation}` does not accept the argument `params`"
    help = "write `def expandBT(self, params):`"
    implementation: str


class DescriptionImplemented(Error, code="EZS518", name="description-implemented"):
    """A class that is derived from a description but has methods of an implementation."""

    title = "`{implementation}` is a description but has the implementation method `{method}`"
    note = "a class derived from a description is a description, and its methods never run"
    help = "write `class {implementation}({skill}.SkillBase):`"
    implementation: str
    method: str
    skill: str


class UnknownProcessor(Error, code="EZS519", name="unknown-processor"):
    """An attribute of `self` in `expandBT` that does not exist."""

    title = "`{implementation}` has no `{spelled}` in `expandBT`"
    implementation: str
    spelled: str

    class Params(Remark):
        says = "`expandBT` has the parameters in `params`: write `params.Name`"

    class Skill(Remark):
        says = "call a child by the name of its skill: `Drive(Target=params.Place)`"

    class OtherName(Remark):
        says = "write `self.{processor}(...)`"
        processor: str

    class Known(Remark):
        says = "`self` has {known}"
        known: str


class WrongMakerCall(Error, code="EZS538", name="wrong-processor-call"):
    """A processor or a decorator with wrong arguments."""

    title = "`self.{maker}` {problem}"
    note = "pass a value for a skill in the call of the skill: `Push(Force=params.Force)`"
    help = "write `{call}`"
    maker: str
    problem: str
    call: str


class OnlyPreConditions(Error, code="EZS563", name="only-pre-conditions"):
    """A hold- or post-condition that an implementation adds."""

    title = "an implementation can only add pre-conditions, not `self.{spelled}`"
    note = "a tree that calls the skill relies on its description for every implementation"
    help = "move the condition to the description of `{skill}`"
    spelled: str
    skill: str


class NoOwnConditions(Warning, code="EZS565", name="no-own-conditions"):
    """A method `conditions` that adds no pre-condition."""

    title = "`conditions` of `{implementation}` adds no pre-condition"
    help = "write `self.pre_conditions += ...`, or delete the method"
    implementation: str

    class Generator(Remark):
        says = "remove `yield`: yielded values are ignored"

    class Coroutine(Remark):
        says = "remove `async`: the method is called without `await`"


ALL: tuple[type[Template], ...] = (
    NoChildren,
    NoNode,
    WrongLimit,
    NoSkillBase,
    NamelessArgument,
    LooseSkill,
    EmptyTree,
    NoSuchParameter,
    NoSkillImplemented,
    UnknownSkill,
    ImplementationNamed,
    ComparedByIdentity,
    NoParams,
    DescriptionImplemented,
    UnknownProcessor,
    WrongMakerCall,
    OnlyPreConditions,
    NoOwnConditions,
)
