"""Mistakes that involve several rules."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class UndeclaredRule(Error, code="ROSS120", name="undeclared-rule"):
    """An order of rules with a rule that does not exist."""

    title = "there is no rule `{identifier}`"
    label = "no rule has this name"
    help = "give the intended rule this name: `rule {identifier}: if ...`"
    identifier: str


class CircularEscalation(Error, code="ROSS122", name="circular-escalation"):
    """Actions that each follow the failure of another, in a circle."""

    title = "action `{identifier}` escalates to itself"
    label = "this leads back: {cycle}"
    note = "each escalation must lead to a stronger action, and the chain must end"
    help = "remove the `else` of the last action of the chain"
    identifier: str
    cycle: str


class CircularPriority(Error, code="ROSS123", name="circular-priority"):
    """Rules that each have priority over the next, in a circle."""

    title = "rule `{identifier}` has priority over itself"
    label = "this leads back: {cycle}"
    help = "remove one of the priorities"
    identifier: str
    cycle: str


class CircularUnless(Error, code="ROSS142", name="circular-unless"):
    """Rules that each are not carried out while the next is active, in a circle."""

    title = "rule `{identifier}` gives way to itself"
    label = "this leads back: {cycle}"
    note = "while all these rules are active, none of them would be carried out"
    help = "remove one `unless`, so that one rule comes first"
    identifier: str
    cycle: str


class UndeclaredHazard(Error, code="ROSS143", name="undeclared-hazard"):
    """A rule that mitigates a hazard that does not exist."""

    title = "there is no hazard `{identifier}`"
    label = "no hazard has this name"
    help = 'declare it: `hazard {identifier} "WHAT MAY HAPPEN";`'
    identifier: str


class UnknownCategory(Error, code="ROSS250", name="unknown-category"):
    """A word behind `category` or `task` that is not a category."""

    title = "there is no {said} `{identifier}`"
    label = "not one of {known}"
    help = "write one of {known}, or remove the word"
    identifier: str
    said: str
    known: str


class NothingSelected(Error, code="ROSS251", name="nothing-selected"):
    """A selection of categories that matches no rule."""

    title = "no rule is {only}"
    label = "{known}"
    note = "a monitor without rules would only appear to watch the robot"
    help = (
        "select categories that the rules have, or add the categories after a rule: `category "
        "human task dependent`"
    )
    only: str
    known: str


class LeftOutRule(Warning, code="ROSS252", name="left-out-rule"):
    """A rule outside a selection, in an order of rules inside the selection."""

    title = "rule `{identifier}` is left out, and an order names it"
    label = "{effect}"
    note = "the rules were written to act together; this selection has only some of them"
    help = "select the categories of this rule as well, or write the order without it"
    identifier: str
    effect: str


class MissingTimeout(Warning, code="ROSS402", name="missing-timeout"):
    """An input of a rule that may fall silent without notice."""

    title = "input `{identifier}` has no timeout"
    label = "if this input falls silent, its last value is used forever"
    note = (
        "without a timeout, a silent input never activates a rule; with a timeout, the rule fails "
        "closed"
    )
    help = "add the longest silence that you accept: `timeout 0.5 sec`"
    identifier: str

    class Rule(Remark):
        says = "this rule depends on the input"

    class Confirmation(Remark):
        says = "this confirmation depends on the input"


class NoRules(Warning, code="ROSS407", name="no-rules"):
    """Conditions or inputs without a rule that uses them, or an empty file."""

    title = "there is no rule: nothing will be monitored"
    label = "{what}"
    note = "only rules start actions and produce verdicts"
    help = "write a rule: `if CONDITION then {{ ACTION; }};`"
    what: str


class LatchConflict(Error, code="ROSS417", name="latch-conflict"):
    """A rule with a contract of its own that uses a latched action."""

    title = "action `{identifier}` is latched, but this rule clears by itself"
    label = "this contract differs from the contract of the action"
    help = "remove this contract, or use an action that is not latched"
    identifier: str

    class Latched(Remark):
        says = "`{action}` is latched here"
        action: str


class PlanTooLarge(Error, code="ROSS420", name="plan-too-large"):
    """A rule with more actions and escalations than a reactor can hold."""

    title = "this rule has more than {most} effects"
    label = "counted with all escalations of its actions"
    note = "an escalation that several effects share counts once for each of these effects"
    help = "use fewer `else`, or actions with fewer effects"
    most: int


class UnmitigatedHazard(Warning, code="ROSS421", name="unmitigated-hazard"):
    """A hazard without a rule."""

    title = "no rule mitigates hazard `{identifier}`"
    label = "declared here"
    help = (
        "write `mitigates {identifier}` after each rule that mitigates the hazard, or remove the "
        "hazard"
    )
    identifier: str


class LastResortOverruled(Error, code="ROSS422", name="last-resort-overruled"):
    """The last action of a chain of escalations, which needs a resource that another rule may
    have.
    """

    title = "the last escalation of rule `{rule}` needs {resource}, but rule `{other}` has priority"
    label = "while `{other}` is engaged, this effect is overruled, and nothing follows"
    note = "a chain of escalations must end with an effect that no other rule can overrule"
    help = (
        "end the chain with an action that blocks or limits commands (no rule overrules such an "
        "action), or put rule `{rule}` over rule `{other}` with `priority`"
    )
    rule: str
    other: str
    resource: str

    class Ends(Remark):
        says = "rule `{rule}` ends with this effect"
        rule: str

    class First(Remark):
        says = "rule `{rule}` has priority"
        rule: str


class OddFeedback(Error, code="ROSS423", name="odd-feedback"):
    """Feedback for a learner that is not a summable amount, or is given twice."""

    title = (
        "feedback must be a plain number of at least 0, given once per activation and once per time"
    )
    label = "{found}"
    note = "a learner receives the sum of the feedback of all rules, as a loss"
    help = "write for example `feedback 1.0 per activation, 0.5 per sec, margin in N`"
    found: str


class NoMargin(Error, code="ROSS424", name="no-margin"):
    """A rule with a margin whose condition has a part without a distance to a limit."""

    title = "this part has no distance to a limit, so the rule has no margin"
    label = "{found}"
    note = (
        "a margin is made of the distances of `<`, `<=`, `>`, `>=`, `in` and `not in`; "
        "`and`, `or`, `not`, `any`, `all` and `for` pass them on"
    )
    help = "leave out `margin`, or give this part a rule of its own"
    found: str

    class Asked(Remark):
        says = "margin requested here"


class MarginUnit(Error, code="ROSS425", name="margin-unit"):
    """A margin whose unit differs from the unit of a comparison."""

    title = "a margin has one dimension, but this side is {one}, and the comparison {other}"
    label = "this is {one}"
    note = "a margin is a single number: the least or the greatest of the distances"
    one: str
    other: str

    class First(Remark):
        says = "this is {one}"
        one: str

    class Asked(Remark):
        says = "margin requested here"

    class Apart(Remark):
        says = "leave out `margin`, or give each comparison a rule of its own"

    class Meant(Remark):
        says = "write `{meant}`"
        meant: str


class AlwaysLimited(Error, code="ROSS426", name="always-limited"):
    """A scope or an exemption of a rule that is always active."""

    title = "a rule with `always` has no {kind}"
    label = "{kind} of a rule with `always`"
    note = "`always` guarantees that no skill and no operator suspends the rule"
    help = "remove it, or remove `always`"
    kind: str

    class Always(Remark):
        says = "`always` is here"


class ExemptedHazard(Error, code="ROSS427", name="exempted-hazard"):
    """An exemption without a replacement, of a rule that mitigates a hazard."""

    title = "while `{skill}` nothing would mitigate hazard `{hazard}`"
    label = "exempted without a replacement"
    note = "a rule that mitigates a hazard may do something else, but not nothing"
    help = "write a replacement: `unless doing SKILL then {{ ACTION; }}`"
    hazard: str
    skill: str

    class Mitigated(Remark):
        says = "the rule mitigates the hazard here"


class RepeatedExemption(Error, code="ROSS431", name="repeated-exemption"):
    """Two exemptions of one rule for the same skill."""

    title = "`{skill}` is exempted twice"
    label = "the same skill with the same individuals"
    note = "it would not be clear which of the two exemptions applies"
    help = "remove one of the two"
    skill: str

    class First(Remark):
        says = "first exempted here"


ALL: tuple[type[Template], ...] = (
    UndeclaredRule,
    CircularEscalation,
    CircularPriority,
    CircularUnless,
    UndeclaredHazard,
    UnknownCategory,
    NothingSelected,
    LeftOutRule,
    MissingTimeout,
    NoRules,
    LatchConflict,
    PlanTooLarge,
    UnmitigatedHazard,
    LastResortOverruled,
    OddFeedback,
    NoMargin,
    MarginUnit,
    AlwaysLimited,
    ExemptedHazard,
    RepeatedExemption,
)
