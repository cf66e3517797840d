"""Recovers a rule that does not parse as a whole: its condition, steps and contracts are parsed one
by one.
"""

from __future__ import annotations

from dslkit.diagnostics import Diagnostic, Edit, Fix
from dslkit.source import Span
from rossmarie.syntax import ast, errors
from rossmarie.syntax.explain import (
    explain_token,
    is_name,
    missing_sign,
    reserved_word,
    unclosed_bracket,
    wrong_sign,
)
from rossmarie.syntax.part import PartParser
from rossmarie.syntax.words import FORMS, RESERVED

_ENDS = ("keeps", "category", "task", "feedback", "mitigates")
_CONTRACT_STARTS = {("clear", "when"), ("clear", "for"), ("latched", "until")}


def recover_rule(part: PartParser, first: int, last: int, head: str | None) -> ast.Rule:
    """Recover the readable parts of the rule in the tokens from `first` up to, not including,
    `last`.
    """
    return _Recovery(part, first, last).rule(head or part.source.tokens[first].text)


class _Recovery:
    """Walks over the tokens of one rule from left to right."""

    def __init__(self, part: PartParser, first: int, last: int) -> None:
        self._part = part
        self._source = part.source
        self._tokens = part.source.tokens
        self._first = first
        self._last = last
        self._index = first
        inside = part.source.tokens[first:last]
        # An unclosed text has swallowed the end of a line.
        self._is_cut_off = any(token.kind == "open_text" for token in inside)

    def rule(self, head: str) -> ast.Rule:
        """The rule; `head` is its first word."""
        self._index += 1
        name = self._name() if head == "rule" else None
        self._index += head == "always" and self._text() == "if"
        condition, unless = self._condition()
        steps = self._steps()
        exemptions = self._exemptions()
        contracts = self._contracts()
        self._keeps()
        category, task = self._filed("category"), self._filed("task")
        feedback = self._feedback()
        mitigates = self._mitigates()
        span = self._source.span(self._tokens[self._first], self._tokens[self._last - 1])
        documentation = self._source.documentation.get(span.start)
        ends = category, task, feedback, mitigates, documentation, span
        return ast.Rule(name, condition, unless, steps, contracts, *ends, exemptions=exemptions)

    def _text(self, offset: int = 0) -> str:
        index = self._index + offset
        return self._tokens[index].text if index < self._last else ""

    def _name(self) -> ast.Name | None:
        """`NAME : if`; all three tokens may be missing."""
        name = None
        if self._index < self._last and is_name(self._tokens[self._index]):
            token = self._tokens[self._index]
            name = ast.Name(token.text, self._source.span(token))
            self._index += 1
        elif self._text() in RESERVED and (self._text() != "if" or self._text(1) == ":"):
            self._part.findings.add(reserved_word(self._source, self._tokens[self._index]))
            self._index += 1
        else:
            missing = errors.MissingName(place="after", form=FORMS["rule"])
            behind = self._tokens[self._index - 1]
            self._part.findings.add(missing.at(self._source.span(behind)))
        for sign, insertion in ((":", ":"), ("if", " if")):
            self._index += (sign, self._text()) == ("if", "always")
            if self._text() == sign:
                self._index += 1
            elif name is not None:
                behind = self._tokens[self._index - 1]
                finding = missing_sign(self._source, sign, behind, "rule", insertion)
                self._part.findings.add(finding)
        return name

    def _condition(self) -> tuple[ast.Expression, tuple[ast.Name, ...]]:
        """The condition up to `then`, or up to the brace, with the rules after `unless`. The skills
        after `while` are read only to report errors.
        """
        first = self._index
        end = self._next(first, ("then", "{"))
        has_then = end < self._last and self._tokens[end].text == "then"
        self._index = end + has_then
        if end > first and not has_then and not self._is_cut_off:
            self._report_missing_then(self._source.span(self._tokens[end - 1]))
        between = min(self._next(first, ("unless",)), end)
        others = self._part.parse("unless", between, end) if between < end else None
        scope = min(self._next(first, ("while",)), between)
        if scope < between:
            self._part.parse("scope", scope, between)
        condition = self._expression(first, scope)
        return condition, () if others is None else others.rules

    def _next(self, first: int, words: tuple[str, ...]) -> int:
        """The first place of one of these words, or the end of the rule."""
        places = range(first, self._last)
        return next((at for at in places if self._tokens[at].text in words), self._last)

    def _expression(self, first: int, end: int) -> ast.Expression:
        before = self._source.span(self._tokens[first - 1])
        if first == end:
            sign = self._tokens[first - 1].text
            finding = errors.MissingValue(place="after", sign=sign, form=FORMS["rule"])
            self._part.findings.add(finding.at(before))
            return self._part.broken(first, end, before)
        condition: ast.Expression | None = self._part.parse("expression", first, end)
        return condition or self._part.broken(first, end, before)

    def _report_missing_then(self, last: Span) -> None:
        """Report a missing `then`. `last` is the end of the condition."""
        place = Span(last.file, last.end, last.end)
        fix = Fix("insert `then`", (Edit(place, " then"),))
        self._part.findings.add(errors.MissingThen().at(last, fix=fix))

    def _steps(self) -> tuple[ast.Step, ...]:
        """`{ STEP; ... }`."""
        if self._index >= self._last:
            if self._tokens[self._last - 1].text == "then":
                self._part.findings.add(self._missing_brace())
            return ()
        brace = self._tokens[self._index]
        if brace.text == "{":
            self._index += 1
        else:
            self._part.findings.add(self._missing_brace())
        steps = []
        while self._goes_on() and self._text() != "}" and not self._begins_contract():
            step = self._step()
            if step is not None:
                steps.append(step)
        if self._text() == "}":
            self._index += 1
        elif brace.text == "{" and not self._is_cut_off:
            behind = self._tokens[self._index - 1]
            self._part.findings.add(unclosed_bracket(self._source, brace, behind, inserted=" }"))
        return tuple(steps)

    def _missing_brace(self) -> Diagnostic:
        return missing_sign(self._source, "{", self._tokens[self._index - 1], "rule", " {")

    def _step(self) -> ast.Step | None:
        """One `also NAME else NAME ;`. Other text is reported and skipped up to the next `;`."""
        first = self._index
        if self._text() == ";":
            self._index += 1
            return None
        is_beside = self._text() == "also" and self._is_name(1)
        self._index += is_beside
        action = self._word()
        if action is None:
            self._part.findings.add(explain_token(self._source, self._index, "actions"))
            while self._index < self._last and self._text() not in (";", "}"):
                self._index += 1
            return None
        otherwise = self._otherwise() if self._text() == "else" else None
        self._end_step()
        span = self._source.span(self._tokens[first], self._tokens[first + is_beside])
        if otherwise is not None:
            span = span.to(otherwise.span)
        return ast.Step(is_beside, action, otherwise, span)

    def _otherwise(self) -> ast.Name | None:
        """`else NAME`."""
        behind = self._tokens[self._index]
        self._index += 1
        name = self._word()
        if name is None:
            missing = errors.MissingName(place="after", form=FORMS["step"])
            self._part.findings.add(missing.at(self._source.span(behind)))
        return name

    def _end_step(self) -> None:
        """The `;` after a step."""
        if self._text() == ";":
            self._index += 1
        elif self._text() == ",":
            comma = self._tokens[self._index]
            self._part.findings.add(wrong_sign(self._source, ";", comma, "actions"))
            self._index += 1
        elif not self._is_cut_off:
            behind = self._tokens[self._index - 1]
            self._part.findings.add(missing_sign(self._source, ";", behind, "actions"))

    def _is_name(self, offset: int = 0) -> bool:
        index = self._index + offset
        return index < self._last and is_name(self._tokens[index])

    def _word(self) -> ast.Name | None:
        """The name at the current place, if there is one."""
        if not self._is_name():
            return None
        token = self._tokens[self._index]
        self._index += 1
        return ast.Name(token.text, self._source.span(token))

    def _exemptions(self) -> tuple[ast.Exemption, ...]:
        """`unless doing SKILL then { ... }`, as many as there are."""
        found = []
        while self._goes_on() and self._text() == "unless":
            first = self._index
            self._index += 1
            while self._index < self._last and not (
                self._begins_contract() or self._text() == "unless"
            ):
                self._index += 1
            exemption = self._part.parse("exemption", first, self._index)
            if exemption is not None:
                found.append(exemption)
        return tuple(found)

    def _contracts(self) -> tuple[ast.ResumeContract, ...]:
        """`clear when ...` and so on, up to the end of the rule."""
        found = []
        while self._goes_on() and self._text() not in _ENDS:
            first = self._index
            self._index += 1
            while self._index < self._last and not self._begins_contract():
                self._index += 1
            contract = self._part.parse("contract", first, self._index)
            if contract is not None:
                found.append(contract)
        return tuple(found)

    def _keeps(self) -> None:
        """Read `keeps MOTION below SPEED in CLASS` to report its errors."""
        if self._text() != "keeps":
            return
        first = self._index
        self._index += 1
        while self._index < self._last and self._text() not in _ENDS:
            self._index += 1
        self._part.parse("keeps", first, self._index)

    def _filed(self, word: str) -> ast.Name | None:
        """`category human`, `task dependent`, up to the next part of the rule."""
        if self._text() != word:
            return None
        first = self._index
        self._index += 1
        while self._index < self._last and self._text() not in _ENDS:
            self._index += 1
        found = self._part.parse(word, first, self._index)
        return None if found is None else found.word

    def _feedback(self) -> tuple[ast.Feedback | ast.Margin, ...]:
        """`feedback AMOUNT, AMOUNT`, up to the hazards."""
        if self._text() != "feedback":
            return ()
        first = self._index
        while self._index < self._last and self._text() != "mitigates":
            self._index += 1
        found = self._part.parse("feedback", first, self._index)
        return () if found is None else found.amounts

    def _mitigates(self) -> tuple[ast.Name, ...]:
        """`mitigates HAZARD, HAZARD`, at the end of the rule."""
        if self._index >= self._last:
            return ()
        found = self._part.parse("mitigates", self._index, self._last)
        return () if found is None else found.hazards

    def _goes_on(self) -> bool:
        return self._index < self._last and not self._part.findings.is_full

    def _begins_contract(self) -> bool:
        return (self._text(), self._text(1)) in _CONTRACT_STARTS or self._text() in _ENDS
