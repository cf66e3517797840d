"""CHK0xx to CHK3xx: findings that only rules and skills together show."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class NoSkills(Error, code="CHK001", name="no-skills"):
    """Rules that name no file of skills, so that there is nothing to check."""

    title = "{rules} names no file of skills"
    label = "these rules know no skills"
    help = 'write `skills "skills.json";`, and the file with `ezskiros export`'
    rules: str


class ExemptionWithoutTree(Warning, code="CHK101", name="exemption-without-tree"):
    """An exemption for a skill that is in no tree."""

    title = "no tree uses `{skill}`, for which `{rule}` has an exemption"
    label = "this exemption is for `{skill}`"
    help = "take the exemption out, unless somebody starts `{skill}` by itself"
    skill: str
    rule: str

    class Described(Remark):
        says = "it is described here, and no tree has it"


class WiderThanPermitted(Error, code="CHK102", name="wider-than-permitted"):
    """An exemption that lets a skill do more than its description permits."""

    title = "`{rule}` lets `{skill}` do more than its description permits"
    label = "nothing acts on {shown} while `{skill}` runs"
    help = "act on it in this exemption: `unless doing {skill} then if ... {limit} then {{ ... }}`"
    rule: str
    skill: str
    shown: str
    limit: str

    class Permitted(Remark):
        says = "this is all that it permits"


class NotPermitted(Error, code="CHK103", name="not-permitted"):
    """An exemption for a skill whose description has no such permission."""

    title = "`{rule}` is about {kind}, and `{skill}` permits none"
    label = "it is not applied while `{skill}` runs"
    help = "let the description permit it, as in `self.permits += {example}`, or take this out"
    rule: str
    skill: str
    kind: str
    example: str

    class Described(Remark):
        says = "this description permits no {kind}"
        kind: str


class NotGranted(Warning, code="CHK104", name="not-granted"):
    """A permission that rules do not respect: they act below its limit."""

    title = "`{skill}` permits {permission}, and `{rule}` acts on {condition} all the same"
    label = "the rules do not grant this"
    help = "give `{rule}` an exemption, `unless doing {skill} then ...`, or take the permission out"
    skill: str
    permission: str
    rule: str
    condition: str

    class Acting(Remark):
        says = "this acts while `{skill}` runs"
        skill: str


class NeverInScene(Warning, code="CHK105", name="never-in-this-scene"):
    """A query about skills with a class that no thing of the scene has."""

    title = "`{query}` is never true in this scene"
    label = "no thing of the scene is of the class that `{parameter}` has to be of"
    query: str
    parameter: str

    class Others(Remark):
        says = "in this scene `{parameter}` can be {known}; ask for that, or describe another thing"
        parameter: str
        known: str


class NoNumberInScene(Warning, code="CHK106", name="number-not-in-scene"):
    """A thing of the scene without a number that a rule reads while a skill runs with it."""

    title = "{thing} {problem} {property}, so that {rules} {hold} while `{skill}` runs with it"
    label = "{rules} cannot know {property} of this"
    help = "give it one {property} that is a number, or ask for a class without this thing"
    thing: str
    problem: str
    property: str
    rules: str
    hold: str
    skill: str

    class Read(Remark):
        says = "this rests on {query}, and holds where that is unknown"
        query: str


class NeverWorks(Error, code="CHK201", name="skill-never-works"):
    """A skill that needs a resource that a rule takes away whenever the skill runs."""

    title = "`{skill}` can never work: `{rule}` is active whenever it runs"
    label = "this holds whenever `{skill}` runs, whatever the sensors say"
    help = "give `{rule}` a condition that can be false while `{skill}` runs"
    skill: str
    rule: str

    class Needed(Remark):
        says = "`{skill}` needs {thing}"
        skill: str
        thing: str

    class Taken(Remark):
        says = "`{action}` takes {thing} away"
        action: str
        thing: str


class RulesNeverLetWork(Error, code="CHK202", name="rules-never-let-work"):
    """A skill that needs a resource that some rule takes away whenever the skill runs."""

    title = "`{skill}` can never work: one of {rules} is active whenever it runs"
    label = "`{skill}` needs {thing}"
    help = "let all of these rules be inactive at the same time while `{skill}` runs"
    skill: str
    rules: str
    thing: str

    class Active(Remark):
        says = "active in some of the cases"


class Fight(Warning, code="CHK203", name="rules-and-skills-fight"):
    """A rule that ends a skill and is thereby cleared, so that the skill is started again."""

    title = "`{rule}` and `{skill}` fight: the one ends the other, again and again"
    label = "active only while `{skill}` runs, and cleared as soon as that has ended"
    help = "clear `{rule}` later (`clear for 5 sec`, `latched until reset`)"
    rule: str
    skill: str

    class Ended(Remark):
        says = "`{action}` ends `{skill}`, which needs {thing}"
        action: str
        skill: str
        thing: str

    class Started(Remark):
        says = "and here it is started again after it has failed"


class NotAllAsked(Error, code="CHK204", name="not-all-asked"):
    """Queries that exceeded their time limit."""

    title = "not all was asked about rules and skills within {seconds:g} s of processor time"
    label = "so nobody knows whether all is well"
    help = "ask about fewer rules at a time, in a file of their own"
    seconds: float


class NothingToTake(Warning, code="CHK205", name="nothing-to-take"):
    """Skills that need a thing of a class that no thing of the scene has."""

    title = "{skills} cannot start in this scene: there is no {owl_class}"
    label = "this has to be one"
    help = "describe one in the scene"
    skills: str
    owl_class: str

    class Needed(Remark):
        says = "and this"


class TypesDiffer(Error, code="CHK301", name="topic-of-two-types"):
    """A topic or server with different types in rules and skills."""

    title = "{thing} is {one} to the rules, and {other} to `{skill}`"
    label = "{other} here"
    help = "correct the type on one side"
    thing: str
    one: str
    other: str
    skill: str

    class InRules(Remark):
        says = "{one} here"
        one: str


class NobodyReads(Warning, code="CHK302", name="nobody-reads"):
    """A topic that rules or skills publish, and that no node of the system model subscribes to."""

    title = "nobody reads {topic}"
    label = "this sends on it, and no node of the system model subscribes to it"
    help = "correct the name, or declare who reads it: `node NAME {{ subscribes {topic}; }}`"
    topic: str

    class Near(Remark):
        says = "did you mean `{near}`, which `{node}` reads?"
        near: str
        node: str


class NoOntologyForScene(Error, code="CHK303", name="scene-without-ontology"):
    """A scene for skills whose file leads to no ontology, or to an ontology without a class."""

    title = "nobody knows what the things of the scene are: `{missing}` is not in the ontology"
    label = "these skills tell of no ontology that has it"
    note = "the ontology is that of the sources of this file"
    help = "write the file with `ezskiros export`, beside the ontology"
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
