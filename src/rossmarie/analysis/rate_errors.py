"""ROSS713 to ROSS715 and ROSS719: conflicts with the message rates in the system model."""

from __future__ import annotations

from dslkit.diagnostics import Remark, Template, Warning


class NeverAtRate(Warning, code="ROSS713", name="never-at-rate"):
    """A duration that no message rate of the system model can satisfy."""

    title = "`{condition}` is never true at the rate of {topic}"
    label = "not while messages come as the system model says"
    help = "mend the timeout, the duration, or the rate in the system model"
    condition: str
    topic: str

    class Rate(Remark):
        says = "messages on {topic} come {apart}; {reason}"
        topic: str
        apart: str
        reason: Remark

    class NeverCleared(Remark):
        says = "so rule `{rule}` is never cleared then"
        rule: str

    class Over(Remark):
        says = "{age} after each `{condition}` can no longer be true, until the next"
        age: str
        condition: str

    class TurningPoints(Remark):
        says = "{count} turning points take {time}"
        count: int
        time: str

    class Forgotten(Remark):
        says = "`{input}` is stale {timeout} after each, and the value before it is forgotten"
        input: str
        timeout: str


class StaleBetweenMessages(Warning, code="ROSS714", name="stale-between-messages"):
    """An input whose timeout is shorter than the time between two messages."""

    title = "`{input}` is stale although messages come: {timeout} after one, the next is not due"
    label = "messages on {topic} come {apart}"
    help = "write a timeout longer than {longest}, or mend the rate in the system model"
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
    label = "over before the next message on {topics}, which comes {least} later or more"
    help = "a `for` that is to outlast a single reading has to be longer than {least}"
    condition: str
    topics: str
    least: str


class UnfitWindow(Warning, code="ROSS719", name="unfit-window"):
    """A window that receives more samples than it holds, or only one."""

    title = "the window of `{text}` does not fit the rate of {topic}"
    label = "messages on {topic} come {apart}"
    text: str
    topic: str
    apart: str

    class TooMany(Remark):
        says = "up to {count} samples come in {window}, and only the last {most} count"
        count: int
        window: str
        most: int

    class Single(Remark):
        says = "there is never a second sample within {window}, so this is the last one"
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
