"""Mistakes in parameters, and in imports that give them values."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class ImportedAs(Remark):
    """The label of an import that leads to the place of a finding."""

    says = "imported here as `{name}`"
    name: str


class ImportedWith(Remark):
    """The label of an import without a name that leads to the place of a finding."""

    says = "imported here with these values"


class UnknownParameter(Error, code="ROSS153", name="unknown-parameter"):
    """A value for a parameter that the imported file does not have."""

    title = "`{path}` has no parameter `{identifier}`"
    label = "no parameter takes this value"
    path: str
    identifier: str

    class Known(Remark):
        says = "its parameters are {known}"
        known: str

    class NoneThere(Remark):
        says = (
            "the file has no parameters; declare a parameter in the file: `parameter NAME = 1 m;`"
        )


class MissingParameter(Error, code="ROSS154", name="missing-parameter"):
    """A parameter without a value."""

    title = "parameter `{identifier}` has no value"
    label = "{reason}"
    note = "no number is right for every robot, so this parameter has no default"
    help = "{place}: `with {identifier} = {example}`"
    identifier: str
    reason: str
    place: str
    example: str

    class Declared(Remark):
        says = "declared here, without a default"


class ParameterMismatch(Error, code="ROSS155", name="parameter-mismatch"):
    """A value whose kind or unit differs from that of its parameter."""

    title = "parameter `{identifier}` is {expected}, not {found}"
    label = "this is {found}"
    identifier: str
    expected: str
    found: str

    class Declared(Remark):
        says = "declared here as {expected}"
        expected: str


class ValuesTwice(Error, code="ROSS156", name="values-twice"):
    """Two values for one parameter of one file."""

    title = "{subject} is given twice"
    label = "given again here"
    help = "{advice}"
    subject: str
    advice: str

    class First(Remark):
        says = "first given here"


class EndlessImport(Error, code="ROSS157", name="endless-import"):
    """Named imports that lead back to themselves, or create too many files."""

    title = "{problem}"
    label = "{reason}"
    note = "each import with a name adds all names of the imported file again"
    help = "import the file without `as`, or move what is needed into a file of its own"
    problem: str
    reason: str


class CannotTighten(Error, code="ROSS158", name="cannot-tighten"):
    """A parameter of the running node that could make a rule less strict."""

    title = "a parameter with `tightens` could loosen this rule"
    label = "{reason}"
    note = (
        "the running node may set such a parameter, so a rule with a tighter value must be active "
        "whenever it is active with the default, and must not clear earlier"
    )
    help = "reverse the comparison, or the word after `tightens`; or remove `tightens`"
    reason: str


class NoElementName(Error, code="ROSS159", name="no-element-name"):
    """A name in brackets behind a list that is not a text."""

    title = "`{identifier}` is not the name of an element"
    label = "{reason}"
    help = '{advice}, or write the name in quotes: `["{identifier}"]`'
    identifier: str
    reason: str
    advice: str


ALL: tuple[type[Template], ...] = (
    UnknownParameter,
    MissingParameter,
    ParameterMismatch,
    ValuesTwice,
    EndlessImport,
    CannotTighten,
    NoElementName,
)
