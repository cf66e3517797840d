"""CHK2xx: findings on behavior trees that rules run."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class TreeHindered(Error, code="CHK206", name="tree-hindered-by-its-rule"):
    """A behavior tree that needs a resource that its own rule takes away."""

    title = "`{rule}` runs `{tree}` but takes {resource} away from it"
    label = "this action is in force while `{tree}` runs"
    help = "move this action to another rule, or after the tree"
    rule: str
    tree: str
    resource: str

    class Runs(Remark):
        says = "`{tree}` runs here"
        tree: str

    class Needed(Remark):
        says = "`{skill}` needs {resource}"
        skill: str
        resource: str


class NeededHere(Remark):
    """The label of a condition of a tree, or of a skill that continues."""

    says = "`{skill}` needs this"
    skill: str


class KnownHere(Remark):
    """The label of a condition that holds while a skill runs."""

    says = "this holds while `{skill}` runs"
    skill: str


class EndedHere(Remark):
    """The label of a post-condition that may end a needed condition."""

    says = "`{skill}` may end this condition"
    skill: str


class TreeNeverStarts(Error, code="CHK207", name="tree-never-starts"):
    """A tree with a condition that is false when its rule becomes active."""

    title = "`{tree}` can never start: `{condition}` is false when `{rule}` becomes active"
    label = "`{rule}` runs `{tree}` here"
    help = "run another tree, or delete the condition from `{tree}`"
    rule: str
    tree: str
    condition: str


class TreeMayNotStart(Warning, code="CHK208", name="tree-may-not-start"):
    """A tree with a condition that nothing ensures when its rule becomes active."""

    title = "`{tree}` may not start: nothing ensures that `{condition}` holds"
    label = "`{rule}` runs `{tree}` here, {running}"
    help = "query a skill with this condition in `{rule}`, or delete the condition from `{tree}`"
    rule: str
    tree: str
    condition: str
    running: str


class NoDeadline(Warning, code="CHK209", name="step-without-deadline"):
    """A step without its own deadline in a behavior tree with several steps that need time."""

    title = "`{step}` has no deadline in `{tree}`: it can use all {within} that `{rule}` allows"
    label = "no `timeout` contains this step"
    note = "the other steps then have no time left"
    help = "limit its time: `self.timeout({step}(...), SECONDS)`"
    step: str
    tree: str
    rule: str
    within: str

    class Runs(Remark):
        says = "`{tree}` has {within} here"
        tree: str
        within: str


class DeadlinesTooLong(Error, code="CHK210", name="deadlines-too-long"):
    """A behavior tree whose deadlines add up to more time than the rule allows."""

    title = "the deadlines in `{tree}` add up to {most}, but `{rule}` allows {within}"
    label = "the rule stops the tree after {within}"
    help = "allow the tree more time, or its steps less"
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
    """A skill that a tree interrupts and that may be unable to restart after the tree."""

    title = "after `{tree}`, `{skill}` may not restart: `{condition}` need not hold"
    label = "`{afterwards}` restarts `{skill}`"
    help = "use `replan` instead, or add this condition to `{tree}` as a post-condition"
    tree: str
    skill: str
    condition: str
    afterwards: str


class NoValueForTree(Warning, code="CHK212", name="tree-without-value"):
    """A tree that takes a value from a skill that may not be running."""

    title = "`{rule}` may become active while `{skill}` is not running"
    label = "then `{tree}` has no values: the goal is refused, and `else` takes effect"
    help = "add `and doing {skill}` to the condition of `{rule}`"
    rule: str
    tree: str
    skill: str


class ConditionsUnknown(Warning, code="CHK213", name="conditions-without-ontology"):
    """Trees whose conditions cannot be checked: their ontology or a condition is unreadable."""

    title = "the conditions of trees are not checked: {reason}"
    label = "the conditions of trees come from these skills"
    help = "create this file with `ezskiros export`, and keep the ontology files in place"
    reason: str


class EndsItsTree(Warning, code="CHK214", name="rule-ends-its-tree"):
    """A rule whose condition becomes false as soon as its tree starts."""

    title = "`{rule}` runs `{tree}` and ends it at once: `{skill}` does not run meanwhile"
    label = "this is false as soon as `{tree}` starts, and the tree ends with the rule"
    help = "write `clear when doing {skill}`, so that the rule lasts until the task continues"
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
