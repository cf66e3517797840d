"""EZS5xx: children of behavior trees that do not match the skills they call."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class NotImplementedAnywhere(Warning, code="EZS520", name="not-implemented"):
    """A child whose skill has no implementation in the checked files."""

    title = "no checked file implements `{skill}`"
    note = "in SkiROS2 the tree starts, and stops with an error at this child"
    help = "check the file of an implementation of `{skill}` as well"
    skill: str


class UnknownImplementation(Error, code="EZS521", name="unknown-implementation"):
    """A child that requires a missing implementation."""

    title = "`{skill}` has no implementation `{spelled}`"
    note = "in SkiROS2 the task hangs at this child, and so does every later task"
    skill: str
    spelled: str

    class Near(Remark):
        says = "the name is used here"

    class Known(Remark):
        says = "`{skill}` has the implementations {known}"
        skill: str
        known: str


class NativeImplementation(Error, code="EZS562", name="native-implementation"):
    """An implementation for SkiROS2 itself that a checked tree needs."""

    title = "`{implementation}` implements `{skill}` only for plain SkiROS2"
    label = "checked trees need this implementation"
    note = "SkiROS2 cannot load it, because the description is now written in EzSkiROS"
    help = "derive it from `{skill}.SkillBase`; a comment by `ezskiros migrate` may give the reason"
    implementation: str
    skill: str


class OtherSkillsImplementation(Error, code="EZS522", name="other-skills-implementation"):
    """A child that requires an implementation of another skill."""

    title = "`{spelled}` implements `{owner}`, not `{skill}`"
    help = "to run this implementation, write `{owner}.{spelled}(...)`"
    spelled: str
    skill: str
    owner: str


class UnknownArgument(Error, code="EZS523", name="unknown-argument"):
    """An argument for a parameter that the skill does not have."""

    title = "`{skill}` has no parameter `{spelled}`"
    skill: str
    spelled: str

    class Known(Remark):
        says = "the skill has {known}"
        known: str


class WrongArgument(Error, code="EZS524", name="wrong-argument"):
    """A value of another type than the parameter."""

    title = "`{parameter}` has type {wanted} but gets {found}"
    help = "give a value of type {wanted}"
    parameter: str
    wanted: str
    found: str


class NoIndividualGiven(Error, code="EZS525", name="no-individual-given"):
    """A value for a parameter that stands for an individual."""

    title = "`{parameter}` stands for a {wanted} but gets {found}"
    help = "pass a parameter of this skill: `{parameter}=params.Name`"
    parameter: str
    wanted: str
    found: str


class PassedMisfit(Error, code="EZS526", name="passed-misfit"):
    """A parameter of the compound skill whose class does not match the child's parameter."""

    title = "`{given}` is a {found}, but `{parameter}` of the child is a {wanted}"
    given: str
    found: str
    parameter: str
    wanted: str


class PassedMayNotFit(Warning, code="EZS527", name="passed-may-not-fit"):
    """A parameter of the compound skill whose class may not match the child's parameter."""

    title = "`{given}` is a {found}, but `{parameter}` needs a {wanted}: it may not be one"
    help = "declare `{given}: {wanted}`"
    given: str
    found: str
    parameter: str
    wanted: str


class PassedLacksProperty(Error, code="EZS561", name="passed-lacks-property"):
    """A parameter of the compound skill for which a pre-condition of the child never holds."""

    title = "`{given}` is a {found}, for which `{condition}` of `{skill}` never holds"
    note = "in the ontology, {property} is a property of a {wanted}"
    help = "declare `{given}: {wanted}`, or call a skill without this pre-condition"
    given: str
    found: str
    skill: str
    condition: str
    property: str
    wanted: str

    class Condition(Remark):
        says = "the pre-condition is here"


class NameClash(Error, code="EZS528", name="name-clash"):
    """Two children whose shared parameter name has different classes."""

    title = "`{shared}` is a {one} for one child and a {other} for another"
    note = "children share parameters of the same name that no argument sets"
    help = "pass a separate value to each child: `{shared}=params.Name`"
    shared: str
    one: str
    other: str


class SameIndividualTwice(Warning, code="EZS529", name="same-individual-twice"):
    """Two parameters of a child with the same individual."""

    title = "`{one}` and `{other}` of `{skill}` are both `{shared}`"
    note = "SkiROS2 passes only the first of them"
    skill: str
    one: str
    other: str
    shared: str


class MissingArgument(Error, code="EZS530", name="missing-argument"):
    """A required parameter without a value."""

    title = "`{skill}` needs a value for `{parameter}`, but nothing provides one"
    note = "in SkiROS2 the skill runs without a value, or takes the first individual of the class"
    help = "write `{parameter}=...`"
    skill: str
    parameter: str


class NotWrittenOnAllPaths(Error, code="EZS531", name="not-written-on-all-paths"):
    """A parameter that has no value on some path through the tree."""

    title = "`{skill}` needs a value for `{parameter}`, which is missing on some paths"
    help = "put the child that sets the value before this one, where it must succeed"
    skill: str
    parameter: str

    class Writer(Remark):
        says = "this child sets the value, but does not run on every path"


class ReadBesides(Error, code="EZS532", name="read-besides"):
    """A value that one child of a parallel reads while another one computes it."""

    title = "`{skill}` needs `{parameter}` while `{writer}` is still computing it"
    help = "run them one after the other: `self.serialstar(...)`"
    skill: str
    parameter: str
    writer: str

    class Writer(Remark):
        says = "this child sets the value at the same time"


class WrittenNeverRead(Warning, code="EZS533", name="written-never-read"):
    """An output that is not used."""

    title = "the output `{parameter}` of `{skill}` is not used"
    skill: str
    parameter: str


class OutputMissing(Error, code="EZS534", name="output-missing"):
    """An output of the compound skill that has no value on some path to its success."""

    title = "the output `{parameter}` of `{skill}` has no value on some paths to its success"
    help = "on each path, let a child set it: `Child({parameter}=params.{parameter})`"
    skill: str
    parameter: str


class OwnNamePassed(Warning, code="EZS535", name="own-name-passed"):
    """An argument with the name of another parameter of the child."""

    title = "`{parameter}` of `{skill}` gets `{shared}`, but `{skill}` has its own `{shared}`"
    note = "SkiROS2 does not pass it and logs `target key is already present`"
    help = "rename one of them, or use the same parameter name in both skills"
    skill: str
    parameter: str
    shared: str


class WrittenBesides(Error, code="EZS536", name="written-besides"):
    """A value that two children of a parallel set at the same time."""

    title = "two children set `{shared}` at the same time"
    note = "the child that finishes last determines the value"
    help = "give each child its own parameter, or run them one after the other"
    shared: str

    class Other(Remark):
        says = "this child sets it as well"


class MayBeNothing(Error, code="EZS537", name="may-be-nothing"):
    """An optional parameter of the compound skill for a child that needs a value."""

    title = "`{skill}` needs a value for `{parameter}`, but `{given}` may have none"
    help = "test it first: `if params.{given}:`"
    skill: str
    parameter: str
    given: str

    class Optional(Remark):
        says = "declared as optional here"


class NoState(Error, code="EZS540", name="no-state"):
    """An `execute` that returns an object other than a state."""

    title = "`{method}` of `{implementation}` returns {found}"
    note = "in SkiROS2 the task ends here with a ValueError"
    help = "return `self.success(...)`, `self.step(...)` or `self.fail(..., -1)`"
    implementation: str
    method: str
    found: str


class NoTruth(Error, code="EZS541", name="no-truth"):
    """An `onStart` or `onEnd` that does not return True."""

    title = "`{method}` of `{implementation}` returns {found}, which counts as a failure"
    help = "return `True` on success"
    implementation: str
    method: str
    found: str


class NothingToDo(Error, code="EZS542", name="nothing-to-do"):
    """An implementation with neither `expandBT` nor `execute`."""

    title = "`{implementation}` does nothing: it has neither `expandBT` nor `execute`"
    note = "in SkiROS2 the skill runs forever"
    help = "write `def expandBT(self, params):` for a behavior tree, otherwise `def execute(self):`"
    implementation: str

    class Migrate(Remark):
        says = "`ezskiros migrate` translates it"


class NeverCalled(Warning, code="EZS564", name="never-called"):
    """A method with a misspelt name, or with a SkiROS2 name that EzSkiROS does not call."""

    title = "nothing calls `{method}` of `{implementation}`"
    note = "the skill runs without this method, also in SkiROS2"
    implementation: str
    method: str

    class SkillBase(Remark):
        says = "delete it: `Skill.SkillBase` already names the skill"

    class OwnConditions(Remark):
        says = "add pre-conditions in `def {method}(self, Parameter):`"
        method: str

    class Tree(Remark):
        says = "write the tree in `def expandBT(self, params):`"


class WrongProgress(Error, code="EZS547", name="wrong-progress"):
    """`success`, `step` or `fail` with an argument of the wrong type."""

    title = "`{method}` gets {found}, but expects {wanted}"
    note = "in SkiROS2 the task ends here with an AssertionError"
    help = 'write `self.success("a text")`, `self.fail("a text", -1)`'
    method: str
    found: str
    wanted: str


class NeverSucceeds(Warning, code="EZS543", name="never-succeeds"):
    """A behavior tree that has no path to success."""

    title = "`{implementation}` never succeeds: it fails, or runs until it is stopped"
    implementation: str

    class Root(Remark):
        says = "this never succeeds"


class NeverReached(Error, code="EZS544", name="never-reached"):
    """A child that never starts."""

    title = "this is never reached: the child before it never {result}"
    result: str

    class Before(Remark):
        says = "this never {result}"
        result: str


class StartedAgain(Warning, code="EZS545", name="started-again"):
    """A child of a Serial that takes several ticks, after another such child."""

    title = "this may never end: the child before it restarts at each tick"
    note = "at each tick a Serial begins with its first child and stops the later ones"
    help = "write `self.serialstar(...)`, which continues with the current child"

    class Before(Remark):
        says = "this restarts at each tick"


class EndlessRecursion(Error, code="EZS546", name="endless-recursion"):
    """A compound skill that cannot succeed without calling itself."""

    title = "`{implementation}` calls itself endlessly: {path}"
    help = "add a path through the tree without this call"
    implementation: str
    path: str

    class Calls(Remark):
        says = "this is the next call"


ALL: tuple[type[Template], ...] = (
    NotImplementedAnywhere,
    UnknownImplementation,
    NativeImplementation,
    OtherSkillsImplementation,
    UnknownArgument,
    WrongArgument,
    NoIndividualGiven,
    PassedMisfit,
    PassedMayNotFit,
    PassedLacksProperty,
    NameClash,
    SameIndividualTwice,
    MissingArgument,
    NotWrittenOnAllPaths,
    ReadBesides,
    WrittenNeverRead,
    OutputMissing,
    OwnNamePassed,
    WrittenBesides,
    MayBeNothing,
    NoState,
    NoTruth,
    NothingToDo,
    NeverCalled,
    WrongProgress,
    NeverSucceeds,
    NeverReached,
    StartedAgain,
    EndlessRecursion,
)
