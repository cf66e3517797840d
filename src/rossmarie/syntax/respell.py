"""Replaces tokens as written by the intended tokens.

Two mistakes are corrected, so that each costs one finding and nothing around it: keywords in
capitals (`IF`, `THEN`), and numbers with a missing digit or a comma (`.5`, `1.`, `1,5`). A token is
changed only if no correct file can contain it. Its span stays, so its text then differs from the
text of the file.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from itertools import chain

from dslkit.diagnostics import Diagnostic, Edit, Fix, Write
from rossmarie.syntax import errors
from rossmarie.syntax.findings import LimitedFindings
from rossmarie.syntax.scan import ScannedFile, Token, ends_line
from rossmarie.syntax.words import ITEM_WORDS, MEMBER_WORDS, PART_WORDS, RESERVED

_KEYWORDS = RESERVED | MEMBER_WORDS.keys() | PART_WORDS
_BEHIND_VALUE = frozenset({"and", "or", "not", "in", "for", "then", "timeout"})
_BEHIND_BRACE = frozenset({"clear", "latched"})
_INSIDE_SYSTEM = MEMBER_WORDS.keys() | {"publishes", "subscribes"}
_BEHIND_WORD = {
    ("clear", "when"),
    ("clear", "for"),
    ("latched", "until"),
    ("until", "reset"),
    ("edges", "of"),
}
_THOUSANDS = 3  # digits after a comma that may separate thousands


def respell(source: ScannedFile, findings: LimitedFindings) -> ScannedFile:
    """The file with keywords in small letters and numbers with all digits. Each change is
    reported.
    """
    text = source.file.text
    tokens = tuple(_respell(source.tokens, text))
    for token in tokens:
        if findings.is_full:
            break
        if token.text != text[token.start : token.end]:
            is_number = token.kind == "number"
            findings.add(_bad_number(source, token) if is_number else _capitals(source, token))
    return dataclasses.replace(source, tokens=tokens)


def _capitals(source: ScannedFile, token: Token) -> Diagnostic:
    span = source.span(token)
    fix = Fix(f"write `{token.text}`", (Edit(span, token.text),))
    return errors.KeywordInCapitals(found=span.text, meant=token.text).at(span, fix=fix)


def _bad_number(source: ScannedFile, token: Token) -> Diagnostic:
    span = source.span(token)
    whole, _, rest = token.text.partition(".")
    reason = f"a digit is missing {'in front of' if span.text[0] == '.' else 'after'} the point"
    if "," in span.text:
        reason = "decimals begin with a point, not with a comma"
    finding = errors.MalformedNumber(found=span.text, reason=reason)
    if "," in span.text and len(rest) == _THOUSANDS:
        help = finding.Thousands(decimals=token.text, whole=f"{whole}{rest}")
        return finding.at(span, help=help)
    follows = span.file.text[span.end : span.end + 1]
    gap = " " if span.text.endswith(".") and follows.isalpha() else ""
    fix = Fix(f"write `{token.text}`", (Edit(span, f"{token.text}{gap}"),))
    return finding.at(span, help=Write(meant=token.text), fix=fix)


def _respell(tokens: Sequence[Token], text: str) -> list[Token]:
    found: list[Token] = []
    takes_commas: list[bool] = []  # one entry for each open `(` and `[`
    for token, after in zip(tokens, chain(tokens[1:], (None,)), strict=False):
        if token.text in ("(", "["):
            is_call = bool(found) and found[-1].kind == "word" and found[-1].text not in _KEYWORDS
            takes_commas.append(token.text == "[" or is_call)
        elif token.text in (")", "]"):
            takes_commas = takes_commas[:-1]
        elif token.text in (";", "{", "}"):
            takes_commas = []
        if token.kind == "number":
            token = token._replace(text=_number(token.text))
            if not (takes_commas and takes_commas[-1]) and _is_behind_comma(found, token):
                token = _joined(found[-2], token)
                del found[-2:]
        elif token.kind == "word" and _is_keyword(found, token, after, text):
            token = token._replace(text=token.text.lower())
        found.append(token)
    return found


def _number(text: str) -> str:
    """`0.5` for `.5`, `1.0` for `1.`."""
    whole, point, rest = text.partition(".")
    if point and not rest[:1].isdigit():
        rest = f"0{rest}"
    return f"{whole or '0'}{point}{rest}"


def _is_behind_comma(found: Sequence[Token], token: Token) -> bool:
    """Say whether digits, a comma and digits follow without a space."""
    if len(found) < 2 or not token.text[0].isdigit() or "." in token.text:
        return False
    number, comma = found[-2:]
    is_whole = number.kind == "number" and number.text.isdecimal()
    return is_whole and comma.text == "," and number.end + 1 == comma.end == token.start


def _joined(whole: Token, rest: Token) -> Token:
    return Token("number", f"{whole.text}.{rest.text}", whole.start, rest.end)


def _is_keyword(before: Sequence[Token], token: Token, after: Token | None, text: str) -> bool:
    """Say whether a word is a keyword in capitals. In a correct file, a name is never such a
    word.
    """
    word = token.text.lower()
    if word == token.text or word not in _KEYWORDS:
        return False
    last = before[-1] if before else None
    follows = "" if after is None else after.text
    begins_line = last is None or ends_line(text[last.end : token.start])
    if word in ITEM_WORDS and (begins_line or (last is not None and last.text in (";", "}"))):
        return _goes_on(after) or (word, follows) in (("if", "("), ("rule", "if"))
    if last is None:
        return False
    opener = before[-3].text if len(before) > 2 else ""
    return (
        (word in _BEHIND_VALUE and _ends_value(last) and follows not in (":", "="))
        or (word in _BEHIND_BRACE and last.text == "}" and _is_word(after))
        or (last.text, word) in _BEHIND_WORD
        or (word in _INSIDE_SYSTEM and last.text in ("{", ";") and _names_topic(after))
        or (opener, last.text, word) in (("rule", ":", "if"), ("input", "=", "topic"))
        or (word == "times" and last.kind == "number")
        or (word in ("within", "by") and last.text == "," and _is_kind(after, "number"))
        or (word == "within" and _ends_value(last) and _is_kind(after, "number"))
        or (word == "not" and last.text != "." and (_goes_on(after) or follows == "("))
    )


def _ends_value(token: Token) -> bool:
    if token.kind == "word":
        return token.text not in _KEYWORDS
    return token.kind in ("number", "text") or token.text in (")", "]")


def _goes_on(after: Token | None) -> bool:
    """Say whether a text, or a word that is not a keyword, follows. Neither ever follows a name."""
    return after is not None and (
        after.kind == "text" or (after.kind == "word" and after.text not in _KEYWORDS)
    )


def _names_topic(after: Token | None) -> bool:
    return _goes_on(after) or (after is not None and after.text == "/")


def _is_word(after: Token | None) -> bool:
    return _is_kind(after, "word")


def _is_kind(after: Token | None, kind: str) -> bool:
    return after is not None and after.kind == kind
