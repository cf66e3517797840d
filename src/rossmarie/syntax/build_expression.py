"""Build the nodes of an expression from the rules that the grammar recognises.

One method per rule of ross.lark, as in `build`, which describes their arguments and guarantees.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from dslkit.diagnostics import Diagnostic, Edit, Fix, Remark, Write
from dslkit.source import Span
from rossmarie.syntax import ast, errors
from rossmarie.syntax.scan import ScannedFile, Token
from rossmarie.syntax.words import FOREIGN

_MOST_DIGITS = 9  # for an index; no message field has more elements
_LONGEST_ADVICE = 80


class _Comparator(NamedTuple):
    """`<`, `in`, `not in` between two values."""

    text: str
    span: Span


class _Trailer(NamedTuple):
    """`.name`, `.name(...)`, `[0]`, `["name"]`, `[name]` or `[-30 deg .. 30 deg]` after a value;
    the parts distinguish the forms.
    """

    name: ast.Name | None
    arguments: tuple[ast.Expression | WordArgument, ...] | None
    position: int | str | None
    span: Span
    arc: ast.Arc | None = None
    constant: ast.Name | None = None


class WordArgument(NamedTuple):
    """A word and its argument: `3 times`, `within 0.25 sec`, `by 5 N` among the arguments of a
    call, `ramp 20 %/s` and `else stop` after an effect.
    """

    word: str
    value: Any
    span: Span


class _Each(NamedTuple):
    """`o in objects: o.size.x > 1 m` among the arguments of a call."""

    variable: ast.Name
    list: ast.Expression
    body: ast.Expression
    span: Span


class ExpressionBuilder:
    """Builds the expressions of one file, and reports unacceptable ones to `report`."""

    def __init__(self, source: ScannedFile, report: Callable[[Diagnostic], None]) -> None:
        self._source = source
        self._file = source.file
        self._report = report

    def infix(self, parts: list[Any]) -> ast.Expression:
        """`a + b - c`, from the left."""
        value: ast.Expression = parts[0]
        for operator, right in zip(parts[1::2], parts[2::2], strict=True):
            meaning = ast.BinaryOperator(self._spelling(operator.text, self._at(operator)))
            value = ast.Binary(meaning, value, right, value.span.to(right.span))
        return value

    def prefix(self, parts: list[Any]) -> ast.Expression:
        """`not a`, `-a`; a sign before a number is part of the number."""
        operator, operand = parts
        span = self._at(operator).to(operand.span)
        if operator.text != "-":
            self._spelling(operator.text, self._at(operator))
            return ast.Unary(ast.UnaryOperator.NOT, operand, span)
        if isinstance(operand, ast.Number) and not operand.span.text.startswith("-"):
            return ast.Number(-operand.value, operand.unit, span)
        return ast.Unary(ast.UnaryOperator.NEGATE, operand, span)

    def held(self, parts: list[Any]) -> ast.Expression:
        """`a for 4 sec`, `a since b`, from the left."""
        value: ast.Expression = parts[0]
        for word, right in zip(parts[1::2], parts[2::2], strict=True):
            node = ast.Since if word.text == "since" else ast.Held
            value = node(value, right, value.span.to(right.span))
        return value

    def once(self, parts: list[Any]) -> ast.Once:
        """`once a within 4 sec`."""
        return ast.Once(parts[1], parts[3], self._span(parts))

    def response(self, parts: list[Any]) -> ast.Response:
        """`after a, b within 4 sec`."""
        return ast.Response(parts[1], parts[3], parts[5], self._span(parts))

    def doing(self, parts: list[Any]) -> ast.Doing:
        """`doing SKILL(PARAMETER: CLASS, ...)`."""
        arguments = tuple(part for part in parts if isinstance(part, ast.SkillArgument))
        is_ahead = parts[0].text == "ahead"
        return ast.Doing(self.name(parts[1]), arguments, is_ahead, self._span(parts))

    ahead = doing

    def skill_argument(self, parts: list[Any]) -> ast.SkillArgument:
        """`PARAMETER: CLASS`."""
        return ast.SkillArgument(self.name(parts[0]), parts[2], self._span(parts))

    def class_name(self, parts: list[Any]) -> ast.Name:
        """`Fragile`, `skiros.Fragile`."""
        return ast.Name("".join(part.text for part in parts), self._span(parts))

    def not_in(self, parts: list[Any]) -> _Comparator:
        """`not in`."""
        self._spelling(parts[0].text, self._at(parts[0]))
        return _Comparator("not in", self._span(parts))

    def comparison(self, parts: list[Any]) -> ast.Expression:
        """`a < b`, `a in b`. A chain is reported. If all its signs have the same direction, it
        becomes comparisons that are joined by `and`.
        """
        if len(parts) > 3 and not _is_monotonic(parts[1::2]):
            self._report(self._chained(parts))
            return ast.Broken(parts[0].span.to(parts[-1].span))
        value = self._link(*parts[:3])
        meant = value.span.text
        for left, sign, right in zip(parts[2::2], parts[3::2], parts[4::2], strict=False):
            link = self._link(left, sign, right)
            meant += f" and {link.span.text}"
            value = ast.Binary(ast.BinaryOperator.AND, value, link, value.span.to(link.span))
        if len(parts) > 3:
            self._report(self._chained(parts, Edit(value.span, f"({meant})")))
        return value

    def _chained(self, parts: list[Any], edit: Edit | None = None) -> Diagnostic:
        first, second = (
            part.span if isinstance(part, _Comparator) else self._at(part) for part in parts[1:4:2]
        )
        finding = errors.ChainedComparison()
        help: Remark = finding.Two()
        fix = None
        if edit is not None:
            fix = Fix(f"write `{edit.replacement}`", (edit,))
            meant = edit.replacement[1:-1]
            help = Write(meant=meant if len(meant) <= _LONGEST_ADVICE else "a < b and b < c")
        return finding.at(second, finding.First().at(first), help=help, fix=fix)

    def _link(self, left: ast.Expression, sign: Token | _Comparator, right: Any) -> ast.Expression:
        span = left.span.to(right.span)
        if sign.text in ("in", "not in"):
            return ast.Membership(left, right, sign.text == "not in", span)
        at = self._at(sign) if isinstance(sign, Token) else sign.span
        return ast.Binary(ast.BinaryOperator(self._spelling(sign.text, at)), left, right, span)

    def postfix(self, parts: list[Any]) -> ast.Expression:
        """`a.b.c()[0]`."""
        value: ast.Expression = parts[0]
        trailer: _Trailer
        for trailer in parts[1:]:
            span = value.span.to(trailer.span)
            if trailer.arc is not None:
                value = ast.Sector(value, trailer.arc, span)
            elif trailer.name is None:
                at = trailer.position
                index = None if at is None else ast.Index(value, at, span, trailer.constant)
                value = index or ast.Broken(span)
            elif trailer.arguments is None:
                value = ast.Member(value, trailer.name, span)
            else:
                value = self._called(trailer.name, [value, *trailer.arguments], True, span)
        return value

    def member(self, parts: list[Any]) -> _Trailer:
        """`.name`."""
        return _Trailer(self.name(parts[1]), None, None, self._span(parts))

    def method(self, parts: list[Any]) -> _Trailer:
        """`.name(arguments)`."""
        arguments = tuple(_arguments(parts[3:-1]))
        return _Trailer(self.name(parts[1]), arguments, None, self._span(parts))

    def index(self, parts: list[Any]) -> _Trailer:
        """`[0]`, `["elbow"]`, `[elbow]`."""
        token, span = parts[1], self._span(parts)
        if token.kind == "word":
            return _Trailer(None, None, "", span, constant=self.name(token))
        return _Trailer(None, None, self.position(token), span)

    def sector(self, parts: list[ast.Arc]) -> _Trailer:
        """`[-30 deg .. 30 deg]` after a value."""
        return _Trailer(None, None, None, parts[0].span, parts[0])

    def arc(self, parts: list[Any]) -> ast.Arc:
        """`[-30 deg .. 30 deg]`."""
        return ast.Arc(parts[1], parts[3], self._span(parts))

    def reference(self, parts: list[Any]) -> ast.Reference:
        """A name used as a value."""
        name = self.name(parts[0])
        return ast.Reference(name, name.span)

    def call(self, parts: list[Any]) -> ast.Expression:
        """`name(arguments)`; `oscillates` has a form of its own."""
        return self._called(self.name(parts[0]), _arguments(parts[2:-1]), False, self._span(parts))

    def _called(
        self, name: ast.Name, arguments: list[Any], is_method: bool, span: Span
    ) -> ast.Expression:
        if name.text == "oscillates":
            return self._oscillates(name.span, arguments, span)
        if [type(each) for each in arguments] == [ast.Edges, WordArgument]:
            arguments = arguments[:1]  # a comma before `within`; a missing comma is reported
        if len(arguments) == 1 and isinstance(arguments[0], _Each):
            each = arguments[0]
            return ast.ListFold(name, each.variable, each.list, each.body, span)
        plain = tuple(self._plain(argument) for argument in arguments)
        return ast.Call(name, plain, is_method, span)

    def _oscillates(self, name: Span, arguments: list[Any], span: Span) -> ast.Expression:
        shape = [part.word if isinstance(part, WordArgument) else "" for part in arguments]
        if shape not in (["", "times", "within"], ["", "times", "within", "by"]):
            reason = "a value, how often it turns, and within which time, in this order"
            problem = "`oscillates` needs other parts"
            finding = errors.MalformedOscillates(problem=problem, reason=reason)
            self._report(finding.at(name))
            return ast.Broken(span)
        value, count, window, *swing = arguments
        if isinstance(count.value, ast.Broken):
            return ast.Broken(span)
        least = swing[0].value if swing else None
        return ast.Oscillates(value, count.value, window.value, least, span)

    def _plain(self, argument: Any) -> ast.Expression:
        if isinstance(argument, _Each):
            return self._not_alone(argument)
        if not isinstance(argument, WordArgument):
            return argument  # type: ignore[no-any-return]
        problem = f"`{argument.word}` is only allowed in `oscillates`"
        finding = errors.MalformedOscillates(problem=problem, reason="no other function takes it")
        self._report(finding.at(argument.span))
        return ast.Broken(argument.span)

    def _not_alone(self, each: _Each) -> ast.Broken:
        """Report a fold over a list that is not the only argument of its call."""
        form = "`NAME in LIST: CONDITION` stands alone: `any(NAME in LIST: CONDITION)`"
        finding = errors.MisplacedWord(found=each.span.text, before="(", form=form)
        self._report(finding.at(each.span))
        return ast.Broken(each.span)

    def each(self, parts: list[Any]) -> _Each | ast.Broken:
        """`o in objects: CONDITION`. The part before the colon must have this form."""
        head, colon, body = parts
        is_name = isinstance(head, ast.Membership) and isinstance(head.value, ast.Reference)
        if is_name and not head.is_negated:
            return _Each(head.value.name, head.container, body, self._span(parts))
        form = "query the elements of a list with `any(NAME in LIST: CONDITION)`"
        finding = errors.MisplacedWord(found=":", before=head.span.text, form=form)
        self._report(finding.at(self._at(colon)))
        return ast.Broken(self._span(parts))

    def times(self, parts: list[Any]) -> WordArgument:
        """`3 times`."""
        return WordArgument("times", self.number(parts[:1]), self._span(parts))

    def within(self, parts: list[Any]) -> WordArgument:
        """`within 0.25 sec`."""
        return WordArgument("within", parts[1], self._span(parts))

    def edges(self, parts: list[Any]) -> ast.Edges:
        """`edges of a > 1 within 10 sec`."""
        if parts[0].text != "edges":
            problem = "`count` counts `edges of` a condition, or the elements of an array"
            finding = errors.ForeignForm(found=f"{parts[0].text} of", problem=problem)
            fix = Fix("write `edges of`", (Edit(self._at(parts[0]), "edges"),))
            form = finding.Form(form="write `edges of`")
            self._report(finding.at(self._at(parts[0]), help=form, fix=fix))
        window = parts[3].value if len(parts) > 3 else None
        return ast.Edges(parts[2], window, self._span(parts))

    def by(self, parts: list[Any]) -> WordArgument:
        """`by 5 N`."""
        return WordArgument("by", parts[1], self._span(parts))

    def parenthesized(self, parts: list[Any]) -> ast.Parenthesized:
        """`(a)`."""
        return ast.Parenthesized(parts[1], self._span(parts))

    def bracket(self, parts: list[Any]) -> ast.Bracket:
        """`[-10, 10] deg`."""
        last = parts[-1]
        unit = None if last.text == "]" else self._unit(last)
        elements = tuple(part for part in parts if not isinstance(part, Token))
        return ast.Bracket(elements, unit, self._span(parts))

    def number(self, parts: list[Any]) -> ast.Number | ast.Broken:
        """`4.0 sec`."""
        span = self._span(parts)
        value = float(parts[0].text)
        if not math.isfinite(value):
            reason = "it is larger than any double-precision number"
            finding = errors.NumberOutOfRange(reason=reason, advice="a number below 1.7e308")
            self._report(finding.at(self._at(parts[0])))
            return ast.Broken(span)
        return ast.Number(value, self._unit(parts[1]) if len(parts) > 1 else None, span)

    def boolean(self, parts: list[Any]) -> ast.Boolean:
        """`true`, `false`."""
        return ast.Boolean(parts[0].text == "true", self._at(parts[0]))

    def text(self, parts: list[Any]) -> ast.Text:
        """`"docked"`. There are no escapes: a backslash is a backslash."""
        return ast.Text(parts[0].text[1:-1], self._at(parts[0]))

    # --- parts -----------------------------------------------------------------------------------

    def position(self, token: Token) -> int | str | None:
        """The index or the name of an element; None after a report that no such element can
        exist.
        """
        if token.kind == "text":
            return token.text[1:-1]
        digits = token.text
        if digits.isdecimal() and len(digits) <= _MOST_DIGITS:
            return int(digits)
        reason = "the elements of an array are counted 0, 1, 2 ..."
        finding = errors.NumberOutOfRange(reason=reason, advice="a whole number below 1000000000")
        self._report(finding.at(self._at(token)))
        return None

    def name(self, token: Token | ast.Name) -> ast.Name:
        """A token as a name; a qualified name is already a name."""
        return token if isinstance(token, ast.Name) else ast.Name(token.text, self._at(token))

    def qualified(self, parts: list[Any]) -> ast.Name:
        """`NAME`, `NAME.WORD`."""
        return ast.Name("".join(part.text for part in parts), self._span(parts))

    def _unit(self, token: Token) -> ast.Unit:
        return ast.Unit(token.text, self._at(token))

    def _spelling(self, text: str, span: Span) -> str:
        """The operator in the spelling of this language. Another spelling is reported."""
        meant = FOREIGN.get(text)
        if meant is None:
            return text
        reason = "this is how other languages write it"
        if text == "=":
            reason = "`=` gives a constant its value, `==` compares"
        follows = self._file.text[span.end : span.end + 1]
        gap = " " if meant.isalpha() and not follows.isspace() else ""
        before = self._file.text[max(span.start - 1, 0) : span.start]
        lead = " " if meant.isalpha() and (before.isalnum() or before == "_") else ""
        fix = Fix(f"write `{meant}`", (Edit(span, f"{lead}{meant}{gap}"),))
        finding = errors.ForeignOperator(found=text, meant=meant, reason=reason)
        self._report(finding.at(span, fix=fix))
        return meant

    def _at(self, token: Token) -> Span:
        return Span(self._file, token.start, token.end)

    def _span(self, parts: list[Any]) -> Span:
        first, last = parts[0], parts[-1]
        start = first.start if isinstance(first, Token) else first.span.start
        end = last.end if isinstance(last, Token) else last.span.end
        return Span(self._file, start, end)


def _is_monotonic(signs: list[Token | _Comparator]) -> bool:
    """Say whether all comparisons of a chain have the same direction: less, greater, or equal."""
    meant = {FOREIGN.get(sign.text, sign.text) for sign in signs}
    return meant <= {"<", "<="} or meant <= {">", ">="} or meant == {"=="}


def _arguments(parts: list[Any]) -> list[Any]:
    return [part for part in parts if not isinstance(part, Token)]
