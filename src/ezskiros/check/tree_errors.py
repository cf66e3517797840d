"""EZS5xx: children of behavior trees against the skills that they name."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class NotImplementedAnywhere(Warning, code="EZS520", name="not-implemented"):
    """A child of which no implementation is among the files that are checked."""

    title = "nothing that is checked here implements `{skill}`"
    note = "in SkiROS2 the tree starts and stops with an error when it gets there"
    help = "name the files of its implementations, too"
    skill: str


class UnknownImplementation(Error, code="EZS521", name="unknown-implementation"):
    """A child that asks for an implementation that is not there."""

    title = "`{skill}` has no implementation `{spelled}`"
    note = "in SkiROS2 the task hangs when the tree gets there, and every later one with it"
    skill: str
    spelled: str

    class Near(Remark):
        says = "it is written here"

    class Known(Remark):
        says = "`{skill}` is implemented by {known}"
        skill: str
        known: str


class NativeImplementation(Error, code="EZS562", name="native-implementation"):
    """An implementation that trees need, and that is written for SkiROS2 itself."""

    title = "`{implementation}` implements `{skill}` for SkiROS2 alone"
    label = "trees that are checked here need it"
    note = "SkiROS2 cannot load it: the description is none of its own any more"
    help = "derive it from `{skill}.SkillBase`; if a migration has left it, a comment says why"
    implementation: str
    skill: str


class OtherSkillsImplementation(Error, code="EZS522", name="other-skills-implementation"):
    """A child that asks for the implementation of another skill."""

    title = "`{spelled}` implements `{owner}`, not `{skill}`"
    help = "write `{owner}.{spelled}(...)` if that is meant"
    spelled: str
    skill: str
    owner: str


class UnknownArgument(Error, code="EZS523", name="unknown-argument"):
    """A value for a parameter that the skill does not have."""

    title = "`{skill}` has no parameter `{spelled}`"
    skill: str
    spelled: str

    class Known(Remark):
        says = "it has {known}"
        known: str


class WrongArgument(Error, code="EZS524", name="wrong-argument"):
    """A value of another type than the parameter."""

    title = "`{parameter}` is of type {wanted}, and gets {found}"
    help = "give a value of type {wanted}"
    parameter: str
    wanted: str
    found: str


class NoThingGiven(Error, code="EZS525", name="no-thing-given"):
    """A value for a parameter that stands for a thing."""

    title = "`{parameter}` stands for a {wanted}, and gets {found}"
    help = "pass a parameter of this skill: `{parameter}=params.Name`"
    parameter: str
    wanted: str
    found: str


class PassedMisfit(Error, code="EZS526", name="passed-misfit"):
    """A parameter of the compound that cannot be what the child needs."""

    title = "`{given}` is a {found}, but `{parameter}` of the child is a {wanted}"
    given: str
    found: str
    parameter: str
    wanted: str


class PassedMayNotFit(Warning, code="EZS527", name="passed-may-not-fit"):
    """A parameter of the compound that may be what the child needs."""

    title = "`{given}` is a {found}, and not each is a {wanted} as `{parameter}` of the child is"
    help = "declare `{given}: {wanted}`"
    given: str
    found: str
    parameter: str
    wanted: str


class PassedLacksProperty(Error, code="EZS561", name="passed-lacks-property"):
    """A parameter of the compound with which a pre-condition of the child never holds."""

    title = "`{given}` is a {found}, and `{condition}` of `{skill}` never holds of one"
    note = "the ontology says that {property} is of a {wanted}"
    help = "declare `{given}: {wanted}`, or call a skill without this pre-condition"
    given: str
    found: str
    skill: str
    condition: str
    property: str
    wanted: str

    class Condition(Remark):
        says = "asked here"


class NameClash(Error, code="EZS528", name="name-clash"):
    """Two children that share a name, and that need different kinds of things under it."""

    title = "`{shared}` is a {one} for one child, and a {other} for another"
    note = "parameters of one name that are given nothing are the same in all children"
    help = "pass each child its own: `{shared}=params.Name`"
    shared: str
    one: str
    other: str


class SameThingTwice(Warning, code="EZS529", name="same-thing-twice"):
    """Two parameters of a child that get the same thing."""

    title = "`{one}` and `{other}` of `{skill}` are both `{shared}`"
    note = "SkiROS2 passes on the first of them only"
    skill: str
    one: str
    other: str
    shared: str


class MissingArgument(Error, code="EZS530", name="missing-argument"):
    """A parameter that has to have a value, and gets none."""

    title = "`{skill}` needs a value for `{parameter}`, and nobody gives it one"
    note = "in SkiROS2 it runs without one, or takes the first thing of its class that it finds"
    help = "write `{parameter}=...`"
    skill: str
    parameter: str


class NotWrittenOnAllWays(Error, code="EZS531", name="not-written-on-all-ways"):
    """A parameter that has no value on some way through the tree."""

    title = "`{skill}` needs a value for `{parameter}`, which it does not have on all ways here"
    help = "let what gives it a value come first, and succeed"
    skill: str
    parameter: str

    class Writer(Remark):
        says = "this gives it a value, if it gets there"


class ReadBesides(Error, code="EZS532", name="read-besides"):
    """A value that one child of a parallel needs while another one finds it out."""

    title = "`{skill}` needs `{parameter}` while `{writer}` is still finding it out"
    help = "run them one after the other: `self.serialstar(...)`"
    skill: str
    parameter: str
    writer: str

    class Writer(Remark):
        says = "this gives it its value, at the same time"


class WrittenNeverRead(Warning, code="EZS533", name="written-never-read"):
    """An output that nobody uses."""

    title = "nobody uses `{parameter}`, which `{skill}` finds out"
    skill: str
    parameter: str


class OutputMissing(Error, code="EZS534", name="output-missing"):
    """An output of the compound skill that has no value on some way to its success."""

    title = "`{skill}` finds out `{parameter}`, which has no value on all ways to its end"
    help = "let each way have a child that finds it out: `Child({parameter}=params.{parameter})`"
    skill: str
    parameter: str


class OwnNamePassed(Warning, code="EZS535", name="own-name-passed"):
    """A child is passed something with the name of another parameter of the child."""

    title = "`{parameter}` of `{skill}` is `{shared}`, and `{skill}` has a `{shared}` of its own"
    note = "SkiROS2 does not pass it on: `target key is already present`, says its log"
    help = "give one of them another name, or the skills a parameter of the same name"
    skill: str
    parameter: str
    shared: str


class WrittenBesides(Error, code="EZS536", name="written-besides"):
    """A value that two children of a parallel find out at the same time."""

    title = "two children find out `{shared}` at the same time"
    note = "which of the values stays depends on who is last"
    help = "pass each its own, or run them one after the other"
    shared: str

    class Other(Remark):
        says = "this does so as well"


class MayBeNothing(Error, code="EZS537", name="may-be-nothing"):
    """An optional parameter of the compound is passed to a child that needs a value."""

    title = "`{skill}` needs a value for `{parameter}`, and `{given}` may have none"
    help = "ask for it before: `if params.{given}:`"
    skill: str
    parameter: str
    given: str

    class Optional(Remark):
        says = "declared as optional here"


class NoState(Error, code="EZS540", name="no-state"):
    """An `execute` that returns something else than a state."""

    title = "`{method}` of `{implementation}` returns {found}"
    note = "in SkiROS2 the task ends with a ValueError when it gets there"
    help = "return `self.success(...)`, `self.step(...)` or `self.fail(..., -1)`"
    implementation: str
    method: str
    found: str


class NoTruth(Error, code="EZS541", name="no-truth"):
    """An `onStart` or `onEnd` that does not say whether it succeeded."""

    title = "`{method}` of `{implementation}` returns {found}, which counts as a failure"
    help = "return `True` if it succeeded"
    implementation: str
    method: str
    found: str


class NothingToDo(Error, code="EZS542", name="nothing-to-do"):
    """An implementation that neither expands nor executes."""

    title = "`{implementation}` does nothing: it has neither `expandBT` nor `execute`"
    note = "in SkiROS2 it runs forever"
    help = "write `def expandBT(self, params):` for a behavior tree, `def execute(self):` else"
    implementation: str

    class Migrate(Remark):
        says = "`ezskiros migrate` translates it"


class NeverCalled(Warning, code="EZS564", name="never-called"):
    """A method whose name is nearly that of one that is called, or is one of SkiROS2."""

    title = "nothing calls `{method}` of `{implementation}`"
    note = "the skill runs without it, in SkiROS2 as well"
    implementation: str
    method: str

    class SkillBase(Remark):
        says = "delete it: `Skill.SkillBase` says which skill it is"

    class OwnConditions(Remark):
        says = "add pre-conditions in `def {method}(self, Parameter):`"
        method: str

    class Tree(Remark):
        says = "write the tree in `def expandBT(self, params):`"


class WrongProgress(Error, code="EZS547", name="wrong-progress"):
    """`success`, `step` or `fail` is given something that it cannot say."""

    title = "`{method}` gets {found}, where {wanted} is expected"
    note = "in SkiROS2 the task ends with an AssertionError when it gets there"
    help = 'write `self.success("a text")`, `self.fail("a text", -1)`'
    method: str
    found: str
    wanted: str


class NeverSucceeds(Warning, code="EZS543", name="never-succeeds"):
    """A behavior tree that no way through leads to a success."""

    title = "`{implementation}` never succeeds: it fails, or runs until it is stopped"
    implementation: str

    class Root(Remark):
        says = "this never succeeds"


class NeverReached(Error, code="EZS544", name="never-reached"):
    """A child that is never started."""

    title = "this is never reached: what comes before it never {result}"
    result: str

    class Before(Remark):
        says = "this never {result}"
        result: str


class StartedAgain(Warning, code="EZS545", name="started-again"):
    """A child of a Serial that takes time, after another one that does."""

    title = "this may never end: what comes before it is started again at each tick"
    note = "a Serial begins with its first child at each tick, and stops the later ones meanwhile"
    help = "write `self.serialstar(...)`, which goes on where it is"

    class Before(Remark):
        says = "this is started again at each tick"


class EndlessRecursion(Error, code="EZS546", name="endless-recursion"):
    """A compound skill that cannot succeed without calling itself."""

    title = "`{implementation}` calls itself without end: {way}"
    help = "let one way through the tree end without it"
    implementation: str
    way: str

    class Calls(Remark):
        says = "which calls this"


ALL: tuple[type[Template], ...] = (
    NotImplementedAnywhere,
    UnknownImplementation,
    NativeImplementation,
    OtherSkillsImplementation,
    UnknownArgument,
    WrongArgument,
    NoThingGiven,
    PassedMisfit,
    PassedMayNotFit,
    PassedLacksProperty,
    NameClash,
    SameThingTwice,
    MissingArgument,
    NotWrittenOnAllWays,
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
