"""CHK2xx: findings on the behavior trees that rules run."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class TreeHindered(Error, code="CHK206", name="tree-hindered-by-its-rule"):
    """A behavior tree that needs something that the rule which runs it takes away meanwhile."""

    title = "`{rule}` takes {thing} away from `{tree}`, which it runs"
    label = "in force while `{tree}` runs"
    help = "let another rule do this, or do it after the tree"
    rule: str
    tree: str
    thing: str

    class Runs(Remark):
        says = "`{tree}` runs here"
        tree: str

    class Needed(Remark):
        says = "`{skill}` needs {thing}"
        skill: str
        thing: str


class NeededHere(Remark):
    """A condition of a tree, or of a skill that goes on."""

    says = "`{skill}` needs this"
    skill: str


class KnownHere(Remark):
    """A condition of a skill that runs."""

    says = "this holds while `{skill}` runs"
    skill: str


class EndedHere(Remark):
    """A post-condition that ends what is needed."""

    says = "`{skill}` may end that"
    skill: str


class TreeNeverStarts(Error, code="CHK207", name="tree-never-starts"):
    """A tree with a condition that is false when its rule becomes active."""

    title = "`{tree}` can never start: `{condition}` is false when `{rule}` becomes active"
    label = "`{rule}` runs `{tree}` here"
    help = "run another tree, or take the condition out of `{tree}`"
    rule: str
    tree: str
    condition: str


class TreeMayNotStart(Warning, code="CHK208", name="tree-may-not-start"):
    """A tree with a condition that nothing says to hold when its rule becomes active."""

    title = "`{tree}` may not start: nothing says that `{condition}` holds"
    label = "`{rule}` runs `{tree}` here, {running}"
    help = "let `{rule}` ask for a skill that has this condition, or take it out of `{tree}`"
    rule: str
    tree: str
    condition: str
    running: str


class NoDeadline(Warning, code="CHK209", name="step-without-deadline"):
    """A step of a behavior tree that only the rule bounds, beside others that need time as well."""

    title = "`{step}` has no deadline in `{tree}`: it can use up the {within} that `{rule}` gives"
    label = "no `timeout` stands over this"
    note = "the other steps then have no time left"
    help = "say how long it may take: `self.timeout({step}(...), SECONDS)`"
    step: str
    tree: str
    rule: str
    within: str

    class Runs(Remark):
        says = "`{tree}` has {within} here"
        tree: str
        within: str


class DeadlinesTooLong(Error, code="CHK210", name="deadlines-too-long"):
    """A behavior tree whose deadlines add up to more than the time that the rule gives."""

    title = "the deadlines in `{tree}` add up to {most}, and `{rule}` gives it {within}"
    label = "after {within} the tree is stopped"
    help = "give the tree more time, or its steps less"
    tree: str
    rule: str
    most: str
    within: str

    class Stands(Remark):
        says = "`{tree}` is described here"
        tree: str

    class Parts(Remark):
        says = "{most} = {parts}"
        most: str
        parts: str


class MayNotGoOn(Warning, code="CHK211", name="task-may-not-go-on"):
    """A skill that a tree interrupts, and that cannot start again after the tree."""

    title = "after `{tree}`, `{skill}` may not start again: `{condition}` need not hold"
    label = "`{afterwards}` starts `{skill}` again"
    help = "go on by `replan`, or let `{tree}` have this as a post-condition"
    tree: str
    skill: str
    condition: str
    afterwards: str


class NoValueForTree(Warning, code="CHK212", name="tree-without-value"):
    """A tree that takes a value from a skill that need not run."""

    title = "`{rule}` may become active while `{skill}` does not run"
    label = "`{tree}` has no values then: the goal is refused, and `else` answers"
    help = "add `and doing {skill}` to the condition of `{rule}`"
    rule: str
    tree: str
    skill: str


class ConditionsUnknown(Warning, code="CHK213", name="conditions-without-ontology"):
    """Trees whose conditions cannot be looked at: their ontology, or a condition, is unreadable."""

    title = "the conditions of trees are not checked: {reason}"
    label = "these skills say what trees need"
    help = "write this file with `ezskiros export`, beside the ontology"
    reason: str


class EndsItsTree(Warning, code="CHK214", name="rule-ends-its-tree"):
    """A rule whose condition is false as soon as its tree has begun."""

    title = "`{rule}` ends `{tree}`, which it runs: `{skill}` does not run meanwhile"
    label = "this is false as soon as `{tree}` has begun, and the tree ends with the rule"
    help = "write `clear when doing {skill}`: the rule lasts until the task goes on"
    rule: str
    tree: str
    skill: str

    class Runs(Remark):
        says = "`{tree}` runs here"
        tree: str


ALL: tuple[type[Template], ...] = (
    TreeHindered,
    TreeNeverStarts,
    TreeMayNotStart,
    NoDeadline,
    DeadlinesTooLong,
    MayNotGoOn,
    NoValueForTree,
    ConditionsUnknown,
    EndsItsTree,
)
