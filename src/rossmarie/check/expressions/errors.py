"""Mistakes in whole expressions: frequencies, and decided conditions."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class NotPositive(Error, code="ROSS318", name="not-positive"):
    """A ramp or a rate that is zero or less, or faster than possible."""

    title = "{what} is {bound}"
    label = "this is {found}"
    what: str
    bound: str
    found: str

    class AboveZero(Remark):
        says = "write a number above zero"

    class LessOften(Remark):
        says = "publish less often, or once: leave `at` out"

    class MoreOften(Remark):
        says = "publish more often, or once: leave `at` out"

    class HowOften(Remark):
        says = "write the rate of the messages"


class NotAFrequency(Error, code="ROSS319", name="not-a-frequency"):
    """A value behind `at` that is not a frequency."""

    title = "`at` needs a frequency, and this is {found}"
    label = "expected a frequency"
    help = "write a frequency in Hz, as in `at 2 Hz`"
    found: str


class ConstantCondition(Warning, code="ROSS406", name="constant-condition"):
    """A condition that no input can change."""

    title = "this condition is always {outcome}"
    label = "no input influences this condition"
    note = "a monitor watches values that change; nothing changes here"
    help = "compare an input with a value, or remove this condition"
    outcome: str


class NeverCleared(Warning, code="ROSS408", name="never-cleared"):
    """A rule that its own condition is supposed to clear."""

    title = "this rule can never be cleared"
    label = "while this condition is true, the condition of the rule is true too"
    note = (
        "a rule is cleared once its own condition is false and the condition after `clear when` is "
        "true"
    )
    help = "write a condition with a margin, or remove the contract"


ALL: tuple[type[Template], ...] = (
    NotPositive,
    NotAFrequency,
    ConstantCondition,
    NeverCleared,
)
