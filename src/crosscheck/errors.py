"""CHK0xx to CHK3xx: findings that need both the rules and the skills."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class NoSkills(Error, code="CHK001", name="no-skills"):
    """Rules that name no skills file, so that crosscheck has no skills to check."""

    title = "{rules} names no skills file"
    label = "these rules do not import skills"
    help = 'write `skills "skills.json";`, and create the file with `ezskiros export`'
    rules: str


class ExemptionWithoutTree(Warning, code="CHK101", name="exemption-without-tree"):
    """An exemption for a skill that no tree uses."""

    title = "`{rule}` has an exemption for `{skill}`, which no tree uses"
    label = "this exemption is for `{skill}`"
    help = "delete the exemption, unless an operator or another node starts `{skill}` alone"
    skill: str
    rule: str

    class Described(Remark):
        says = "the skill is described here, and no tree uses the skill"


class WiderThanPermitted(Error, code="CHK102", name="wider-than-permitted"):
    """An exemption that lets a skill do more than its description permits."""

    title = "`{rule}` lets `{skill}` do more than its description permits"
    label = "no rule acts on {shown} while `{skill}` runs"
    help = "act on this in the exemption: `unless doing {skill} then if ... {limit} then {{ ... }}`"
    rule: str
    skill: str
    shown: str
    limit: str

    class Permitted(Remark):
        says = "the skill permits only this"


class NotPermitted(Error, code="CHK103", name="not-permitted"):
    """An exemption for a skill whose description has no such permission."""

    title = "`{rule}` limits {kind}, but `{skill}` permits no {kind}"
    label = "`{rule}` is not applied while `{skill}` runs"
    help = "add `self.permits += {example}` to the description, or delete this exemption"
    rule: str
    skill: str
    kind: str
    example: str

    class Described(Remark):
        says = "this description permits no {kind}"
        kind: str


class NotGranted(Warning, code="CHK104", name="not-granted"):
    """A permission that rules do not grant: they act below its limit."""

    title = "`{skill}` permits {permission}, but `{rule}` acts on {condition}"
    label = "the rules do not grant this"
    help = "add the exemption `unless doing {skill} then ...` to `{rule}`, or delete the permission"
    skill: str
    permission: str
    rule: str
    condition: str

    class Acting(Remark):
        says = "this rule acts while `{skill}` runs"
        skill: str


class NeverInScene(Warning, code="CHK105", name="never-in-this-scene"):
    """A query about an individual of a class that has no member in the scene."""

    title = "`{query}` is never true in this scene"
    label = "the scene has no individual of the class that `{parameter}` needs"
    query: str
    parameter: str

    class Others(Remark):
        says = (
            "in this scene `{parameter}` can be {known}; query one of these, or add an individual"
        )
        parameter: str
        known: str


class NoNumberInScene(Warning, code="CHK106", name="number-not-in-scene"):
    """An individual of the scene without a number that a rule reads while a skill uses the
    individual.
    """

    title = "{individual} {problem} {property}, so {rules} {hold} while `{skill}` uses it"
    label = "{rules} cannot read {property} of this individual"
    help = "add one numeric {property} to this individual, or query a class without this individual"
    individual: str
    problem: str
    property: str
    rules: str
    hold: str
    skill: str

    class Read(Remark):
        says = "this reads {query}, and is true if the value is unknown"
        query: str


class NeverWorks(Error, code="CHK201", name="skill-never-works"):
    """A skill that needs a resource that a rule takes away whenever the skill runs."""

    title = "`{skill}` can never work: `{rule}` is active whenever `{skill}` runs"
    label = "this condition holds whenever `{skill}` runs, for all sensor values"
    help = "give `{rule}` a condition that can be false while `{skill}` runs"
    skill: str
    rule: str

    class Needed(Remark):
        says = "`{skill}` needs {resource}"
        skill: str
        resource: str

    class Taken(Remark):
        says = "`{action}` takes {resource} away"
        action: str
        resource: str


class RulesNeverLetWork(Error, code="CHK202", name="rules-never-let-work"):
    """A skill that needs a resource that one of several rules takes away whenever it runs."""

    title = "`{skill}` can never work: one of {rules} is active whenever `{skill}` runs"
    label = "`{skill}` needs {resource}"
    help = "change the conditions so that all these rules can be inactive while `{skill}` runs"
    skill: str
    rules: str
    resource: str

    class Active(Remark):
        says = "active in some of the cases"


class Fight(Warning, code="CHK203", name="rules-and-skills-fight"):
    """A rule that ends a skill and is cleared by its end, so that the skill restarts."""

    title = "`{rule}` and `{skill}` fight: `{rule}` ends `{skill}` again and again"
    label = "`{rule}` is active only while `{skill}` runs, and cleared as soon as `{skill}` ends"
    help = "clear `{rule}` later (`clear for 5 sec`, `latched until reset`)"
    rule: str
    skill: str

    class Ended(Remark):
        says = "`{action}` ends `{skill}`, which needs {resource}"
        action: str
        skill: str
        resource: str

    class Started(Remark):
        says = "the skill restarts here after a failure"


class NotAllAsked(Error, code="CHK204", name="not-all-asked"):
    """Queries that exceeded the time limit."""

    title = "the check of rules and skills did not finish within {seconds:g} s of processor time"
    label = "so there may be more findings"
    help = "split the rules into several files, and check each file"
    seconds: float


class NothingToTake(Warning, code="CHK205", name="nothing-to-take"):
    """Skills that need an individual of a class that has no member in the scene."""

    title = "{skills} cannot start in this scene: the scene has no {owl_class}"
    label = "this parameter needs a {owl_class}"
    help = "add a {owl_class} to the scene"
    skills: str
    owl_class: str

    class Needed(Remark):
        says = "this parameter needs it as well"


class TypesDiffer(Error, code="CHK301", name="topic-of-two-types"):
    """A topic or server that has different types in rules and skills."""

    title = "{resource} is {one} in the rules, but {other} in `{skill}`"
    label = "{other} here"
    help = "correct one of the types"
    resource: str
    one: str
    other: str
    skill: str

    class InRules(Remark):
        says = "{one} here"
        one: str


class NobodyReads(Warning, code="CHK302", name="nobody-reads"):
    """A topic that rules or skills publish, and that no node of the system model subscribes to."""

    title = "no node subscribes to {topic}"
    label = "this publishes to {topic}; no node of the system model subscribes"
    help = "correct the name, or declare the subscriber: `node NAME {{ subscribes {topic}; }}`"
    topic: str

    class Near(Remark):
        says = "did you mean `{near}`, to which `{node}` subscribes?"
        near: str
        node: str


class NoOntologyForScene(Error, code="CHK303", name="scene-without-ontology"):
    """A scene for skills whose ontology is missing or does not have a class of the scene."""

    title = "the classes of the scene are unknown: `{missing}` is not in the ontology"
    label = "no ontology of these skills has `{missing}`"
    note = "crosscheck reads the ontology files that the skills file lists as its sources"
    help = "create the file with `ezskiros export`, and keep the ontology files in place"
    missing: str


ALL: tuple[type[Template], ...] = (
    NoSkills,
    ExemptionWithoutTree,
    WiderThanPermitted,
    NotPermitted,
    NotGranted,
    NeverInScene,
    NoNumberInScene,
    NeverWorks,
    RulesNeverLetWork,
    Fight,
    NotAllAsked,
    NothingToTake,
    TypesDiffer,
    NobodyReads,
    NoOntologyForScene,
)
