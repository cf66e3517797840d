"""Explanations of syntax errors: the reason why a range of tokens does not parse, and the
correction.

The input is the range, its intended kind, and the place at which the parser stopped. The result is
the most specific finding that fits; for unclosed texts, one finding each.
"""

from __future__ import annotations

import dataclasses
import re
import unicodedata
from collections.abc import Sequence

from dslkit.diagnostics import Diagnostic, Edit, Fix, Label, Remark
from dslkit.source import Span
from rossmarie.syntax import errors
from rossmarie.syntax.grammar import ParseFailure
from rossmarie.syntax.scan import ScannedFile, Token
from rossmarie.syntax.temporal import PREFIXES, is_operator
from rossmarie.syntax.words import FORMS, OPERATOR_WORDS, PART_WORDS, RESERVED, nearest

_PARTNER = {"(": ")", "[": "]", "{": "}", ")": "(", "]": "[", "}": "{"}
_SIGNS = frozenset("{}()[]:;,.=<>!+-*/&|%°^≤≥≠")
_VALUE = "$NUMBER"
_NAMES_AT_LEAST = 5  # tokens of an input that come before any names of elements
_ARRIVES_AT = 3  # the place of `topic` in an input
_THEN = re.compile(r"\s+then\s*\{")
_ADVICE = {
    "#": "write comments as `// ...`",
    "'": 'write strings in double quotes, `"..."`',
    "`": 'write strings in double quotes, `"..."`',
    "$": "write the name of a constant as it is, without `$`",
    "@": "remove it",
    "^": "powers exist in units only; multiply instead",
}


def explain(
    source: ScannedFile, first: int, last: int, kind: str, failure: ParseFailure
) -> tuple[Diagnostic, ...]:
    """The findings for the tokens from `first` up to, not including, `last`. Their intended kind is
    `kind`.
    """
    tokens = source.tokens[first:last]
    if any(token.start in source.reported for token in tokens):
        return ()
    unclosed = [token for token in tokens if token.kind == "open_text"]
    if unclosed:
        return tuple(unterminated_text(source, token) for token in unclosed)
    case = _Case(source, first, last, kind, failure)
    return (case.finding(),)


def unterminated_text(source: ScannedFile, token: Token) -> Diagnostic:
    """A text without a closing quotation mark. The fix closes it before `then {` or a final `;`."""
    text = source.file.text
    if '\\"' in text[text.rfind("\n", 0, token.start) + 1 : token.start]:
        finding = errors.UnterminatedString()
        return finding.at(source.span(token), help=finding.Escape())
    content = token.text.rstrip()
    then = _THEN.search(content)
    ends = content.endswith(";") and len(content) > 1
    at = token.start + (then.start() if then else len(content) - ends)
    place = Span(source.file, at, at)
    fix = Fix('insert `"`', (Edit(place, '"'),))
    return errors.UnterminatedString().at(source.span(token), fix=fix)


def missing_sign(
    source: ScannedFile, sign: str, behind: Token, kind: str, inserted: str | None = None
) -> Diagnostic:
    """A missing sign directly after a token."""
    end = Span(source.file, behind.end, behind.end)
    fix = Fix(f"insert `{sign}`", (Edit(end, inserted or sign),))
    finding = errors.MissingSign(sign=sign, place="after", form=FORMS[kind])
    return finding.at(source.span(behind), fix=fix)


def wrong_sign(source: ScannedFile, sign: str, found: Token, kind: str) -> Diagnostic:
    """A wrong sign in the place of another sign."""
    fix = Fix(f"write `{sign}`", (Edit(source.span(found), sign),))
    finding = errors.MissingSign(sign=sign, place="instead of", form=FORMS[kind])
    return finding.at(source.span(found), fix=fix)


def unclosed_bracket(
    source: ScannedFile, bracket: Token, behind: Token, *labels: Label, inserted: str | None = None
) -> Diagnostic:
    """A bracket that is missing after a token."""
    closing = _PARTNER[bracket.text]
    end = Span(source.file, behind.end, behind.end)
    text = inserted or ("\n}" if closing == "}" else closing)
    fix = Fix(f"insert `{closing}`", (Edit(end, text),))
    finding = errors.UnclosedBracket(bracket=bracket.text, closing=closing)
    return finding.at(source.span(bracket), *labels, fix=fix)


def unopened_bracket(source: ScannedFile, bracket: Token) -> Diagnostic:
    """A superfluous closing bracket."""
    fix = Fix(f"remove `{bracket.text}`", (Edit(source.span(bracket), ""),))
    finding = errors.UnopenedBracket(bracket=bracket.text, opening=_PARTNER[bracket.text])
    return finding.at(source.span(bracket), fix=fix)


def reserved_word(source: ScannedFile, token: Token) -> Diagnostic:
    """A keyword in the place of a name."""
    suggestion = f"{token.text}_value" if token.text != "action" else "action_name"
    finding = errors.ReservedWord(word=token.text, suggestion=suggestion)
    return finding.at(source.span(token))


def is_name(token: Token) -> bool:
    """Say whether a token can be a name."""
    return token.kind == "word" and token.text.isascii() and token.text not in RESERVED


def is_part_word(token: Token) -> bool:
    """Say whether a token is, or resembles, a word that continues an item."""
    return nearest(token.text, PART_WORDS) is not None


def unexpected_character(source: ScannedFile, token: Token) -> Diagnostic:
    """The first character of a token that no token may contain."""
    offset = next(
        (
            at
            for at, letter in enumerate(token.text)
            if letter not in _SIGNS
            and not (letter.isascii() and (letter.isalnum() or letter == "_"))
        ),
        0,
    )
    letter = token.text[offset]
    advice = _ADVICE.get(letter, "remove it")
    if token.kind == "word":
        advice = "names consist of the letters a-z and A-Z, digits and `_`"
    start = token.start + offset
    finding = errors.UnexpectedCharacter(character=_describe(letter), advice=advice)
    return finding.at(Span(source.file, start, start + 1))


def hash_comment(source: ScannedFile, token: Token) -> Diagnostic:
    """A comment `# ...`."""
    sign = Token("sign", "#", token.start, token.start + 1)
    finding = unexpected_character(source, sign)
    fix = Fix("begin it with `//`", (Edit(source.span(sign), "//"),))
    return dataclasses.replace(finding, fix=fix)


def is_foreign(token: Token) -> bool:
    """Say whether a token contains a character that no token may contain."""
    if token.kind == "sign":
        return token.text[0] not in _SIGNS
    return token.kind == "word" and not token.text.isascii()


def _describe(letter: str) -> str:
    code = f"U+{ord(letter):04X}"
    if letter.isascii():
        return f"`{letter}`" if letter.isprintable() else f"the control character {code}"
    name = unicodedata.name(letter, "a character without a name").lower()
    return f"`{letter}` ({code}, {name})" if letter.isprintable() else f"the character {code}"


def explain_token(source: ScannedFile, index: int, kind: str) -> Diagnostic:
    """A single token that is not allowed in a part of kind `kind`."""
    found = source.tokens[index]
    if found.kind == "open_text":
        return unterminated_text(source, found)
    if is_foreign(found):
        return unexpected_character(source, found)
    if found.text in RESERVED and kind == "actions":
        return reserved_word(source, found)
    before = _shown(source.tokens[index - 1]) if index else "the beginning"
    finding = errors.MisplacedWord(found=_shown(found), before=before, form=FORMS[kind])
    return finding.at(source.span(found))


class _Case:
    """One failure. The methods try explanations, the most specific first."""

    def __init__(
        self, source: ScannedFile, first: int, last: int, kind: str, failure: ParseFailure
    ) -> None:
        self._source = source
        self._tokens: Sequence[Token] = source.tokens
        self._first = first
        self._last = last
        self._kind = kind
        self._index = min(first + failure.index, last)
        self._expected = failure.expected
        self._form = FORMS[kind]
        if "$TYPE_NAME" in failure.expected:
            self._form = "a message type is written `PACKAGE/TYPE`, such as `sensor_msgs/Imu`"
        elif kind == "input" and self._text_at(_ARRIVES_AT) == "doing":
            self._form = FORMS["skill_number"]
        elif kind == "unless" and self._text_at(1) == "doing":
            self._form = FORMS["exemption"]
        elif kind == "input" and self._is_at_names():
            self._form = FORMS["element_names"]
        elif failure.expected == {_VALUE}:
            self._form = "an element of an array is chosen by a whole number, as in `ranges[0]`"
        elif failure.expected & {"within", ","} and self._is_over_time():
            self._form = FORMS["over_time"]

    def finding(self) -> Diagnostic:
        """The best explanation."""
        if self._index >= self._last:
            return self._bracket() or self._at_end()
        return self._character() or self._bracket() or self._name() or self._value() or self._sign()

    def _is_over_time(self) -> bool:
        """Say whether a `once` or an `after` precedes the failure."""
        tokens = self._tokens
        return any(
            tokens[index].text in PREFIXES and is_operator(tokens, index)
            for index in range(self._first, self._index)
        )

    def _is_at_names(self) -> bool:
        """Say whether the tokens up to here end with names of elements in an input."""
        around = self._tokens[self._first + _NAMES_AT_LEAST : min(self._index + 1, self._last)]
        return any(token.text in ("names", "[") for token in around)

    def _text_at(self, place: int) -> str:
        """The token at a place in the stretch."""
        index = self._first + place
        return self._tokens[index].text if index < self._last else ""

    @property
    def _found(self) -> Token:
        return self._tokens[self._index]

    @property
    def _before(self) -> Token | None:
        return self._tokens[self._index - 1] if self._index > self._first else None

    def _character(self) -> Diagnostic | None:
        found = self._found
        is_stray = found.text == "^" or is_foreign(found)
        return unexpected_character(self._source, found) if is_stray else None

    def _bracket(self) -> Diagnostic | None:
        """A bracket before the failure that is never closed, or a superfluous closing bracket."""
        stack: list[Token] = []
        for index in range(self._first, self._last):
            token = self._tokens[index]
            if token.text in ("(", "[", "{"):
                stack.append(token)
            elif token.text in (")", "]", "}"):
                if stack and _PARTNER[stack[-1].text] == token.text:
                    stack.pop()
                elif index <= self._index and not stack:
                    return unopened_bracket(self._source, token)
                else:
                    break
        if not stack or stack[-1].start >= self._offset() or self._operand_is_missing():
            return None
        last = self._tokens[min(self._index, self._last) - 1]
        return unclosed_bracket(self._source, stack[-1], last)

    def _offset(self) -> int:
        if self._index < self._last:
            return self._found.start
        return self._tokens[self._last - 1].end

    def _operand_is_missing(self) -> bool:
        return {_VALUE, "$NAME"} <= self._expected

    def _name(self) -> Diagnostic | None:
        if "$NAME" not in self._expected:
            return None
        found, before = self._found, self._before
        is_operator = found.text in OPERATOR_WORDS or found.text == "then"
        if found.text in RESERVED and not (is_operator and _VALUE in self._expected):
            return reserved_word(self._source, found)
        if _VALUE in self._expected or before is None:
            return None
        finding = errors.MissingName(place="after", form=self._form)
        return finding.at(self._source.span(before), help=self._help_with_unit(before))

    def _help_with_unit(self, before: Token) -> Remark | None:
        """The help for `at 0 speed = 1 m/s`, where the name of the input was read as the unit of
        the instant.
        """
        at, number = self._index - 3, self._index - 2
        if at < self._first or self._tokens[at].text != "at":
            return None
        if self._tokens[number].kind != "number":
            return None
        return errors.MissingName.NoUnit(number=self._tokens[number].text, name=before.text)

    def _value(self) -> Diagnostic | None:
        if not self._operand_is_missing():
            return None
        before = self._before
        if before is None or before.text in ("(", "["):
            finding = errors.MissingValue(place="before", sign=self._found.text, form=self._form)
            return finding.at(self._source.span(self._found))
        if self._found.text == "->":
            return self._misplaced(before)
        finding = errors.MissingValue(place="after", sign=before.text, form=self._form)
        return finding.at(self._source.span(before))

    def _sign(self) -> Diagnostic:
        found, before = self._found, self._before
        if before is None:
            return explain_token(self._source, self._index, self._kind)
        if ";" in self._expected and found.text == "}":
            return missing_sign(self._source, ";", before, self._kind)
        if ":" in self._expected and found.kind == "word" and self._text_behind() == "/":
            return missing_sign(self._source, ":", before, self._kind, " :")
        sign = next((sign for sign in ("=", ":", "{", "if", "topic") if self._is_only(sign)), None)
        if sign is None:
            return self._misplaced(before)
        if found.kind != "sign" or found.text in ("[", "(", "-", "/"):
            return missing_sign(self._source, sign, before, self._kind, f" {sign}")
        return wrong_sign(self._source, sign, found, self._kind)

    def _text_behind(self) -> str:
        """The token after the token that does not fit."""
        behind = self._index + 1
        return self._tokens[behind].text if behind < self._last else ""

    def _is_only(self, sign: str) -> bool:
        """Say whether a sign is the only possible continuation."""
        return sign in self._expected and len(self._expected) <= 3

    def _misplaced(self, before: Token) -> Diagnostic:
        found = self._found
        finding = errors.MisplacedWord(found=_shown(found), before=_shown(before), form=self._form)
        return finding.at(self._source.span(found))

    def _at_end(self) -> Diagnostic:
        last = self._tokens[self._last - 1]
        if self._operand_is_missing():
            finding = errors.MissingValue(place="after", sign=last.text, form=self._form)
            return finding.at(self._source.span(last))
        if "$NAME" in self._expected and _VALUE not in self._expected:
            name = errors.MissingName(place="after", form=self._form)
            return name.at(self._source.span(last))
        return errors.Unfinished(form=self._form).at(self._source.span(last))


def _shown(token: Token) -> str:
    """A token for a message; a long token is shortened."""
    return token.text if len(token.text) <= 40 else f"{token.text[:37]}..."
