"""ROSS0xx: text that cannot be parsed."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class FileTooLarge(Error, code="ROSS001", name="file-too-large"):
    """A file that is too large."""

    title = "this file is too large to be a rules file"
    label = "the file has {size} {what}; the limit is {limit}"
    note = "a monitor must be small enough to review; a large input is usually a mix-up"
    help = "check the path, or split the file and `import` its parts"
    size: int
    what: str
    limit: int


class UnexpectedCharacter(Error, code="ROSS002", name="unexpected-character"):
    """A character with no meaning outside of strings and comments."""

    title = "{character} has no meaning here"
    label = "this character cannot be part of a rules file"
    help = "{advice}"
    character: str
    advice: str


class UnterminatedString(Error, code="ROSS003", name="unterminated-string"):
    """A `"` without its partner."""

    title = "this string is never closed"
    label = "the string begins here, but no closing quotation mark follows on this line"
    note = "a string must end on the line on which it begins"
    help = 'close it with `"`'

    class Escape(Remark):
        says = "a string cannot contain a quotation mark: there are no escapes"


class UnterminatedDocumentation(Error, code="ROSS004", name="unterminated-documentation"):
    """A `'''` without its partner."""

    title = "this documentation string is never closed"
    label = "the documentation string begins here"
    help = "close it with `'''`"


class UnknownItem(Error, code="ROSS005", name="unknown-item"):
    """A word at the outermost level that begins no item."""

    title = "`{found}` does not begin a declaration or a rule"
    label = "expected `import`, `system`, `action`, `const`, `input`, `entity`, `rule` or `if`"
    found: str

    class InSystem(Remark):
        says = "this belongs inside a system: `system NAME {{ ... }}`"

    class Condition(Remark):
        says = "write conditions inside an entity: `entity NAME {{ ... }}`"

    class Constant(Remark):
        says = "to name a value, write `const {name} = ...;`"
        name: str

    class Else(Remark):
        says = "a rule has no `else`: write another rule, with `not` in front of the condition"

    class InAction(Remark):
        says = "this belongs in the body of an action: `action NAME {{ ... }}`"

    class Then(Remark):
        says = "`then` belongs to a rule: `if CONDITION then {{ ACTION; }};`"

    class NoItemWord(Remark):
        says = "begin with a keyword, such as `const` or `rule`"


class MissingSign(Error, code="ROSS006", name="missing-sign"):
    """A sign or small word that closes or connects two parts."""

    title = "`{sign}` is missing"
    label = "expected `{sign}` {place} this"
    help = "{form}"
    sign: str
    place: str
    form: str


class UnclosedBracket(Error, code="ROSS007", name="unclosed-bracket"):
    """A bracket that is not closed."""

    title = "this `{bracket}` is never closed"
    label = "opened here"
    help = "write the closing `{closing}`"
    bracket: str
    closing: str

    class NextItem(Remark):
        says = "the next item begins here"


class UnopenedBracket(Error, code="ROSS008", name="unopened-bracket"):
    """A bracket that closes nothing."""

    title = "this `{bracket}` closes nothing"
    label = "there is no open `{opening}` before it"
    help = "remove the `{bracket}`, or write the matching `{opening}`"
    bracket: str
    opening: str


class MissingThen(Error, code="ROSS009", name="missing-then"):
    """A rule without `then` between its condition and its actions."""

    title = "`then` is missing"
    label = "expected `then` after this"
    note = "a rule has the form `if CONDITION then {{ ACTION; }};`"
    help = "write `then` between the condition and the actions"


class ForeignOperator(Error, code="ROSS010", name="foreign-operator"):
    """An operator as other languages write it."""

    title = "`{found}` is written `{meant}` here"
    label = "{reason}"
    help = "write `{meant}`"
    found: str
    meant: str
    reason: str


class ChainedComparison(Error, code="ROSS011", name="chained-comparison"):
    """`a < b < c`."""

    title = "comparisons cannot be chained"
    label = "the second comparison would compare the boolean result of the first"
    note = "a comparison has exactly two sides"

    class First(Remark):
        says = "the first comparison"

    class Two(Remark):
        says = "write two comparisons, joined by `and`; a condition needs no `== true`"


class NestingTooDeep(Error, code="ROSS012", name="nesting-too-deep"):
    """Brackets and prefix operators that are nested too deeply."""

    title = "this is nested too deeply"
    label = "more than {limit} levels here"
    note = "brackets, `not` and `-` can be nested {limit} levels deep"
    help = "move a part into a condition of its own, and use the name of that condition"
    limit: int


class ExpressionTooLong(Error, code="ROSS013", name="expression-too-long"):
    """A chain of operators that is longer than the limit of the compiler."""

    title = "this expression is too long"
    label = "it has more than {limit} operators that depend on each other"
    note = "the memory and time of the compiler are limited"
    help = "move parts into conditions of their own, and use the names of these conditions"
    limit: int


class ReservedWord(Error, code="ROSS014", name="reserved-word"):
    """A keyword where a name should stand."""

    title = "`{word}` is a keyword and cannot be a name"
    label = "expected a name"
    help = "choose another name, such as `{suggestion}`"
    word: str
    suggestion: str


class MissingName(Error, code="ROSS015", name="missing-name"):
    """A declaration without a usable name."""

    title = "a name is missing"
    label = "expected a name {place} this"
    note = "names consist of letters a-z and A-Z, digits and `_`, and do not begin with a digit"
    help = "{form}"
    place: str
    form: str

    class NoUnit(Remark):
        says = "a time needs a unit: write `at {number} sec {name}`"
        number: str
        name: str


class MissingValue(Error, code="ROSS016", name="missing-value"):
    """An operator or sign without an operand after or before it."""

    title = "a value is missing {place} `{sign}`"
    label = "expected a value {place} this"
    help = "{form}"
    place: str
    sign: str
    form: str


class Unfinished(Error, code="ROSS017", name="unfinished"):
    """A part that ends in the middle."""

    title = "this is incomplete"
    label = "more is expected after this"
    help = "{form}"
    form: str


class MisplacedWord(Error, code="ROSS018", name="misplaced-word"):
    """A word or sign that cannot stand where it stands."""

    title = "`{found}` cannot stand here"
    label = "this does not fit after `{before}`"
    help = "{form}"
    found: str
    before: str
    form: str


class NumberOutOfRange(Error, code="ROSS019", name="number-out-of-range"):
    """A number that the monitor cannot represent."""

    title = "this number is out of range"
    label = "{reason}"
    help = "write {advice}"
    reason: str
    advice: str


class MalformedOscillates(Error, code="ROSS021", name="malformed-oscillates"):
    """`oscillates` with wrong parts, or its parts in another call."""

    title = "{problem}"
    label = "{reason}"
    help = "write `oscillates(VALUE, 3 times, within 0.25 sec)`, and `, by 5 N` for a least swing"
    problem: str
    reason: str


class TooManyErrors(Error, code="ROSS022", name="too-many-errors"):
    """The point at which the errors of a file are cut off."""

    title = "this file has more than {limit} errors"
    label = "errors from here on are not shown"
    note = "if that many are syntax errors, the rest of the file is not read"
    help = "correct the errors above first, and check that this is a rules file"
    limit: int


class MalformedNumber(Error, code="ROSS023", name="malformed-number"):
    """`.5`, `1.` or `1,5`."""

    title = "`{found}` is not a valid number"
    label = "{reason}"
    note = "write decimals after a point, with at least one digit on each side of the point"
    found: str
    reason: str

    class Thousands(Remark):
        says = (
            "write `{decimals}` if the comma begins the decimals, or `{whole}` if the comma "
            "separates thousands"
        )
        decimals: str
        whole: str


class KeywordInCapitals(Error, code="ROSS024", name="keyword-in-capitals"):
    """`IF` for `if`."""

    title = "`{found}` is written `{meant}` here"
    label = "keywords are in lower case"
    help = "write `{meant}`"
    found: str
    meant: str


class BlockComment(Error, code="ROSS025", name="block-comment"):
    """`/* ... */`."""

    title = "`/* ... */` is not a comment in this language"
    label = "the comment begins with `/*`"
    note = "a comment begins with `//` and ends at the end of the line"
    help = "begin each line of the comment with `//`"


class HiddenCharacter(Error, code="ROSS026", name="hidden-character"):
    """A character that makes a text look different from its content."""

    title = "{character} hides the real text of the file"
    label = "{reason}"
    note = "a reviewer must see exactly the text that the monitor executes (CVE-2021-42574)"
    character: str
    reason: str

    class LineFeed(Remark):
        says = "end lines with a line feed"

    class Remove(Remark):
        says = "remove the character"


class ForeignForm(Error, code="ROSS027", name="foreign-form"):
    """A notation from another language, or a frequent mistake."""

    title = "`{found}` is not valid in this language"
    label = "{problem}"
    found: str
    problem: str

    class Form(Remark):
        says = "{form}"
        form: str

    class Documentation(Remark):
        says = "write the text between `'''` and `'''`"


class UnknownEffect(Error, code="ROSS028", name="unknown-effect"):
    """A statement in the body of an action that begins like no effect."""

    title = "`{found}` is not an effect of an action"
    label = "no effect begins with this word"
    note = (
        "an action can limit, scale or block a command, publish, call a service, set a parameter, "
        "switch controllers, send or cancel a goal, log, diagnose, call a hook, and reset"
    )
    found: str

    class NoEffectWord(Remark):
        says = "begin with the keyword of an effect, such as `limit` or `log`"


class UnknownStatement(Error, code="ROSS029", name="unknown-statement"):
    """A statement of a test that begins with no word of the language."""

    title = "`{found}` does not begin a test statement"
    label = "not a test statement"
    note = "a test statement begins with `at`, `every` or `expect`"
    help = "did you mean `{meant}`?"
    found: str
    meant: str


ALL: tuple[type[Template], ...] = (
    FileTooLarge,
    UnexpectedCharacter,
    UnterminatedString,
    UnterminatedDocumentation,
    UnknownItem,
    MissingSign,
    UnclosedBracket,
    UnopenedBracket,
    MissingThen,
    ForeignOperator,
    ChainedComparison,
    NestingTooDeep,
    ExpressionTooLong,
    ReservedWord,
    MissingName,
    MissingValue,
    Unfinished,
    MisplacedWord,
    NumberOutOfRange,
    MalformedOscillates,
    TooManyErrors,
    MalformedNumber,
    KeywordInCapitals,
    BlockComment,
    HiddenCharacter,
    ForeignForm,
    UnknownEffect,
    UnknownStatement,
)
