"""EZS721 to EZS738: implementations of SkiROS2 that cannot be translated, and what follows."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class LeftToo(Remark):
    """The note that tells what else is left as it is."""

    says = "for the same reason {names} {are} left"
    names: str
    are: str


class UnusableSkill(Error, code="EZS721", name="unusable-skill"):
    """An implementation of a skill whose description is not translated, or not there."""

    title = "`{skill}`, which this implements, is {found}"
    label = "implementations are derived from a description of EzSkiROS"
    help = "name the file of its description, too"
    skill: str
    found: str


class UnusableChild(Error, code="EZS722", name="unusable-child"):
    """A child of which no description is translated, or more than one."""

    title = "the child `{skill}` is {found}"
    label = "trees of EzSkiROS name skills by their Python classes"
    help = "name the files that it takes, and only these"
    skill: str
    found: str


class SharedName(Error, code="EZS723", name="shared-name"):
    """A child whose parameter is renamed to something that cannot become one of the compound."""

    title = "`{child}` shares `{key}`, which is no parameter of `{skill}`"
    label = "{why}"
    note = "SkiROS2 makes a new name for any text that it is given, also for a misspelt one"
    help = 'declare it: self.addParam("{key}", ..., ParamTypes.Optional) in `{skill}`'
    skill: str
    key: str
    child: str
    why: str = ""


class UnknownKey(Error, code="EZS724", name="unknown-key"):
    """A parameter that is used, and that the description does not have."""

    title = "`{skill}` has no parameter `{key}`"
    note = "SkiROS2 fails, or goes on without a value, when the skill gets there"
    help = "{advice}"
    skill: str
    key: str
    advice: str = "name one that it has, or declare this one in its description"


class TwiceGiven(Error, code="EZS725", name="twice-given"):
    """A parameter of a child that is renamed and gets a value."""

    title = "`{key}` is both renamed and given a value"
    note = "SkiROS2 renames first: a value for the old name is lost"
    help = "write it in `remap` or in `specify`"
    key: str


class NoProcessor(Error, code="EZS726", name="no-processor"):
    """A processor that EzSkiROS does not have, or that is computed."""

    title = "`{found}` is no processor that EzSkiROS has"
    help = (
        "processors are Serial, SerialStar, Selector, SelectorStar, ParallelFf, ParallelFs, "
        "NoFail(...) and RetryOnFail(NUMBER)"
    )
    found: str


class OwnProcessor(Error, code="EZS727", name="own-processor"):
    """A compound that chooses its own processor while it is expanded."""

    title = "`self.setProcessor` does not choose {found} for this tree"
    note = "SkiROS2 has taken the processor before: this one is for the next task, if any"
    help = "write `skill.setProcessor(...)`"
    found: str


class SeveralTrees(Error, code="EZS728", name="several-old-trees"):
    """A compound that adds children in several steps."""

    title = "children are added once more"
    label = "a tree of EzSkiROS is written in one step"
    help = "write all children in one call"


class AskedThing(Error, code="EZS729", name="asked-thing"):
    """A tree that depends on the world."""

    title = "{found} asks a thing of the world"
    label = "a tree of EzSkiROS is known, and checked, before there is a world"
    help = "let a child ask, under a selector, or say it in a condition of the description"
    found: str


class NoTree(Error, code="EZS730", name="no-tree"):
    """Something in `expand` that is known only while the robot runs, or that nobody knows."""

    title = "{found} cannot be part of a translated tree"
    help = (
        "write it with self.skill(...), skill.setProcessor(...) and skill(...), and move what "
        "needs the robot to a primitive skill"
    )
    found: str


class NoName(Error, code="EZS731", name="no-implementation-name"):
    """A label that is no name of a class."""

    title = "no implementation can be called `{found}`"
    note = "in SkiROS2 the task hangs when the tree gets there, and every later one with it"
    help = "name the class that implements it, or leave the label empty"
    found: str


class ParameterUse(Error, code="EZS732", name="parameter-use"):
    """A parameter that is used otherwise than by its value."""

    title = "{found} uses more of a parameter than its value"
    label = "EzSkiROS has the values alone: `self.params.Speed`"
    help = 'write self.params["KEY"].value, also to set it'
    found: str


class OtherBase(Error, code="EZS733", name="other-base"):
    """An implementation that is built on another class than SkiROS2's own, or below one.

    What follows from a class `base` of the file `path` is reported there; without a file it is
    nowhere.
    """

    title = "`{implementation}` {found}"
    label = "only what is derived from SkillBase or PrimitiveBase in the end is translated"
    help = "{advice}"
    implementation: str
    found: str
    advice: str = "derive it from `Skill.SkillBase` by hand, with the classes around it"
    base: str = ""
    path: str = ""


class OtherDescription(Error, code="EZS734", name="other-description"):
    """An implementation that changes its description."""

    title = "{found} changes what an implementation says of its skill"
    label = "in EzSkiROS an implementation adds pre-conditions, and nothing else"
    help = "write it into the description; leave `self.setDescription(Skill(), ...)` alone here"
    found: str


class OfSkiros2(Warning, code="EZS735", name="of-skiros2"):
    """Something that only SkiROS2's own base classes have."""

    title = "`{found}` is of SkiROS2, and skills of EzSkiROS do not have it"
    label = "it stays, and fails when `ezskiros run` gets there"
    help = "use parameters and conditions for what the skill knows of the world"
    found: str


class AddedParameter(Warning, code="EZS736", name="added-parameter"):
    """A key that children share, which a description gets as a parameter."""

    title = "`{skill}` gets the parameter `{key}`, since it does not declare what children share"
    label = "for {sharing}"
    note = "in EzSkiROS children share parameters of the compound"
    help = 'declare it, if it is meant: self.addParam("{key}", {value}, ParamTypes.Optional)'
    skill: str
    key: str
    value: str
    sharing: str


class LeftWith(Warning, code="EZS737", name="left-with"):
    """Implementations that are left since a description is."""

    title = "{followers} {are} left with `{skill}`"
    label = "this description is left for {codes}"
    note = "they implement it, or have it as a child"
    help = "change what {codes} tells, and migrate again: nothing else is needed for this skill"
    skill: str
    followers: str
    are: str
    codes: str


class LeftTogether(Warning, code="EZS738", name="left-together"):
    """Classes that are left since another one is that is built on the same base."""

    title = "{followers} {are} left with `{other}`"
    label = "this class is left for {codes}"
    note = "they are built on the same base, which cannot be of SkiROS2 and of EzSkiROS"
    help = "change what {codes} tells, and migrate again: nothing else is needed for the others"
    followers: str
    are: str
    other: str
    codes: str


ALL: tuple[type[Template], ...] = (
    UnusableSkill,
    UnusableChild,
    SharedName,
    UnknownKey,
    TwiceGiven,
    NoProcessor,
    OwnProcessor,
    SeveralTrees,
    AskedThing,
    NoTree,
    NoName,
    ParameterUse,
    OtherBase,
    OtherDescription,
    OfSkiros2,
    AddedParameter,
    LeftWith,
    LeftTogether,
)
