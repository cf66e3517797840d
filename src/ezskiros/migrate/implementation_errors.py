"""EZS721 to EZS738: SkiROS2 implementations that cannot be translated, and the consequences."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class LeftToo(Remark):
    """The note with other classes that stay unchanged."""

    says = "for the same reason {names} {are} not translated"
    names: str
    are: str


class UnusableSkill(Error, code="EZS721", name="unusable-skill"):
    """An implementation of a skill whose description is missing or not translated."""

    title = "`{skill}`, which this class implements, is {found}"
    label = "an implementation derives from an EzSkiROS description"
    help = "give the file of its description as well"
    skill: str
    found: str


class UnusableChild(Error, code="EZS722", name="unusable-child"):
    """A child with no translated description, or with more than one."""

    title = "the child `{skill}` is {found}"
    label = "EzSkiROS trees refer to skills by their Python classes"
    help = "give exactly the files that define these skills"
    skill: str
    found: str


class SharedName(Error, code="EZS723", name="shared-name"):
    """A child parameter that is remapped to a key that cannot become a compound parameter."""

    title = "`{child}` shares `{key}`, which is not a parameter of `{skill}`"
    label = "{why}"
    note = "SkiROS2 creates a new parameter for any name, also for a misspelt one"
    help = 'declare the parameter: self.addParam("{key}", ..., ParamTypes.Optional) in `{skill}`'
    skill: str
    key: str
    child: str
    why: str = ""


class UnknownKey(Error, code="EZS724", name="unknown-key"):
    """A parameter that the description does not have."""

    title = "`{skill}` has no parameter `{key}`"
    note = "SkiROS2 fails here, or continues without a value"
    help = "{advice}"
    skill: str
    key: str
    advice: str = "use a declared parameter, or declare `{key}` in the description"


class TwiceGiven(Error, code="EZS725", name="twice-given"):
    """A child parameter that is both remapped and given a value."""

    title = "`{key}` is both renamed and given a value"
    note = "SkiROS2 renames first and drops a value for the old name"
    help = "use either `remap` or `specify`"
    key: str


class NoProcessor(Error, code="EZS726", name="no-processor"):
    """A processor that EzSkiROS does not have, or that is computed."""

    title = "EzSkiROS has no processor `{found}`"
    help = (
        "processors are Serial, SerialStar, Selector, SelectorStar, ParallelFf, ParallelFs, "
        "NoFail(...) and RetryOnFail(NUMBER)"
    )
    found: str


class OwnProcessor(Error, code="EZS727", name="own-processor"):
    """A compound skill that sets its own processor in `expand`."""

    title = "`self.setProcessor` does not set {found} for this tree"
    note = "SkiROS2 reads the processor earlier; this one only applies to the next task"
    help = "write `skill.setProcessor(...)`"
    found: str


class SeveralTrees(Error, code="EZS728", name="several-old-trees"):
    """A compound skill that adds children in several steps."""

    title = "children are added a second time"
    label = "an EzSkiROS tree is written in one call"
    help = "write all children in one call"


class QueriedIndividual(Error, code="EZS729", name="queried-individual"):
    """A tree that depends on the world."""

    title = "{found} queries the world model"
    label = "an EzSkiROS tree is built and checked without a world model"
    help = "use a child skill under a selector for this query, or a condition in the description"
    found: str


class NoTree(Error, code="EZS730", name="no-tree"):
    """Code in `expand` whose effect is only known while the robot runs."""

    title = "{found} cannot be part of a translated tree"
    help = (
        "use only self.skill(...), skill.setProcessor(...) and skill(...), and move code that "
        "needs the robot to a primitive skill"
    )
    found: str


class NoName(Error, code="EZS731", name="no-implementation-name"):
    """A label that is not a valid class name."""

    title = "`{found}` cannot be the name of an implementation"
    note = "in SkiROS2 the task hangs at this child, and so does every later task"
    help = "use the name of the implementing class, or leave the label empty"
    found: str


class ParameterUse(Error, code="EZS732", name="parameter-use"):
    """A use of a parameter beyond its value."""

    title = "{found} uses more of a parameter than its value"
    label = "EzSkiROS only gives the values: `self.params.Speed`"
    help = 'write self.params["KEY"].value to read and set the value'
    found: str


class OtherBase(Error, code="EZS733", name="other-base"):
    """An implementation that does not inherit from SkiROS2's own classes, or is inherited.

    Findings that follow from the class `base` are reported in its file `path`; without a file
    they are not reported.
    """

    title = "`{implementation}` {found}"
    label = "only classes that inherit from SkillBase or PrimitiveBase are translated"
    help = "{advice}"
    implementation: str
    found: str
    advice: str = "derive it and the related classes from `Skill.SkillBase` by hand"
    base: str = ""
    path: str = ""


class OtherDescription(Error, code="EZS734", name="other-description"):
    """An implementation that changes its description."""

    title = "{found} changes the description in an implementation"
    label = "in EzSkiROS an implementation can only add pre-conditions"
    help = "move it to the description, and keep only `self.setDescription(Skill(), ...)` here"
    found: str


class OfSkiros2(Warning, code="EZS735", name="of-skiros2"):
    """An attribute that only SkiROS2's own base classes have."""

    title = "`{found}` belongs to SkiROS2; EzSkiROS skills do not have it"
    label = "it is kept, and fails here in `ezskiros run`"
    help = "use parameters and conditions to access the world model"
    found: str


class AddedParameter(Warning, code="EZS736", name="added-parameter"):
    """A key that children share and that becomes a parameter of the description."""

    title = "children of `{skill}` share `{key}`, so `{skill}` gets it as a parameter"
    label = "for {sharing}"
    note = "in EzSkiROS, children share the parameters of the compound skill"
    help = 'if this is intended, declare it: self.addParam("{key}", {value}, ParamTypes.Optional)'
    skill: str
    key: str
    value: str
    sharing: str


class LeftWith(Warning, code="EZS737", name="left-with"):
    """Implementations that stay unchanged because their description does."""

    title = "{followers} {are} not translated because `{skill}` is not"
    label = "this description is not translated because of {codes}"
    note = "they implement `{skill}` or call it as a child"
    help = "correct {codes} and migrate again; this skill needs no other change"
    skill: str
    followers: str
    are: str
    codes: str


class LeftTogether(Warning, code="EZS738", name="left-together"):
    """Classes that stay unchanged because a class with the same base does."""

    title = "{followers} {are} not translated because `{other}` is not"
    label = "this class is not translated because of {codes}"
    note = "they share a base class, which cannot belong to both SkiROS2 and EzSkiROS"
    help = "correct {codes} and migrate again; the other classes need no other change"
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
    QueriedIndividual,
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
