"""EZS51x: parameter values that are given at launch."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class UnreadableValues(Error, code="EZS511", name="unreadable-values"):
    """A parameter file that cannot be read, or is not YAML."""

    title = "the parameter file cannot be read: {said}"
    help = "write YAML: the name of a skill, and below it lines `Parameter: value`"
    said: str


class NoMapping(Error, code="EZS512", name="no-mapping"):
    """Another YAML value instead of a mapping."""

    title = "expected the {of} by name"
    help = "write `Name: value`, one per line"
    of: str


class UnknownLaunchName(Error, code="EZS513", name="unknown-launch-name"):
    """A value for an unknown skill or parameter."""

    title = "there is no {kind} `{spelled}`"
    kind: str
    spelled: str


class WrongLaunchValue(Error, code="EZS514", name="wrong-launch-value"):
    """A value of the wrong type."""

    title = "`{parameter}` is {wanted}, not {found}"
    help = "give a value of that type; individuals are passed when the skill starts"
    parameter: str
    wanted: str
    found: str


ALL: tuple[type[Template], ...] = (
    UnreadableValues,
    NoMapping,
    UnknownLaunchName,
    WrongLaunchValue,
)
