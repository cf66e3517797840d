"""ROSS76x and ROSS77x: the results of tests, and their coverage."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template, Warning


class ExpectationNotMet(Error, code="ROSS760", name="expectation-not-met"):
    """A rule that differs from the expectation of a test."""

    title = "`{rule}` is {found} at {instant}"
    label = "expected {expected}"
    note = "{reason}"
    help = "mend the rule, or write what it is to do"
    rule: str
    found: str
    instant: str
    expected: str
    reason: str


class EnginesDiffer(Error, code="ROSS761", name="engines-differ"):
    """A test with different results of the compiled C and the interpreter."""

    title = "the C monitor differs from the interpreter in `{test}`"
    label = "interpreter: {expected}; C: {found}"
    help = "this is a defect of this tool or of the C compiler: please report it"
    test: str
    expected: str
    found: str


class NotRunInC(Warning, code="ROSS762", name="not-run-in-c"):
    """Tests that ran on the interpreter only."""

    title = "the tests ran on the interpreter only"
    label = "{reason}"
    note = "nothing is known of the generated C"
    help = "install a C compiler, or name one: `CC=clang rossmarie test ...`"
    reason: str


class NoTests(Warning, code="ROSS763", name="no-tests"):
    """Rules without any test."""

    title = "there are no tests"
    label = "neither this file nor `{beside}` has any"
    help = "write one, or let them be generated: `rossmarie test {path} --write`"
    beside: str
    path: str


class SettingUnread(Warning, code="ROSS764", name="setting-unread"):
    """A field that a test sets but no rule reads."""

    title = "no rule reads what is set here"
    label = "nothing changes with it"
    note = "of {topic} the rules read {read}"
    help = "set what is read, or write `{input}` alone to send the message"
    topic: str
    read: str
    input: str


class CommandNotWithin(Error, code="ROSS765", name="command-not-within"):
    """A command that exceeds the limits that a test expects."""

    title = "`{field}` of {topic} may be {found} at {instant}"
    label = "expected within {expected}"
    note = "{reason}"
    help = (
        "limit the field in an action of a rule that is active then, or write what is let through"
    )
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
