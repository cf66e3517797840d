"""ROSS7xx: effects of rules together, each with a witness or a proof."""

from __future__ import annotations

from dslkit.diagnostics import Error, Note, Remark, Template, Warning


class WhileActive(Remark):
    """The label of the effect of a rule on a command."""

    says = "in force while the rule is active"


class Escalated(Remark):
    """The label of the effect of an escalation on a command."""

    says = "in force once what stands before its `else` has failed"


class WheneverNot(Remark):
    """The label of a rule that is active whenever another one is."""

    says = "whenever `{active}` is inactive, `{rule}` is inactive too"
    active: str
    rule: str


class Decided(Remark):
    """The label of the part of a condition that decides it."""

    says = "this is {outcome}"
    outcome: str


class NumberIs(Remark):
    """The note that tells which values a number can have."""

    says = "`{number}` is {range}"
    number: str
    range: str


class NeedsItToo(Remark):
    """The label of the other of two rules that need the same thing."""

    says = "this rule needs it too"


class Shown(Remark):
    """The note that tells a witness."""

    says = "shown by this: {trace}"
    trace: str


class ShownWithLoss(Remark):
    """The note that tells a witness in which an input is missing."""

    says = "shown by this, where an input is missing: {trace}"
    trace: str


class NameRules(Remark):
    """The help where rules that need an order have no names."""

    says = "name both rules, and say which is more important: `priority RULE over RULE;`"


class OrderRules(Remark):
    """The help where rules need an order."""

    says = (
        "say which is more important: `priority {first} over {second};`, or the other way round; "
        "or let one give way: `if ... unless RULE then`"
    )
    first: str
    second: str


class RulesConflict(Warning, code="ROSS700", name="rules-conflict"):
    """Two rules that are active together and need the same thing, with no order between them."""

    title = "rules `{first}` and `{second}` can be active together, and both need {resource}"
    label = "which one gets it?"
    note = "without an order, the rule that stands first in the file gets it: `{first}`"
    first: str
    second: str
    resource: str


class NeverTogether(Note, code="ROSS701", name="never-together"):
    """A proof that two rules that need the same thing are never active together."""

    title = "proved: rules `{first}` and `{second}` are never active together"
    label = "both need {resource}, and need no order"
    first: str
    second: str
    resource: str


class ConflictOrdered(Note, code="ROSS702", name="conflict-ordered"):
    """Two rules that need the same thing, and the order that says which one gets it."""

    title = "rules `{first}` and `{second}` both need {resource}: `{first}` comes first"
    label = "{together}"
    first: str
    second: str
    resource: str
    together: str


class NeverActive(Warning, code="ROSS703", name="never-active"):
    """A rule whose condition cannot be true."""

    title = "rule `{rule}` is never active: its condition cannot be true"
    label = "{rest}"
    help = "mend the condition, or leave the rule out"
    rule: str
    rest: str


class AlwaysActive(Warning, code="ROSS704", name="always-active"):
    """A rule whose condition cannot be false."""

    title = "rule `{rule}` is always active: its condition cannot be false"
    label = "once active, nothing clears it"
    help = "mend the condition; what is always to be done needs no rule"
    rule: str


class ConstantPart(Warning, code="ROSS705", name="constant-part"):
    """A part of a condition that has the same value whatever is measured."""

    title = "`{condition}` is {outcome}"
    label = "whatever is measured"
    help = "mend it, or leave it out"
    condition: str
    outcome: str


class RuleImplied(Warning, code="ROSS706", name="rule-implied"):
    """A rule that does the same as another rule whenever it is active."""

    title = "rule `{rule}` adds nothing: whenever it is active, `{other}` is, with the same actions"
    label = "leaving it out changes nothing"
    help = "leave it out, or give it actions of its own"
    rule: str
    other: str


class NoWayOut(Warning, code="ROSS707", name="no-way-out"):
    """A rule that nothing clears once it is active."""

    title = "rule `{rule}` is never cleared"
    label = "its condition cannot be false while its contract is met"
    help = "mend the contract; if somebody has to look first, write `latched until reset`"
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

    title = "rule `{rule}` publishes {field} = {value} on {topic}, and {limit} makes it 0"
    label = "this command does nothing"
    help = "let the limit leave room for the command: its bounds are [{low}, {high}]"
    rule: str
    field: str
    value: str
    topic: str
    limit: str
    low: str
    high: str

    class Limit(Remark):
        says = "this lies on it at the same time"


class LimitHoldsCondition(Warning, code="ROSS710", name="limit-holds-condition"):
    """A rule keeps its own condition from becoming false, by its effect on a command."""

    title = "rule `{rule}` keeps itself active: it {does}, which its condition reads"
    label = "so nothing clears the rule"
    help = "read what the planner asks for ({asked}) or what the robot does, not what has passed"
    rule: str
    does: str
    asked: str


class LimitEndsCondition(Warning, code="ROSS720", name="limit-ends-condition"):
    """A rule that is cleared by its own effect on a command, while its reason lasts."""

    title = "rule `{rule}` switches itself off: it {does}, which its condition reads"
    label = "the next command that passes clears the rule, and the one after it is free again"
    help = "read what the planner asks for ({asked}) or what the robot does, not what has passed"
    rule: str
    does: str
    asked: str


class NeverItsTurn(Warning, code="ROSS711", name="never-its-turn"):
    """A rule that never gets the resource that it needs."""

    title = "rule `{rule}` never gets {resource}: whenever it is active, `{other}` is, and has it"
    label = "`{other}` comes first"
    help = "put it first: `priority {rule} over {other};`, or narrow the condition of `{other}`"
    rule: str
    other: str
    resource: str


class LossUnnoticed(Warning, code="ROSS712", name="loss-unnoticed"):
    """An input with a timeout whose loss activates no rule."""

    title = "nothing happens when `{input}` is stale"
    label = "no rule becomes active when its timeout is over"
    help = "let a rule notice: `if age({input}) > ... then ...`"
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
        says = "leave the reset to an operator, or leave `latched until reset` out"

    class NameRules(Remark):
        says = (
            "leave the reset to an operator; or name both rules, and say that it is meant: "
            "`priority RULE over RULE;`"
        )

    class GiveWay(Remark):
        says = (
            "leave the reset to an operator, or write `unless {latched}` after the condition of "
            "`{rule}`; if the reset is meant, say so: `priority {rule} over {latched};`"
        )
        rule: str
        latched: str


class LimitHoldsRelease(Warning, code="ROSS717", name="limit-holds-release"):
    """A rule keeps its own `clear when` from becoming true, by its effect on a command."""

    title = "rule `{rule}` is never cleared: it {does}, and so `{release}` is {when}"
    label = "so nothing clears the rule"
    help = "read what the planner asks for or what the robot does, not what has passed the filter"
    rule: str
    does: str
    release: str
    when: str

    class Release(Remark):
        says = "this is what clears the rule"


class RulesAlternate(Warning, code="ROSS718", name="rules-alternate"):
    """Rules that activate each other again and again by the messages that they publish."""

    title = "{rules} {whom} off again and again by publishing"
    label = "it publishes on {topic}, which {reader} reads"
    help = "publish on a topic that none of these rules reads, or leave room between conditions"
    rules: str
    whom: str
    topic: str
    reader: str

    class Other(Remark):
        says = "this one publishes on {topic}, which {reader} reads"
        topic: str
        reader: str

    class Often(Remark):
        says = "{who} becomes active twice within {within}"
        who: str
        within: str


class NotInTime(Error, code="ROSS721", name="not-in-time"):
    """A rule that is not active before it is too late to brake."""

    title = "rule `{rule}` acts too late: `{motion}` can arrive there faster than {speed}"
    label = "it is too late to brake, and the condition of the rule is false"
    help = "compare the distance with `stopping({motion}, {speed})`, or ask for less"
    rule: str
    motion: str
    speed: str

    class Reaction(Remark):
        says = (
            "the brakes of `{motion}` hold up to {reaction} after a message: {timeout} until the "
            "next one is missed, and {latency} of latency"
        )
        motion: str
        reaction: str
        timeout: str
        latency: str


class InTime(Note, code="ROSS722", name="in-time"):
    """A proof that a rule acts before it is too late to brake."""

    title = "proved: rule `{rule}` acts in time"
    label = "it {text}, with the slowest brakes and the latest message"
    rule: str
    text: str


class NotProved(Error, code="ROSS723", name="not-proved-in-time"):
    """A rule that keeps a speed, without a proof that it acts in time."""

    title = "nobody knows whether rule `{rule}` acts in time"
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
    note = "this is neither proved nor shown; do not take it for an answer"
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
