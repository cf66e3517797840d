"""ROSS4xx: what can be understood, but hardly be meant."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template, Warning


class UnusedName(Warning, code="ROSS401", name="unused-name"):
    """A declaration that no rule needs."""

    title = "{kind} `{identifier}` is never used"
    label = "declared here, used nowhere"
    note = "{reason}"
    help = "use it, or remove it"
    kind: str
    identifier: str
    reason: str


class MissingTimeout(Warning, code="ROSS402", name="missing-timeout"):
    """An input that a rule rests on and that may fall silent unnoticed."""

    title = "input `{identifier}` has no timeout"
    label = "if it falls silent, its last value is used for ever"
    note = (
        "without a timeout, a rule that lacks this input is never activated by the lack; "
        "with one, it fails closed"
    )
    help = "write the longest silence you accept after it: `timeout 0.5 sec`"
    identifier: str


class AmbiguousFor(Error, code="ROSS403", name="ambiguous-for"):
    """`for` behind two conditions without parentheses."""

    title = "it is not clear what has to hold for {duration}"
    label = "`{last}` alone, or all of it?"
    note = "`for` binds tighter than `and` and `or`, but reads as if it covered all before it"
    help = "write `{narrow}` or `{wide}`"
    duration: str
    last: str
    narrow: str
    wide: str


class ExactEquality(Warning, code="ROSS404", name="exact-equality"):
    """Measured numbers compared for equality."""

    title = "measured numbers are hardly ever exactly equal"
    label = "`{operator}` compares every last bit"
    help = "compare with a tolerance: `{advice}`"
    operator: str
    advice: str


class RepeatedAction(Warning, code="ROSS405", name="repeated-action"):
    """An action that one rule names twice."""

    title = "action `{identifier}` is named twice in one rule"
    label = "it is in force already"
    note = "an action is in force from its turn to the release; named again, it only begins again"
    help = "remove it"
    identifier: str


class ConstantCondition(Warning, code="ROSS406", name="constant-condition"):
    """A condition that nothing can change."""

    title = "this is always {outcome}"
    label = "no input has any influence on this"
    note = "a monitor is there to watch what changes; here nothing does"
    help = "compare an input with something, or leave this out"
    outcome: str


class NoRules(Warning, code="ROSS407", name="no-rules"):
    """Conditions or inputs and no rule that rests on them, or a file without anything."""

    title = "there is no rule: nothing will be monitored"
    label = "{what}"
    note = "only rules start actions and yield verdicts"
    help = "write what follows from it: `if CONDITION then {{ ACTION; }};`"
    what: str


class NeverCleared(Warning, code="ROSS408", name="never-cleared"):
    """A rule that is to be cleared by what keeps it active."""

    title = "this rule can never be cleared"
    label = "while this holds, so does the condition of the rule"
    note = (
        "a rule is cleared once its own condition is false and the one after `clear when` is true"
    )
    help = "write when it may end, with a margin; or leave the contract out"


class UnmitigatedHazard(Warning, code="ROSS421", name="unmitigated-hazard"):
    """A hazard against which there is no rule."""

    title = "no rule mitigates hazard `{identifier}`"
    label = "declared here"
    help = "write `mitigates {identifier}` behind the rules that do, or remove the hazard"
    identifier: str


class JumpingAngle(Warning, code="ROSS409", name="jumping-angle"):
    """A change of an angle that jumps by 360 deg at half a turn."""

    title = "`{angle}` jumps from 180 deg to -180 deg"
    label = "where it jumps, {effect}"
    note = "a robot that turns slowly past that point looks as if it had turned all the way round"
    help = (
        "compare an angular velocity that a message carries, such as "
        "`imu.angular_velocity.{axis}` or `odom.twist.twist.angular.{axis}`"
    )
    angle: str
    effect: str
    axis: str


ALL: tuple[type[Template], ...] = (
    UnusedName,
    MissingTimeout,
    AmbiguousFor,
    ExactEquality,
    RepeatedAction,
    ConstantCondition,
    NoRules,
    NeverCleared,
    JumpingAngle,
    UnmitigatedHazard,
)
