"""EZS51x: values of parameters that are known at launch."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class UnreadableValues(Error, code="EZS511", name="unreadable-values"):
    """A file of values that cannot be read, or is no YAML."""

    title = "the values of parameters cannot be read: {said}"
    help = "write YAML: the name of a skill, and below it `Parameter: value`"
    said: str


class NoMapping(Error, code="EZS512", name="no-mapping"):
    """Something else where names and values are."""

    title = "here are the {of}, by their names"
    help = "write `Name: value`, one on each line"
    of: str


class UnknownLaunchName(Error, code="EZS513", name="unknown-launch-name"):
    """A value for a skill or a parameter that is not there."""

    title = "there is no {kind} `{spelled}`"
    kind: str
    spelled: str


class WrongLaunchValue(Error, code="EZS514", name="wrong-launch-value"):
    """A value that a parameter cannot have."""

    title = "`{parameter}` is {wanted}, not {found}"
    help = "give a value of that type; things of the world are given when the skill runs"
    parameter: str
    wanted: str
    found: str


ALL: tuple[type[Template], ...] = (
    UnreadableValues,
    NoMapping,
    UnknownLaunchName,
    WrongLaunchValue,
)
