"""ROSS76x and ROSS77x: the results of tests, and their coverage."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template, Warning


class ExpectationNotMet(Error, code="ROSS760", name="expectation-not-met"):
    """A rule that differs from the expectation of a test."""

    title = "`{rule}` is {found} at {instant}"
    label = "expected {expected}"
    note = "{reason}"
    help = "correct the rule, or correct the expectation"
    rule: str
    found: str
    instant: str
    expected: str
    reason: str


class EnginesDiffer(Error, code="ROSS761", name="engines-differ"):
    """A test with different results of the compiled C and the interpreter."""

    title = "the C monitor differs from the interpreter in `{test}`"
    label = "interpreter: {expected}; C: {found}"
    help = "this is a defect of ROSSMARie or of the C compiler: please report the defect"
    test: str
    expected: str
    found: str


class NotRunInC(Warning, code="ROSS762", name="not-run-in-c"):
    """Tests that ran on the interpreter only."""

    title = "the tests ran in the interpreter only"
    label = "{reason}"
    note = "the generated C was not tested"
    help = "install a C compiler, or name one: `CC=clang rossmarie test ...`"
    reason: str


class NoTests(Warning, code="ROSS763", name="no-tests"):
    """Rules without any test."""

    title = "there are no tests"
    label = "neither this file nor `{beside}` contains a test"
    help = "write a test, or generate tests: `rossmarie test {path} --write`"
    beside: str
    path: str


class SettingUnread(Warning, code="ROSS764", name="setting-unread"):
    """A field that a test sets but no rule reads."""

    title = "no rule reads the field that the test sets here"
    label = "setting this field has no effect"
    note = "of {topic} the rules read {read}"
    help = "set a field that the rules read, or write `{input}` alone to send the message"
    topic: str
    read: str
    input: str


class CommandNotWithin(Error, code="ROSS765", name="command-not-within"):
    """A command that exceeds the limits that a test expects."""

    title = "`{field}` of {topic} may be {found} at {instant}"
    label = "expected within {expected}"
    note = "{reason}"
    help = "limit the field in an action of a rule that is active then, or correct the expectation"
    field: str
    topic: str
    found: str
    instant: str
    expected: str
    reason: str


ALL: tuple[type[Template], ...] = (
    ExpectationNotMet,
    EnginesDiffer,
    NotRunInC,
    NoTests,
    SettingUnread,
    CommandNotWithin,
)
