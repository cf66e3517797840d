"""Colours for rules files: a lexer for Pygments, with the keywords of the grammar.

`get_lexer_by_name("ross")` finds the lexer where this package is installed. Documentation
generators and terminals that use Pygments then colour `.ross` files without further settings.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import ClassVar

from pygments.lexer import RegexLexer, bygroups, words
from pygments.token import Comment, Keyword, Name, Number, Operator, Punctuation, String, Whitespace

import rossmarie.syntax
from rossmarie.syntax.words import RESERVED

GRAMMAR = Path(rossmarie.syntax.__file__).with_name("ross.lark")
CONSTANTS = frozenset({"true", "false", "unknown"})
_DECLARATIONS = (
    *("action", "const", "entity", "frame", "hazard", "input", "motion", "node", "parameter"),
    *("resource", "rule", "system", "zone"),
)
"""The words before a name that the user declares."""
_ENDINGS = frozenset(
    {"activation", "down", "drop", "margin", "replan", "resend", "reset", "resume", "retry", "up"}
)
"""The words that can end a phrase, so that a `;` or a `,` may follow."""
_NAME = r"[^\W\d]\w*"
_UNIT = r"(?:[^\W\d_]|[%°])[\w%°]*(?:\^-?[0-9]+)?"


def keywords() -> frozenset[str]:
    """The words that the grammar has in quotes."""
    return frozenset(re.findall(r'"([a-z]+)"', GRAMMAR.read_text(encoding="utf-8")))


_WORDS = sorted(keywords())
_ANY_WORD = words(_WORDS, suffix=r"\b").get()
_FREE = sorted(keywords() - RESERVED - _ENDINGS - CONSTANTS)
_UNITS = rf"(?!{_ANY_WORD}){_UNIT}(?:[.*/]{_UNIT})*"
# A word that may be a name is a keyword if a value or another name follows.
_NO_NAME = r"\b(?!\(|\s*[;.,:=}\])]|\s+(?:and|else|or|over|then|unless)\b)"


class RossLexer(RegexLexer):  # type: ignore[misc] # Pygments has no types
    """The lexer of `.ross` files. Neighbouring words decide whether a word is a keyword."""

    name = "ROSSMARie"
    aliases: ClassVar = ["ross", "rossmarie"]
    filenames: ClassVar = ["*.ross"]

    tokens: ClassVar = {
        "root": [
            (r"\s+", Whitespace),
            (r"//[^\r\n]*", Comment.Single),
            (r"'''(?s:.*?)'''", String.Doc),
            (r'"[^"\r\n]*"', String),
            (r"([0-9]+)([ \t]+)(times)\b", bygroups(Number, Whitespace, Keyword)),
            (
                rf"([0-9]+(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?)([ \t]*)({_UNITS})",
                bygroups(Number, Whitespace, Keyword.Type),
            ),
            (r"[0-9]+(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?", Number),
            (rf"(\])([ \t]*)({_UNITS})", bygroups(Punctuation, Whitespace, Keyword.Type)),
            (rf"(\.)({_NAME})(?=\()", bygroups(Punctuation, Name.Function)),
            (rf"(\.)({_NAME})", bygroups(Punctuation, Name.Attribute)),
            (rf"(?<![\w)\]])/{_NAME}(?:/\w+)*", Name.Variable.Global),
            (r"[A-Za-z]\w*/(?:(?:msg|srv|action)/)?[A-Z]\w*", Name.Class),
            (
                rf"({'|'.join(_DECLARATIONS)})([ \t]+)({_NAME})\b(?![ \t]+(?:over|per)\b)",
                bygroups(Keyword.Declaration, Whitespace, Name.Entity),
            ),
            (words(sorted(CONSTANTS), prefix=r"\b", suffix=r"\b"), Keyword.Constant),
            (words(sorted((RESERVED - CONSTANTS) | _ENDINGS), prefix=r"\b", suffix=r"\b"), Keyword),
            (words(_FREE, prefix=r"\b", suffix=_NO_NAME), Keyword),
            (rf"{_NAME}(?=\()", Name.Function),
            (_NAME, Name),
            (r"\.\.|[=!<>]=|[-+*/<>=^%°]", Operator),
            (r"[{}()\[\],;:.]", Punctuation),
        ]
    }
