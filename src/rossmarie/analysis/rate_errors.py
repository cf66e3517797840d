"""ROSS713 to ROSS715 and ROSS719: conflicts with the message rates in the system model."""

from __future__ import annotations

from dslkit.diagnostics import Remark, Template, Warning


class NeverAtRate(Warning, code="ROSS713", name="never-at-rate"):
    """A duration that no message rate of the system model can satisfy."""

    title = "`{condition}` is never true at the rate of {topic}"
    label = "not while messages arrive at the rate in the system model"
    help = "correct the timeout, the duration, or the rate in the system model"
    condition: str
    topic: str

    class Rate(Remark):
        says = "messages on {topic} arrive {apart}; {reason}"
        topic: str
        apart: str
        reason: Remark

    class NeverCleared(Remark):
        says = "rule `{rule}` is then never cleared"
        rule: str

    class Over(Remark):
        says = (
            "{age} after each message, `{condition}` can no longer be true until the next message"
        )
        age: str
        condition: str

    class TurningPoints(Remark):
        says = "{count} turning points take {time}"
        count: int
        time: str

    class Forgotten(Remark):
        says = (
            "`{input}` is stale {timeout} after each message, and its previous value is forgotten"
        )
        input: str
        timeout: str


class StaleBetweenMessages(Warning, code="ROSS714", name="stale-between-messages"):
    """An input whose timeout is shorter than the time between two messages."""

    title = (
        "`{input}` becomes stale between messages: the next message is not due {timeout} after a "
        "message"
    )
    label = "messages on {topic} arrive {apart}"
    help = "write a timeout longer than {longest}, or correct the rate in the system model"
    input: str
    topic: str
    apart: str
    timeout: str
    longest: str

    class BecomesActive(Remark):
        says = "rule `{rule}` becomes active then; {shown}"
        rule: str
        shown: Remark


class OneMessageEnough(Warning, code="ROSS715", name="one-message-enough"):
    """A `for` that ends before the next message can come."""

    title = "one message is enough for `{condition}`"
    label = (
        "this time ends before the next message on {topics}, which arrives at least {least} later"
    )
    help = "to require more than one reading, write a `for` longer than {least}"
    condition: str
    topics: str
    least: str


class UnfitWindow(Warning, code="ROSS719", name="unfit-window"):
    """A window that receives more samples than it holds, or only one."""

    title = "the window of `{text}` does not fit the rate of {topic}"
    label = "messages on {topic} arrive {apart}"
    text: str
    topic: str
    apart: str

    class TooMany(Remark):
        says = "up to {count} samples arrive in {window}, but only the last {most} count"
        count: int
        window: str
        most: int

    class Single(Remark):
        says = (
            "a second sample never arrives within {window}, so the window holds only the last "
            "sample"
        )
        window: str

    class Shorter(Remark):
        says = "write a window of at most {longest}"
        longest: str

    class Longer(Remark):
        says = "write a window of several times {least}"
        least: str


ALL: tuple[type[Template], ...] = (
    NeverAtRate,
    StaleBetweenMessages,
    OneMessageEnough,
    UnfitWindow,
)
