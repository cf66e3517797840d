"""Build the effects of an action from the rules that the grammar recognises in its body.

One method per rule of ross.lark, as in `build`, which describes their arguments and guarantees.
"""

from __future__ import annotations

from typing import Any

from rossmarie.syntax import ast
from rossmarie.syntax.build_expression import ExpressionBuilder, WordArgument
from rossmarie.syntax.scan import Token


class EffectBuilder(ExpressionBuilder):
    """Builds the effects of one file."""

    # --- commands --------------------------------------------------------------------------------

    def limit(self, parts: list[Any]) -> ast.Limit:
        """`limit TARGET { BOUND; ... } ramp RAMP`."""
        bounds = tuple(part for part in parts if isinstance(part, ast.FieldBound))
        return ast.Limit(parts[1], bounds, clause(parts, "ramp") or (), self._span(parts))

    def scale(self, parts: list[Any]) -> ast.Scale:
        """`scale TARGET by FACTOR ramp RAMP`."""
        return ast.Scale(parts[1], parts[3], clause(parts, "ramp") or (), self._span(parts))

    def block(self, parts: list[Any]) -> ast.Block:
        """`block TARGET ramp RAMP`."""
        return ast.Block(parts[1], clause(parts, "ramp") or (), self._span(parts))

    def target(self, parts: list[Any]) -> ast.Target:
        """`TOPIC : TYPE`."""
        kind = self._type(parts[2]) if len(parts) > 1 else None
        return ast.Target(self.name(parts[0]), kind, self._span(parts))

    def field_bound(self, parts: list[Any]) -> ast.FieldBound:
        """`PATH in RANGE`."""
        return ast.FieldBound(parts[0], parts[2], self._span(parts))

    def ramps(self, parts: list[Any]) -> WordArgument:
        """`ramp RAMP, ...`."""
        return WordArgument("ramp", tuple(parts[1::2]), self._span(parts))

    # --- messages --------------------------------------------------------------------------------

    def publish(self, parts: list[Any]) -> ast.Publish:
        """`publish TARGET MESSAGE at RATE`."""
        rate = parts[4] if len(parts) > 3 else None
        return ast.Publish(parts[1], parts[2].value, rate, self._span(parts))

    def retrace(self, parts: list[Any]) -> ast.Retrace:
        """`retrace POSE on TARGET MESSAGE up to NUMBER apart DISTANCE, TIME at RATE`."""
        assignments, words = clause(parts, "{") or (), [getattr(each, "text", "") for each in parts]
        apart = words.index("apart")
        number = self.number(parts[words.index("to") + 1 :][:1])
        most = number if isinstance(number, ast.Number) else ast.Number(-1.0, None, number.span)
        distances, rate, span = tuple(parts[apart + 1 : -2 : 2]), parts[-1], self._span(parts)
        return ast.Retrace(parts[1], parts[3], assignments, most, distances, rate, span)

    def call_service(self, parts: list[Any]) -> ast.CallService:
        """`call TARGET MESSAGE within TIME else ACTION`."""
        assignments = clause(parts, "{") or ()
        timeout, otherwise = clause(parts, "within"), clause(parts, "else")
        return ast.CallService(parts[1], assignments, timeout, otherwise, self._span(parts))

    def set_parameter(self, parts: list[Any]) -> ast.SetParameter:
        """`set NODE.PARAMETER in UNIT to VALUE within TIME else ACTION`."""
        path, index = self._path(parts, 2)
        unit = None
        if parts[index].text == "in":
            unit = self._unit(parts[index + 1])
            index += 2
        timeout, otherwise = clause(parts, "within"), clause(parts, "else")
        node, value, span = self.name(parts[1]), parts[index + 1], self._span(parts)
        return ast.SetParameter(node, path, unit, value, timeout, otherwise, span)

    def switch_controllers(self, parts: list[Any]) -> ast.SwitchControllers:
        """`switch MANAGER { start NAME, ...; stop NAME, ...; } within TIME else ACTION`."""
        inside = [part for part in parts[3:] if isinstance(part, Token)]
        named = self._listed(inside, ("start", "stop"))
        timeout, otherwise = clause(parts, "within"), clause(parts, "else")
        manager, span = self.name(parts[1]), self._span(parts)
        return ast.SwitchControllers(
            manager, named["start"], named["stop"], timeout, otherwise, span
        )

    def message(self, parts: list[Any]) -> WordArgument:
        """`{ PATH = VALUE; ... }`."""
        assignments = tuple(part for part in parts if not isinstance(part, Token))
        return WordArgument("{", assignments, self._span(parts))

    def field_assignment(self, parts: list[Any]) -> ast.FieldAssignment:
        """`PATH = VALUE`."""
        return ast.FieldAssignment(parts[0], parts[2], self._span(parts))

    def field_path(self, parts: list[Any]) -> ast.FieldPath:
        """`WORD.WORD[0]`, `WORD["NAME"].WORD`."""
        steps: list[ast.Name | ast.Position] = []
        for part in parts:
            if part.kind == "word":
                steps.append(self.name(part))
            elif part.kind in ("number", "text"):
                steps.append(ast.Position(self.position(part) or 0, self._at(part)))
        return ast.FieldPath(tuple(steps), self._span(parts))

    # --- goals -----------------------------------------------------------------------------------

    def send_goal(self, parts: list[Any]) -> ast.SendGoal:
        """`send TYPE MESSAGE to SERVER within TIME then WORD else ACTION`."""
        kind = self._type(parts[1]) if isinstance(parts[1], Token) else None
        assignments = clause(parts, "{")
        to = next(at for at, part in enumerate(parts) if isinstance(part, Token) and at > 1)
        server = self.name(parts[to + 1])
        target = ast.Target(server, kind, server.span)
        timeout, otherwise = clause(parts, "within"), clause(parts, "else")
        interrupted, span = clause(parts, "then"), self._span(parts)
        return ast.SendGoal(target, assignments, timeout, interrupted, otherwise, span)

    def cancel_goal(self, parts: list[Any]) -> ast.CancelGoal:
        """`cancel SERVER confirm by CONDITION within TIME then WORD else ACTION`."""
        confirmation, timeout = clause(parts, "confirm"), clause(parts, "within")
        interrupted, otherwise = clause(parts, "then"), clause(parts, "else")
        server, span = self.name(parts[1]), self._span(parts)
        return ast.CancelGoal(server, confirmation, timeout, interrupted, otherwise, span)

    def run_tree(self, parts: list[Any]) -> ast.RunTree:
        """`tree SKILL(PARAMETER: VALUE, ...) within TIME then WORD else ACTION`."""
        arguments = tuple(part for part in parts if isinstance(part, ast.TreeArgument))
        timeout, otherwise = clause(parts, "within"), clause(parts, "else")
        afterwards, span = clause(parts, "then"), self._span(parts)
        return ast.RunTree(self.name(parts[1]), arguments, timeout, afterwards, otherwise, span)

    def tree_argument(self, parts: list[Any]) -> ast.TreeArgument:
        """`PARAMETER: VALUE`."""
        return ast.TreeArgument(self.name(parts[0]), parts[2], self._span(parts))

    def passed(self, parts: list[Any]) -> ast.Passed:
        """`doing SKILL.PARAMETER`."""
        return ast.Passed(self.name(parts[1]), self.name(parts[3]), self._span(parts))

    def afterwards(self, parts: list[Any]) -> WordArgument:
        """`then resume`, `then retry`, `then replan`."""
        return WordArgument("then", self.name(parts[1]), self._span(parts))

    def confirmation(self, parts: list[Any]) -> WordArgument:
        """`confirm by CONDITION`."""
        return WordArgument("confirm", parts[2], self._span(parts))

    def interrupted(self, parts: list[Any]) -> WordArgument:
        """`then resend`, `then drop`."""
        return WordArgument("then", self.name(parts[1]), self._span(parts))

    def otherwise(self, parts: list[Any]) -> WordArgument:
        """`else ACTION`."""
        return WordArgument("else", self.name(parts[1]), self._span(parts))

    # --- other effects -----------------------------------------------------------------------

    def log(self, parts: list[Any]) -> ast.Log:
        """`log LEVEL TEXT`."""
        return ast.Log(self.name(parts[1]), self.text(parts[2:]), self._span(parts))

    def diagnose(self, parts: list[Any]) -> ast.Diagnose:
        """`diagnose LEVEL TEXT`."""
        return ast.Diagnose(self.name(parts[1]), self.text(parts[2:]), self._span(parts))

    def hook(self, parts: list[Any]) -> ast.Hook:
        """`hook NAME`."""
        return ast.Hook(self.name(parts[1]), self._span(parts))

    def reset_rules(self, parts: list[Any]) -> ast.Reset:
        """`reset`."""
        return ast.Reset(self._span(parts))

    # --- parts -----------------------------------------------------------------------------------

    def _type(self, token: Token) -> ast.Name:
        return ast.Name(token.text.replace("/msg/", "/"), self._at(token))

    def _path(self, parts: list[Any], index: int) -> tuple[tuple[ast.Name, ...], int]:
        """The words after dots, from an index on, and the index after them."""
        names = []
        while index < len(parts) and isinstance(parts[index], Token) and parts[index].text == ".":
            names.append(self.name(parts[index + 1]))
            index += 2
        return tuple(names), index

    def _listed(
        self, parts: list[Token], words: tuple[str, str]
    ) -> dict[str, tuple[ast.Name, ...]]:
        """The names after each of two words, in `WORD NAME, NAME; ...`."""
        found: dict[str, tuple[ast.Name, ...]] = dict.fromkeys(words, ())
        current = words[0]
        is_start = True
        for part in parts:
            if part.text == ";":
                is_start = True
            elif is_start:
                is_start = False
                current = part.text
            elif part.kind == "word":
                found[current] += (self.name(part),)
        return found


def clause(parts: list[Any], word: str) -> Any:
    """The part after a word among the parts of an effect; None if it is missing."""
    return next(
        (part.value for part in parts if isinstance(part, WordArgument) and part.word == word), None
    )
