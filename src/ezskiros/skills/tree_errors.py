"""EZS5xx: behavior trees, as they are written."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class Signature(Remark):
    """The help for the signature of an implementation's own conditions."""

    says = (
        "write `def {method}(self, {parameter}):`: the parameters of the skill have their own names"
    )
    method: str
    parameter: str


class NoChildren(Error, code="EZS501", name="no-children"):
    """A processor over nothing."""

    title = "{processor} has no children"
    note = "in SkiROS2 a skill without children runs forever"
    help = "name the skills that it consists of: `self.serialstar(Drive(...), Pick(...))`"
    processor: str


class NoNode(Error, code="EZS502", name="no-node"):
    """A child that is no skill, processor or decorator."""

    title = "a behavior tree consists of skills, and this is {found}"
    help = "write `Skill(Parameter=...)`, `Skill.implementation(...)` or `self.serialstar(...)`"
    found: str

    class Quoted(Remark):
        says = "write `{skill}(...)`: skills are named without quotes"
        skill: str

    class SkillClass(Remark):
        says = "write `{skill}(...)`"
        skill: str

    class List(Remark):
        says = "write `*[...]`, with an asterisk: children are given one by one"

    class Call(Remark):
        says = "call it: a tree consists of what the calls give"


class WrongLimit(Error, code="EZS503", name="wrong-limit"):
    """A number of tries or seconds that is none."""

    title = "{decorator} needs a {numbers} above 0, not {found}"
    help = "write `self.retry(child, 3)` or `self.timeout(child, 5.0)`"
    decorator: str
    numbers: str
    found: str


class NoSkillBase(Error, code="EZS504", name="no-skill-base"):
    """A class that is derived from something of a skill that is not there."""

    title = "`{skill}` has no `{spelled}` that a class can be derived from"
    help = "write `class name({skill}.SkillBase):`"
    skill: str
    spelled: str


class NamelessArgument(Error, code="EZS505", name="nameless-argument"):
    """A value for a parameter that is not named."""

    title = "`{skill}` gets a value without the name of its parameter"
    help = "write `{skill}({named})`"
    skill: str
    named: str


class LooseSkill(Error, code="EZS506", name="loose-skill"):
    """A skill, or a part of a tree, that is written down and not part of the tree."""

    title = "this is no part of the behavior tree of `{implementation}`"
    note = "a skill that stands alone is never run"
    help = "make it a child of a processor: `self.serialstar(...)`; a tree has one processor on top"
    implementation: str


class EmptyTree(Error, code="EZS507", name="empty-tree"):
    """An `expandBT` that builds nothing."""

    title = "`{implementation}` has no behavior tree"
    note = "in SkiROS2 a skill without children runs forever"
    help = "write the tree: `self.serialstar(Drive(...), Pick(...))`"
    implementation: str

    class Branch(Remark):
        says = "where this is {answer}"
        answer: str

    class Generator(Remark):
        says = "leave out `yield`: what `expandBT` calls is the tree"


class NoSuchParameter(Error, code="EZS508", name="no-such-parameter"):
    """A parameter of an implementation that the description of its skill does not have."""

    title = "`{skill}` has no parameter `{spelled}`"
    skill: str
    spelled: str


class NoSkillImplemented(Error, code="EZS509", name="no-skill-implemented"):
    """An implementation of which nobody knows the skill."""

    title = "it is not known which skill `{implementation}` implements"
    help = (
        "derive it from the base of a skill, `class name(Pick.SkillBase):`, "
        "and call nothing in it `description`"
    )
    implementation: str


class UnknownSkill(Error, code="EZS510", name="unknown-skill"):
    """A name in a behavior tree that is defined nowhere."""

    title = "`{spelled}` is not defined"
    note = "in SkiROS2 a skill that is not there ends the task when it gets to this tree"
    spelled: str

    class Processor(Remark):
        says = "write `self.{processor}(...)`"
        processor: str

    class Import(Remark):
        says = "import it: `from {module} import {skill}`"
        module: str
        skill: str


class ImplementationNamed(Error, code="EZS515", name="implementation-named"):
    """An implementation that is named like a skill."""

    title = "`{implementation}` is an implementation: a behavior tree names its skill"
    help = "write `{skill}(...)`, or `{skill}.{implementation}(...)` if it has to be this one"
    implementation: str
    skill: str


class ComparedByIdentity(Error, code="EZS516", name="compared-by-identity"):
    """A parameter of the compound that is compared by `is`."""

    title = "`{spelled}` is the same whatever the parameter is"
    note = "`is` asks whether two names are one object, and `params` has what stands for parameters"
    help = "write `==` for a value, `if params.Name:` for a thing that may be there"
    spelled: str


class NoParams(Error, code="EZS517", name="no-params"):
    """An `expandBT` that does not take what it is given."""

    title = "`expandBT` of `{implementation}` does not take the parameters of its skill"
    help = "write `def expandBT(self, params):`"
    implementation: str


class DescriptionImplemented(Error, code="EZS518", name="description-implemented"):
    """A class that is derived from a description, and that has the methods of an implementation."""

    title = (
        "`{implementation}` is a description, and has the method `{method}` of an implementation"
    )
    note = "what is derived from a description is another description: its methods are never run"
    help = "write `class {implementation}({skill}.SkillBase):`"
    implementation: str
    method: str
    skill: str


class UnknownProcessor(Error, code="EZS519", name="unknown-processor"):
    """Something of `self` in `expandBT` that is not there."""

    title = "`{implementation}` has no `{spelled}` while its behavior tree is built"
    implementation: str
    spelled: str

    class Params(Remark):
        says = "`expandBT` gets the parameters: write `params.Name`"

    class Skill(Remark):
        says = "a child is called by the name of its skill: `Drive(Target=params.Place)`"

    class OtherName(Remark):
        says = "write `self.{processor}(...)`"
        processor: str

    class Known(Remark):
        says = "there is {known}"
        known: str


class WrongMakerCall(Error, code="EZS538", name="wrong-processor-call"):
    """A processor or a decorator that gets arguments that it does not have."""

    title = "`self.{maker}` {problem}"
    note = "a value for a skill stands in the call of the skill: `Push(Force=params.Force)`"
    help = "write `{call}`"
    maker: str
    problem: str
    call: str


class OnlyPreConditions(Error, code="EZS563", name="only-pre-conditions"):
    """A hold- or post-condition that an implementation adds."""

    title = "an implementation adds pre-conditions only, and this is one of `self.{spelled}`"
    note = "a tree that names the skill counts on what the description says, whoever does it"
    help = "write it in the description of `{skill}`"
    spelled: str
    skill: str


class NoOwnConditions(Warning, code="EZS565", name="no-own-conditions"):
    """A method `conditions` that adds none."""

    title = "`conditions` of `{implementation}` adds no pre-condition"
    help = "write `self.pre_conditions += ...`, or leave out the method"
    implementation: str

    class Generator(Remark):
        says = "leave out `yield`: the method is called, and nobody asks for what it yields"

    class Coroutine(Remark):
        says = "leave out `async`: the method is called, and not awaited"


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
