"""ROSS7xx: effects of rules together, each with a witness or a proof."""

from __future__ import annotations

from dslkit.diagnostics import Error, Note, Remark, Template, Warning


class WhileActive(Remark):
    """The label of the effect of a rule on a command."""

    says = "in force while the rule is active"


class Escalated(Remark):
    """The label of the effect of an escalation on a command."""

    says = "in force once the part before `else` has failed"


class WheneverNot(Remark):
    """The label of a rule that is active whenever another one is."""

    says = "whenever `{active}` is inactive, `{rule}` is inactive too"
    active: str
    rule: str


class Decided(Remark):
    """The label of the part of a condition that decides it."""

    says = "this part is {outcome}"
    outcome: str


class NumberIs(Remark):
    """The note that tells which values a number can have."""

    says = "`{number}` is {range}"
    number: str
    range: str


class NeedsItToo(Remark):
    """The label of the other of two rules that need the same thing."""

    says = "this rule needs the same resource"


class Shown(Remark):
    """The note that tells a witness."""

    says = "example: {trace}"
    trace: str


class ShownWithLoss(Remark):
    """The note that tells a witness in which an input is missing."""

    says = "example with a missing input: {trace}"
    trace: str


class NameRules(Remark):
    """The help where rules that need an order have no names."""

    says = "name both rules, and declare which rule is more important: `priority RULE over RULE;`"


class OrderRules(Remark):
    """The help where rules need an order."""

    says = (
        "declare which rule is more important: `priority {first} over {second};` or the reverse; "
        "or let one rule give way: `if ... unless RULE then`"
    )
    first: str
    second: str


class RulesConflict(Warning, code="ROSS700", name="rules-conflict"):
    """Two rules that are active together and need the same thing, with no order between them."""

    title = "rules `{first}` and `{second}` can be active together, and both need {resource}"
    label = "which rule gets the resource?"
    note = "without a priority, the first rule in the file gets the resource: `{first}`"
    first: str
    second: str
    resource: str


class NeverTogether(Note, code="ROSS701", name="never-together"):
    """A proof that two rules that need the same thing are never active together."""

    title = "proved: rules `{first}` and `{second}` are never active together"
    label = "both rules need {resource}; no priority is needed"
    first: str
    second: str
    resource: str


class ConflictOrdered(Note, code="ROSS702", name="conflict-ordered"):
    """Two rules that need the same thing, and the order that says which one gets it."""

    title = "rules `{first}` and `{second}` both need {resource}: `{first}` has priority"
    label = "{together}"
    first: str
    second: str
    resource: str
    together: str


class NeverActive(Warning, code="ROSS703", name="never-active"):
    """A rule whose condition cannot be true."""

    title = "rule `{rule}` is never active: its condition cannot be true"
    label = "{rest}"
    help = "correct the condition, or remove the rule"
    rule: str
    rest: str


class AlwaysActive(Warning, code="ROSS704", name="always-active"):
    """A rule whose condition cannot be false."""

    title = "rule `{rule}` is always active: its condition cannot be false"
    label = "once active, nothing clears it"
    help = "correct the condition; an effect that is always wanted needs no rule"
    rule: str


class ConstantPart(Warning, code="ROSS705", name="constant-part"):
    """A part of a condition that has the same value whatever is measured."""

    title = "`{condition}` is {outcome}"
    label = "for all input values"
    help = "correct this part, or remove it"
    condition: str
    outcome: str


class RuleImplied(Warning, code="ROSS706", name="rule-implied"):
    """A rule that does the same as another rule whenever it is active."""

    title = "rule `{rule}` adds nothing: `{other}` is always active with it, and does the same"
    label = "removing this rule changes nothing"
    help = "remove the rule, or give the rule actions of its own"
    rule: str
    other: str


class NoWayOut(Warning, code="ROSS707", name="no-way-out"):
    """A rule that nothing clears once it is active."""

    title = "rule `{rule}` is never cleared"
    label = "the condition cannot be false while the resume contract is met"
    help = "correct the contract; if an operator has to look first, write `latched until reset`"
    rule: str


class Chattering(Warning, code="ROSS708", name="chattering"):
    """A command that a simultaneous limit cuts to zero."""

    title = "rule `{rule}` can toggle within {within}"
    label = "active twice within {found}"
    help = "add `clear for` a time, or `clear when` with a second threshold"
    rule: str
    within: str
    found: str


class RecoveryBlocked(Warning, code="ROSS709", name="recovery-blocked"):
    """A command that a limit in force at the same time cuts to zero."""

    title = "rule `{rule}` publishes {field} = {value} on {topic}, but {limit} makes it 0"
    label = "this command has no effect"
    help = "change the limit so that it allows the command; the bounds are [{low}, {high}]"
    rule: str
    field: str
    value: str
    topic: str
    limit: str
    low: str
    high: str

    class Limit(Remark):
        says = "this limit is in force at the same time"


class LimitHoldsCondition(Warning, code="ROSS710", name="limit-holds-condition"):
    """A rule keeps its own condition from becoming false, by its effect on a command."""

    title = "rule `{rule}` keeps itself active: it {does}, and its condition reads the result"
    label = "nothing clears this rule"
    help = (
        "read the command of the planner ({asked}) or the motion of the robot, not the filtered "
        "command"
    )
    rule: str
    does: str
    asked: str


class LimitEndsCondition(Warning, code="ROSS720", name="limit-ends-condition"):
    """A rule that is cleared by its own effect on a command, while its reason lasts."""

    title = "rule `{rule}` switches itself off: it {does}, and its condition reads the result"
    label = "the next filtered command clears the rule, and the command after it is not limited"
    help = (
        "read the command of the planner ({asked}) or the motion of the robot, not the filtered "
        "command"
    )
    rule: str
    does: str
    asked: str


class NeverItsTurn(Warning, code="ROSS711", name="never-its-turn"):
    """A rule that never gets the resource that it needs."""

    title = (
        "rule `{rule}` never gets {resource}: whenever it is active, `{other}` is active and has "
        "priority"
    )
    label = "`{other}` has priority"
    help = (
        "give this rule priority: `priority {rule} over {other};`, or narrow the condition of "
        "`{other}`"
    )
    rule: str
    other: str
    resource: str


class LossUnnoticed(Warning, code="ROSS712", name="loss-unnoticed"):
    """An input with a timeout whose loss activates no rule."""

    title = "no rule reacts when `{input}` is stale"
    label = "no rule becomes active after the timeout of this input"
    help = "add a rule for the stale input: `if age({input}) > ... then ...`"
    input: str


class LatchReleased(Warning, code="ROSS716", name="latch-released"):
    """A latched rule that the effect `reset` of another rule releases, without an operator."""

    title = "rule `{rule}` can reset {latched} without an operator"
    label = "its action `{action}` resets all latched rules"
    rule: str
    latched: str
    action: str

    class Latched(Remark):
        says = "this rule waits for a reset"

    class OwnLatch(Remark):
        says = "leave the reset to an operator, or remove `latched until reset`"

    class NameRules(Remark):
        says = (
            "leave the reset to an operator; if the reset is intended, name both rules and "
            "declare: `priority RULE over RULE;`"
        )

    class GiveWay(Remark):
        says = (
            "leave the reset to an operator, or write `unless {latched}` after the condition of "
            "`{rule}`; if the reset is intended, declare: `priority {rule} over {latched};`"
        )
        rule: str
        latched: str


class LimitHoldsRelease(Warning, code="ROSS717", name="limit-holds-release"):
    """A rule keeps its own `clear when` from becoming true, by its effect on a command."""

    title = "rule `{rule}` is never cleared: it {does}, and so `{release}` is {when}"
    label = "nothing clears this rule"
    help = "read the command of the planner or the motion of the robot, not the filtered command"
    rule: str
    does: str
    release: str
    when: str

    class Release(Remark):
        says = "this condition clears the rule"


class RulesAlternate(Warning, code="ROSS718", name="rules-alternate"):
    """Rules that activate each other again and again by the messages that they publish."""

    title = "{rules} {whom} off again and again by publishing"
    label = "this rule publishes on {topic}, which {reader} reads"
    help = (
        "publish on a topic that none of these rules reads, or leave a margin between the "
        "conditions"
    )
    rules: str
    whom: str
    topic: str
    reader: str

    class Other(Remark):
        says = "this rule publishes on {topic}, which {reader} reads"
        topic: str
        reader: str

    class Often(Remark):
        says = "{who} becomes active twice within {within}"
        who: str
        within: str


class NotInTime(Error, code="ROSS721", name="not-in-time"):
    """A rule that is not active before it is too late to brake."""

    title = "rule `{rule}` acts too late: `{motion}` can arrive faster than {speed}"
    label = "braking is too late here, but the condition of the rule is still false"
    help = "compare the distance with `stopping({motion}, {speed})`, or demand less"
    rule: str
    motion: str
    speed: str

    class Reaction(Remark):
        says = (
            "the brakes of `{motion}` engage up to {reaction} after a message: {timeout} until the "
            "next message is missed, plus {latency} of latency"
        )
        motion: str
        reaction: str
        timeout: str
        latency: str


class InTime(Note, code="ROSS722", name="in-time"):
    """A proof that a rule acts before it is too late to brake."""

    title = "proved: rule `{rule}` acts in time"
    label = "the rule {text}, even with the slowest brakes and the latest message"
    rule: str
    text: str


class NotProved(Error, code="ROSS723", name="not-proved-in-time"):
    """A rule that keeps a speed, without a proof that it acts in time."""

    title = "cannot decide whether rule `{rule}` acts in time"
    label = "{reason}"
    help = "compare the distance from {places} itself with `stopping({motion}, {speed})`"
    rule: str
    reason: str
    places: str
    motion: str
    speed: str


class Undecided(Note, code="ROSS729", name="undecided"):
    """A query with neither a proof nor a witness."""

    title = "undecided: {query}"
    label = "{reason}"
    note = "the property is neither proved nor refuted: do not rely on it"
    query: str
    reason: str


class NotAsked(Warning, code="ROSS730", name="rules-not-analyzed"):
    """The solver is not installed, so no query about the rules was asked."""

    title = "the rules were not checked against each other"
    label = "no conflict between this rule and the others would be found"
    note = "this check needs the solver z3, which is not installed"
    help = "install the solver: {advice}"
    advice: str


ALL: tuple[type[Template], ...] = (
    NotAsked,
    RulesConflict,
    NeverTogether,
    ConflictOrdered,
    NeverActive,
    AlwaysActive,
    ConstantPart,
    RuleImplied,
    NoWayOut,
    Chattering,
    RecoveryBlocked,
    LimitHoldsCondition,
    LimitEndsCondition,
    NeverItsTurn,
    LossUnnoticed,
    LatchReleased,
    LimitHoldsRelease,
    RulesAlternate,
    NotInTime,
    InTime,
    NotProved,
    Undecided,
)
