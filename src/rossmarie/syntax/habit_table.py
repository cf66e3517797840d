"""The habits that `habits` corrects, as data."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import NamedTuple

from rossmarie.syntax.words import (
    ITEM_WORDS,
    MEANT,
    MEMBER_WORDS,
    OPERATOR_WORDS,
    PART_WORDS,
    RESERVED,
)

ANY_NAME = r"[A-Za-z_][A-Za-z0-9_]*"
_NAME = rf"(?!(?:{'|'.join(sorted(RESERVED))})\b){ANY_NAME}"
_PLAIN = rf"(?!(?:{'|'.join(sorted(RESERVED | MEMBER_WORDS.keys() | PART_WORDS))})\b){ANY_NAME}"
_NUMBER = r"(?:-\s)?\d[\w.+-]*"
_VALUE = rf"(?:\s{_PLAIN}|\d|[)\]])"
_NO_VALUE = "|".join(sorted(OPERATOR_WORDS | {"if", "then", "rule"}))
_CONDITION = rf"\s(?!(?:{_NO_VALUE})\s)\S*[\w)\]\"%°]"  # its last token
_TYPES = r"float(?:32|64)?|double|u?int(?:8|16|32|64)?|bool|boolean|string|char|auto|var|let"
_STANDARD = r"Bool|Byte|Char|String|Float(?:32|64)|U?Int(?:8|16|32|64)"
_ITEM = "|".join(ITEM_WORDS)
_ONE_WORD = rf"{_NAME}(?:(?:\s-)?\x20{_NAME})+|\""


class Habit(NamedTuple):
    """A frequent mistake and its correction.

    `meant` replaces the group `x` of `pattern`, and may refer to the pattern's groups. For a pair
    of brackets, it is the text for both, with a space between them. It is None if the correction is
    uncertain; `advice` then describes the correction.

    With `is_final`, the tokens stay unchanged, and their part of the file is not parsed further.
    With `drops`, the tokens are removed if `meant` is None. `inside` is the kind of item that
    contains the mistake; it is empty if the pattern is specific enough. `outside` is the kind of
    item in which the text is no mistake of this kind.
    """

    pattern: re.Pattern[str]
    meant: str | None
    problem: str
    advice: str = ""
    is_final: bool = False
    drops: bool = False
    inside: str = ""
    outside: str | None = None


class NearMiss(NamedTuple):
    """A place that needs one of `words`. `others` are words with the same meaning. `inside` and
    `outside` are as in a habit.
    """

    pattern: re.Pattern[str]
    words: tuple[str, ...]
    others: Mapping[str, str] = {}
    inside: str = ""
    outside: str | None = None


def _habit(
    pattern: str,
    meant: str | None,
    problem: str,
    advice: str = "",
    *,
    is_final: bool = False,
    drops: bool = False,
    inside: str = "",
    outside: str | None = None,
) -> Habit:
    is_final = is_final or meant is None
    return Habit(re.compile(pattern), meant, problem, advice, is_final, drops, inside, outside)


_SEVERAL_WORDS = "a name is one word"
_NO_TYPE = "values are declared without a type"
_ACTIONS_IN_BRACES = "the actions of a rule stand in braces"
_THEN = "the actions of a rule follow `then`"
_NO_SEMICOLON = "a rule goes on after its condition"
_DOCUMENTATION = "documentation is written `'''...'''`"
_WHOLE_NAME = "a topic is called by its whole name, which begins with `/`"
_CONTRACT = "a resume contract stands after the actions"

HABITS = (
    # Names and declarations.
    _habit(rf"(?<!\. )\bconst\s(?P<x>{_TYPES})(?=\s{_NAME} =\s)", "", _NO_TYPE, "remove it"),
    _habit(rf"(?<!\. )\binput\s(?P<x>{_TYPES})(?=\s{_NAME} =\s)", "", _NO_TYPE, "remove it"),
    _habit(rf"(?<!\. )\brule\s(?P<x>{_ONE_WORD})(?=\s:)", "{name}", _SEVERAL_WORDS),
    _habit(rf"(?<!\. )\b(?:const|input)\s(?P<x>{_ONE_WORD})(?=\s=\s)", "{name}", _SEVERAL_WORDS),
    _habit(rf"(?<!\. )\b(?:entity|system)\s(?P<x>{_ONE_WORD})(?=\s\{{)", "{name}", _SEVERAL_WORDS),
    _habit(rf"(?<!\. )\baction\s(?P<x>{_ONE_WORD})(?=\s;)", "{name}", _SEVERAL_WORDS),
    _habit(
        rf"\binput\s{_NAME}(?P<x>(?:\s,\s{_NAME})+)(?=\s=\s)",
        None,
        "an input has one name",
        "declare one input for each value: `input NAME = topic /TOPIC ...`",
        drops=True,
    ),
    _habit(
        rf"\b(?:entity|system)\s{_NAME}\s(?P<x>=)(?=\s\{{)",
        "",
        "the conditions of an entity follow its name",
        "remove the `=`",
    ),
    _habit(
        rf"[\w;}}\])%](?<!\bimport)(?<!\bmessages)\n(?P<x>\")(?=\s(?:{_ITEM})\b)",
        "'''{text}'''",
        _DOCUMENTATION,
    ),
    _habit(rf"(?:\A|\s;)\s(?P<x>\")(?=\s(?:{_ITEM})\b)", "'''{text}'''", _DOCUMENTATION),
    _habit(
        r"(?:\A|[;}])\s(?P<x>latched)(?=\s(?:rule|if)\b)",
        None,
        _CONTRACT,
        "write `rule NAME: if CONDITION then { ACTION; } latched until reset;`",
        drops=True,
    ),
    _habit(rf"[{{;]\s{_NAME} :\s(?P<x>if)(?=\s)", "", "a condition has no `if`", "leave `if` out"),
    _habit(
        rf"\btopic\s[/\w ]{{1,200}}:\s(?P<x>{_STANDARD})(?=\s)(?!\s/)",
        "std_msgs/{x}",
        "the package of the message type is missing",
        is_final=True,
    ),
    _habit(
        rf"\btopic\s(?P<x>{_NAME}(?: /\s{ANY_NAME})+)(?=\s[:.;])",
        "/{x}",
        _WHOLE_NAME,
        is_final=True,
    ),
    _habit(
        rf"\btopic\s(?P<x>(?:/\s)?(?:\w+\s[/-]\s)*{ANY_NAME} - \w+(?:\s[/-]\s\w+)*)(?=\s[:.;])",
        None,
        "a topic of ROS has no `-` in its name",
        "name it as its publisher does: letters, digits and `_`, in parts that begin with `/`",
        is_final=True,
    ),
    _habit(
        rf"\s{ANY_NAME}\s(?P<x>: :)(?=\s{ANY_NAME})",
        "/",
        "a message type is written `PACKAGE/TYPE`",
        is_final=True,
    ),
    # Rules.
    _habit(
        rf"\b(?P<x>then\s(?P<a>{_NAME}))(?!\s;?\s?[}}(]| ; {_NAME} ;)(?=\s)",
        "then {{ {a}; }}",
        _ACTIONS_IN_BRACES,
        outside="action",  # there, the word after the time of a goal is correct
    ),
    _habit(
        rf"(?P<x>->\s(?P<a>{_NAME}))(?=\s;)",
        "then {{ {a}; }}",
        _ACTIONS_IN_BRACES,
        inside="rule",
    ),
    _habit(r"(?<!\bthen\s)(?P<x>[-=]>)(?=\s\{)", "then", _THEN, inside="rule"),
    _habit(rf"(?<!\brule)(?<!\bthen){_CONDITION}\s(?P<x>:)(?=\s\{{)", "then", _THEN, inside="rule"),
    _habit(r"(?P<x>;)(?=\sthen\s\{)", "", _NO_SEMICOLON, "remove the `;`"),
    _habit(r"\bthen\s(?P<x>;)(?=\s\{)", "", _NO_SEMICOLON, "remove the `;`"),
    _habit(
        rf"[{{;]\s{_NAME}\s(?P<x>\( \))(?=\s[;}}])",
        "",
        "an action is named, not called",
        "remove the `()`",
    ),
    # Intervals.
    _habit(
        r"\[\s[^][;{}]*(?P<x>;)(?=\s[^][;{}]*\])", ",", "a comma stands between two numbers here"
    ),
    _habit(rf"\d\s(?P<x>\.\.)(?=\s{_NUMBER})", ", ", "a comma stands between two numbers here"),
    _habit(
        rf"{_VALUE}\s(?P<x>between\s(?P<a>{_NUMBER})\sand\s(?P<b>{_NUMBER}))",
        "in [{a}, {b}]",
        "a range is written `in [LOW, HIGH]`",
    ),
    _habit(
        rf"{_VALUE}\s(?P<x>between)(?=\s)",
        None,
        "a range is written `in [LOW, HIGH]`",
        "write `VALUE in [LOW, HIGH] UNIT`",
    ),
    _habit(rf"{_VALUE}\s(?P<x>not)(?=\s\[)", "not in", "a range needs `in`"),
    # Operators and values.
    _habit(rf"{_VALUE}\s(?P<x>is not)(?=\s)", "!=", "this is how other languages write it"),
    _habit(rf"{_VALUE}\s(?P<x>is)(?=\s)", "==", "this is how other languages write it"),
    _habit(
        rf"{_VALUE}\s(?P<x>xor)(?=\s)",
        None,
        "there is no `xor`",
        "write `(a or b) and not (a and b)`",
    ),
    _habit(
        rf"\d\s{ANY_NAME}(?:\s[*/.]\s{ANY_NAME})*\s(?P<x>\* \*)(?=\s\d)",
        "^",
        "the power of a unit is written with `^`",
        is_final=True,
    ),
    _habit(r"(?P<x>\* \*)", None, "there are no powers of values", "multiply instead: `x * x`"),
    _habit(
        r"\d\s(?P<x>\[\s(?P<a>[A-Za-z%][^][,;{}]*?)\s\])",
        "{a}",
        "a unit stands after its number without brackets",
        is_final=True,
    ),
    _habit(
        rf"\s{_PLAIN}\s(?P<x>%)(?=\s[\w(])",
        None,
        "there is no remainder operator",
        "count in the node that publishes the value, and compare its result",
    ),
    _habit(
        r"(?:[=(\[,<>]|:|\b(?:if|and|or|not|in|for|timeout))\s(?P<x>\+)(?=\s[\w(])",
        "",
        "a number has no `+` in front of it",
        "remove it",
    ),
    _habit(
        r"(?<![\w.])(?P<x>\d{1,20}\s_[\d_]{1,40})(?=\s)",
        "{digits}",
        "the digits of a number stand together",
    ),
    # Quotation marks and dashes from other keyboards.
    _habit(
        r"(?P<x>(?P<q>['`])\s?(?P<a>[^\n'`\"]*?)\s?(?P=q))",
        '"{a}"',
        "a string stands in double quotes",
    ),
    _habit(
        '(?P<x>[\u201c\u201d\u201e]\\s?(?P<a>[^\\n\u201c\u201d\u201e"]*?)\\s?[\u201c\u201d])',
        '"{a}"',
        "a string stands in straight quotes",
    ),
    _habit("(?P<x>[\u2010-\u2015\u2212])", "-", "a minus is written `-`"),
)

_IF = {**{word: "if" for word, meant in MEANT.items() if meant == "if"}, "while": "if"}

NEAR_MISSES = (
    NearMiss(re.compile(rf"\brule\s{_NAME} :\s(?P<x>{_NAME})(?=\s[\w(])"), ("if",), _IF),
    NearMiss(
        re.compile(rf"{_CONDITION}\s(?P<x>{_NAME})(?=\s\{{)"),
        ("then",),
        {"do": "then", "when": "then"},
        "rule",
    ),
    NearMiss(re.compile(rf"\binput\s{_NAME} =\s(?P<x>{_NAME})(?=\s[/A-Za-z])"), ("topic",)),
    NearMiss(
        re.compile(rf'\binput\s[^;{{}}]{{0,300}}?\s(?P<x>{_NAME})(?=\s\[\s")'),
        ("names",),
        {"name": "names", "named": "names"},
    ),
    NearMiss(re.compile(rf"[\w)\]]\s(?P<x>{_NAME})(?=\s\d)"), ("timeout", "for", "within"), {}),
    NearMiss(re.compile(rf"[\w)\]]\s(?P<x>{_NAME})(?=\s[A-Za-z(])"), ("since",)),
    NearMiss(re.compile(rf"\}}\s(?P<x>{_NAME})(?=\s(?:for|when|until)\b)"), ("clear", "latched")),
    NearMiss(
        re.compile(
            rf"\bnode\s{_NAME}\s\{{(?:\s[^{{}}]{{0,300}}?;)??"
            rf"\s(?P<x>(?!publishes\b|subscribes\b){_NAME})(?=\s[/A-Za-z])"
        ),
        ("publishes", "subscribes"),
        {"pub": "publishes", "sub": "subscribes"},
    ),
)

PAIRS = (
    _habit(
        rf"(?<!\. )\brule\s{_NAME}\s(?P<x>\{{)(?=\sif\b)",
        ": ",
        "a rule is written without braces around it",
        "write `rule NAME: if CONDITION then { ACTION; };`",
    ),
    _habit(
        rf"(?<!\. )\b(?:entity|system)\s{_NAME}\s(?P<x>\()",
        "{ }",
        "the conditions of an entity stand in braces",
        "write `entity NAME { CONDITION : EXPRESSION; }`",
    ),
    _habit(
        rf"\bin\s(?P<x>\()(?=\s{_NUMBER}\s,)",
        "[ ]",
        "the two ends of a range stand in square brackets",
        "write `in [LOW, HIGH]`; both ends belong to the range",
    ),
)
