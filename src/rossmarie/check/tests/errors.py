"""Mistakes in tests."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class UnknownTestInput(Error, code="ROSS126", name="unknown-test-input"):
    """A message in a test for a name that is not an input."""

    title = "`{identifier}` is not an input"
    label = "only an input receives messages"
    help = "begin with the name of an input, as in `at 0 sec speed = 0.3 m/s;`"
    identifier: str


class SettingMismatch(Error, code="ROSS127", name="setting-mismatch"):
    """A value in a test that does not fit its field."""

    title = "`{field}` is {expected}"
    label = "this is {found}"
    help = "write it as in `{field} = {example}`"
    field: str
    expected: str
    found: str
    example: str


class InstantOutOfRange(Error, code="ROSS128", name="instant-out-of-range"):
    """An instant that is before the beginning of its test, or not a time."""

    title = "an instant must be a time since the beginning of the test"
    label = "this is {found}"
    help = "write a time from `0 sec` to `1e6 sec`, such as `1.5 sec`"
    found: str


class InstantOutOfOrder(Error, code="ROSS129", name="instant-out-of-order"):
    """An instant of a test that is earlier than the instant before it."""

    title = "{what} out of order"
    label = "this is before {before}"
    note = "a test is read from top to bottom, as time passes"
    what: str
    before: str

    class Later(Remark):
        says = "this instant is later"

    class Beginning(Remark):
        says = "the beginning"

    class Ends(Remark):
        says = "write the earlier instant after `from`"

    class MoveUp(Remark):
        says = "move the statement up; expectations can be anywhere"


class TooManyMessages(Error, code="ROSS130", name="too-many-messages"):
    """A repetition with too many messages."""

    title = "this statement sends {count} messages"
    label = "a test may have at most {limit}"
    help = "repeat the message less often, or for a shorter time"
    count: int
    limit: int


class NotSettable(Error, code="ROSS131", name="not-settable"):
    """A name in a test that gets a value but cannot have one."""

    title = "`{field}` cannot be set as a whole"
    label = "this is {found}"
    field: str
    found: str

    class NoValue(Remark):
        says = "give it a value, or write `{name}` alone to send it once more"
        name: str

    class Angle(Remark):
        says = "set an angle: `{field}.pitch = 5 deg`"
        field: str

    class Fields(Remark):
        says = "set one of its fields: {fields}"
        fields: str

    class Elements(Remark):
        says = "set its elements, `{field}[0]. ... = ...`, or write `{field} = []` for none"
        field: str

    class Beams(Remark):
        says = "set the measured ranges, as in `scan.ranges[-10 deg .. 10 deg] = 0.5 m`"

    class NoFields(Remark):
        says = "leave it out"


class NothingExpected(Warning, code="ROSS132", name="nothing-expected"):
    """A test without expectations."""

    title = "this test expects nothing"
    label = "it passes whatever the rules do"
    help = "write an expectation: `expect RULE active at 1 sec;`"


class NothingBeside(Error, code="ROSS248", name="nothing-beside"):
    """`nothing` beside a skill in one statement of a test."""

    title = "`doing nothing` cannot stand beside a skill"
    label = "the same statement runs a skill"
    help = "remove `doing nothing`, or write two statements"


ALL: tuple[type[Template], ...] = (
    UnknownTestInput,
    SettingMismatch,
    InstantOutOfRange,
    InstantOutOfOrder,
    TooManyMessages,
    NotSettable,
    NothingExpected,
    NothingBeside,
)
