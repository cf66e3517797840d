"""Build the tree from the rules that the grammar recognises. There is one method for each rule of
ross.lark; the parser calls them bottom up.

Each method gets the parts of its rule: tokens, nodes, or small records. No method raises an error
for user text. A form that is recognised but not accepted (`&&`, `a < b < c`, a number beyond the
range of a double) is reported, and the rest of the expression is used.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from dslkit.source import Span
from rossmarie.syntax import ast
from rossmarie.syntax.build_system import SystemBuilder, is_token
from rossmarie.syntax.scan import Token


class _Body(NamedTuple):
    effects: tuple[ast.Effect, ...]
    span: Span


class _Steps(NamedTuple):
    steps: tuple[ast.Step, ...]
    span: Span


class Unless(NamedTuple):
    """The rules after `unless`."""

    rules: tuple[ast.Name, ...]
    span: Span


class Scope(NamedTuple):
    """The skills after `while`."""

    skills: tuple[ast.Doing, ...]
    span: Span


class _Guarded(NamedTuple):
    """`if CONDITION then { STEP; ... }` after the `then` of an exemption."""

    condition: ast.Expression
    steps: tuple[ast.Step, ...]
    span: Span


class Categorized(NamedTuple):
    """The word after `category`, or after `task`."""

    word: ast.Name
    is_task: bool
    span: Span


class Learned(NamedTuple):
    """The amounts after `feedback`."""

    amounts: tuple[ast.Feedback | ast.Margin, ...]
    span: Span


class Mitigates(NamedTuple):
    """The hazards after `mitigates`."""

    hazards: tuple[ast.Name, ...]
    span: Span


class Builder(SystemBuilder):
    """Builds all nodes of one file."""

    # --- items -----------------------------------------------------------------------------------

    def import_item(self, parts: list[Any]) -> ast.Import:
        """`import "file.ross" with NAME = VALUE, ... as NAME`."""
        given = tuple(part for part in parts if isinstance(part, ast.Given))
        alias = self.name(parts[-1]) if is_token(parts, len(parts) - 2, "as") else None
        return ast.Import(self.text([parts[1]]), self._span(parts), given, alias)

    def given(self, parts: list[Any]) -> ast.Given:
        """`NAME = VALUE`, `NAME = TOPIC`."""
        value = self.name(parts[2]) if isinstance(parts[2], Token) else parts[2]
        return ast.Given(self.name(parts[0]), value, self._span(parts))

    def number_parameter(self, parts: list[Any]) -> ast.Parameter:
        """`parameter NAME = VALUE`."""
        documentation, span = self._documentation(parts), self._span(parts)
        tightens = self.name(parts[5]) if len(parts) > 4 else None
        name = self.name(parts[1])
        return ast.Parameter(name, parts[3], None, documentation, span, tightens)

    def open_parameter(self, parts: list[Any]) -> ast.Parameter:
        """`parameter NAME in UNIT`."""
        documentation, span = self._documentation(parts), self._span(parts)
        return ast.Parameter(self.name(parts[1]), None, self._unit(parts[3]), documentation, span)

    def topic_parameter(self, parts: list[Any]) -> ast.Parameter:
        """`parameter NAME = topic TOPIC`."""
        return self._named_parameter(parts, self.name(parts[4]), ast.Meaning.TOPIC)

    def frame_parameter(self, parts: list[Any]) -> ast.Parameter:
        """`parameter NAME = frame FRAME`."""
        return self._named_parameter(parts, self._frame(parts[4]), ast.Meaning.FRAME)

    def _named_parameter(
        self, parts: list[Any], default: ast.Name, meaning: ast.Meaning
    ) -> ast.Parameter:
        documentation, span = self._documentation(parts), self._span(parts)
        name = self.name(parts[1])
        return ast.Parameter(name, default, None, documentation, span, meaning=meaning)

    def action(self, parts: list[Any]) -> ast.Action:
        """`action NAME { EFFECT; ... } latched until reset`."""
        body = next((part for part in parts if isinstance(part, _Body)), None)
        latch = next((part for part in parts if isinstance(part, ast.LatchedUntilReset)), None)
        effects = () if body is None else body.effects
        place = None if body is None else body.span
        name, documentation, span = (
            self.name(parts[1]),
            self._documentation(parts),
            self._span(parts),
        )
        return ast.Action(name, place, effects, latch, documentation, span)

    def body(self, parts: list[Any]) -> _Body:
        """`{ EFFECT; ... }`."""
        effects = tuple(part for part in parts if not isinstance(part, Token))
        return _Body(effects, self._span(parts))

    def constant(self, parts: list[Any]) -> ast.Constant:
        """`const NAME = VALUE`."""
        documentation = self._documentation(parts)
        return ast.Constant(self.name(parts[1]), parts[3], documentation, self._span(parts))

    def input(self, parts: list[Any]) -> ast.Input:
        """`input NAME = topic TOPIC : TYPE .path names ["NAME"] up to NUMBER from FRAME in UNIT in
        FRAME timeout DURATION`.
        """
        index = 5
        message_type = names = bound = source = timeout = None
        if is_token(parts, index, ":"):
            message_type = self._type(parts[index + 1])
            index += 2
        path, index = self._path(parts, index)
        if index < len(parts) and isinstance(parts[index], ast.ElementNames):
            names = parts[index]
            index += 1
        if is_token(parts, index, "up"):
            number = self.number(parts[index + 2 : index + 3])
            bound = number if isinstance(number, ast.Number) else None
            index += 3
        if is_token(parts, index, "from"):
            source = self._frame(parts[index + 1])
            index += 2
        unit, frame, index = self._inside(parts, index)
        if is_token(parts, index, "timeout"):
            timeout = parts[index + 1]
        name, topic = self.name(parts[1]), self.name(parts[4])
        documentation, span = self._documentation(parts), self._span(parts)
        behind = names, unit, timeout, documentation, span
        return ast.Input(
            name, topic, message_type, path, *behind, bound=bound, source=source, frame=frame
        )

    def _inside(self, parts: list[Any], index: int) -> tuple[ast.Unit | None, ast.Name | None, int]:
        """The unit and the frame after `in`, and the index after them."""
        found: list[Token] = []
        while is_token(parts, index, "in"):
            found.append(parts[index + 1])
            index += 2
        frame = None
        if len(found) == 2 or (found and found[0].kind == "text"):
            frame = self._frame(found.pop())
        unit = self._unit(found[0]) if found else None
        return unit, frame, index

    def element_names(self, parts: list[Any]) -> ast.ElementNames:
        """`names ["NAME", "NAME"]`."""
        texts = tuple(self.text([part]) for part in parts[2:-1:2])
        return ast.ElementNames(texts, self._span(parts))

    def quantity_input(self, parts: list[Any]) -> ast.Input:
        """`input NAME = doing SKILL.PARAMETER.PROPERTY in UNIT`."""
        steps, index = self._path(parts, 5)
        skill = self.name(parts[4])
        number = ast.SkillNumber(skill, steps, skill.span.to(steps[-1].span))
        unit = self._unit(parts[index + 1]) if is_token(parts, index, "in") else None
        documentation, span = self._documentation(parts), self._span(parts)
        behind = None, unit, None, documentation, span
        topic = ast.Name("", number.span)
        return ast.Input(self.name(parts[1]), topic, None, (), *behind, number=number)

    def skills(self, parts: list[Any]) -> ast.Skills:
        """`skills "skills.json" timeout DURATION`."""
        timeout = parts[3] if len(parts) > 3 else None
        return ast.Skills(self.text(parts[1:2]), timeout, self._span(parts))

    def entity(self, parts: list[Any]) -> ast.Entity:
        """`entity NAME { CONDITION; ... }`."""
        conditions = tuple(part for part in parts if isinstance(part, ast.Condition))
        documentation = self._documentation(parts)
        return ast.Entity(self.name(parts[1]), conditions, documentation, self._span(parts))

    def motion(self, parts: list[Any]) -> ast.Motion:
        """`motion NAME { PART; ... }`."""
        found = tuple(part for part in parts if isinstance(part, ast.Condition))
        documentation = self._documentation(parts)
        return ast.Motion(self.name(parts[1]), found, documentation, self._span(parts))

    def condition(self, parts: list[Any]) -> ast.Condition:
        """`NAME : EXPRESSION`."""
        documentation = self._documentation(parts)
        return ast.Condition(self.name(parts[0]), parts[2], documentation, self._span(parts))

    def part(self, parts: list[Any]) -> ast.Condition:
        """`NAME : EXPRESSION`."""
        return self.condition(parts)

    def rule(self, parts: list[Any]) -> ast.Rule:
        """`rule NAME: always if CONDITION while SKILLS unless RULES then { STEP; } CONTRACT`; all
        parts except the condition and the steps are optional.
        """
        name = self.name(parts[1]) if is_token(parts, 2, ":") else None
        place = 0 if name is None else 3
        always = self._at(parts[place]) if is_token(parts, place, "always") else None
        condition, *rest = parts[place + (1 if always is None else 2) :]
        scope = rest.pop(0).skills if isinstance(rest[0], Scope) else ()
        unless = rest.pop(0).rules if isinstance(rest[0], Unless) else ()
        _, steps, *behind = rest
        sorts = [part for part in behind if isinstance(part, Categorized)]
        return ast.Rule(
            name=name,
            condition=condition,
            unless=unless,
            steps=steps.steps,
            contracts=tuple(part for part in behind if isinstance(part, ast.ResumeContract)),
            category=_word(sorts, is_task=False),
            task=_word(sorts, is_task=True),
            feedback=tuple(e for part in behind if isinstance(part, Learned) for e in part.amounts),
            mitigates=tuple(
                e for part in behind if isinstance(part, Mitigates) for e in part.hazards
            ),
            documentation=self._documentation(parts),
            span=self._span(parts),
            always=always,
            scope=scope,
            exemptions=tuple(part for part in behind if isinstance(part, ast.Exemption)),
            keeps=next((part for part in behind if isinstance(part, ast.Keeps)), None),
        )

    def scope(self, parts: list[Any]) -> Scope:
        """`while doing SKILL, doing SKILL`."""
        return Scope(tuple(parts[1::2]), self._span(parts))

    def exemption(self, parts: list[Any]) -> ast.Exemption:
        """`unless doing SKILL then if CONDITION then { STEP; ... }`."""
        instead = parts[3] if len(parts) > 3 else None
        condition = instead.condition if isinstance(instead, _Guarded) else None
        steps = None if instead is None else instead.steps
        return ast.Exemption(parts[1], condition, steps, self._span(parts))

    def guarded(self, parts: list[Any]) -> _Guarded:
        """`if CONDITION then { STEP; ... }`."""
        return _Guarded(parts[1], parts[3].steps, self._span(parts))

    def unless(self, parts: list[Any]) -> Unless:
        """`unless RULE, RULE`."""
        return Unless(tuple(map(self.name, parts[1::2])), self._span(parts))

    def keeps(self, parts: list[Any]) -> ast.Keeps:
        """`keeps MOTION below SPEED in CLASS`."""
        return ast.Keeps(self.name(parts[1]), parts[3], parts[5], self._span(parts))

    def category(self, parts: list[Any]) -> Categorized:
        """`category human`."""
        return Categorized(self.name(parts[1]), False, self._span(parts))

    def task(self, parts: list[Any]) -> Categorized:
        """`task dependent`."""
        return Categorized(self.name(parts[1]), True, self._span(parts))

    def feedback(self, parts: list[Any]) -> Learned:
        """`feedback AMOUNT, AMOUNT`."""
        return Learned(tuple(parts[1::2]), self._span(parts))

    def amount(self, parts: list[Any]) -> ast.Feedback:
        """`1.0 per activation`, `0.5 per sec`."""
        time = None if parts[2].text == "activation" else self._unit(parts[2])
        return ast.Feedback(parts[0], time, self._span(parts))

    def margin(self, parts: list[Any]) -> ast.Margin:
        """`margin in N`."""
        unit = self._unit(parts[2]) if len(parts) > 1 else None
        return ast.Margin(unit, self._span(parts))

    def mitigates(self, parts: list[Any]) -> Mitigates:
        """`mitigates HAZARD, HAZARD`."""
        return Mitigates(tuple(map(self.name, parts[1::2])), self._span(parts))

    def hazard(self, parts: list[Any]) -> ast.Hazard:
        """`hazard NAME TEXT`."""
        documentation, text = self._documentation(parts), self.text([parts[2]])
        return ast.Hazard(self.name(parts[1]), text, documentation, self._span(parts))

    def steps(self, parts: list[Any]) -> _Steps:
        """`{ STEP; ... }`."""
        steps = tuple(part for part in parts if isinstance(part, ast.Step))
        return _Steps(steps, self._span(parts))

    def step(self, parts: list[Any]) -> ast.Step:
        """`also ACTION else ACTION`; `also` alone is a name.

        The number of parts distinguishes the forms, because a wrong name may be any word, including
        `else`.
        """
        is_also = len(parts) % 2 == 0
        action = self.name(parts[1 if is_also else 0])
        otherwise = self.name(parts[-1]) if len(parts) > 2 else None
        return ast.Step(is_also, action, otherwise, self._span(parts))

    def priority(self, parts: list[Any]) -> ast.Priority:
        """`priority RULE over RULE`."""
        return ast.Priority(tuple(map(self.name, parts[1::2])), self._span(parts))

    def clear_when(self, parts: list[Any]) -> ast.ClearWhen:
        """`clear when CONDITION`."""
        return ast.ClearWhen(parts[2], self._span(parts))

    def clear_for(self, parts: list[Any]) -> ast.ClearFor:
        """`clear for DURATION`."""
        return ast.ClearFor(parts[2], self._span(parts))

    def latched_until_reset(self, parts: list[Any]) -> ast.LatchedUntilReset:
        """`latched until reset`."""
        return ast.LatchedUntilReset(self._span(parts))


def _word(sorts: list[Categorized], *, is_task: bool) -> ast.Name | None:
    return next((each.word for each in sorts if each.is_task is is_task), None)
