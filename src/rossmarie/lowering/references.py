"""The named conditions to which an expression refers."""

from __future__ import annotations

from collections.abc import Iterator

from rossmarie.check.model import ConditionKey, Symbols
from rossmarie.syntax import ast
from rossmarie.syntax.walk import children


def referred_condition(
    node: ast.Expression, entity: str | None, symbols: Symbols
) -> ConditionKey | None:
    """The condition that a node names: `entity.condition`, or inside an entity just `condition`.
    None if the node names no condition.
    """
    match node:
        case ast.Member(value=ast.Reference(name=owner), member=member):
            key = (owner.text, member.text)
        case ast.Reference(name=name) if entity is not None:
            key = (entity, name.text)
        case (
            ast.Number() | ast.Boolean() | ast.Text() | ast.Bracket() | ast.Reference()
            | ast.Member() | ast.Index() | ast.Sector() | ast.Call() | ast.Edges()
            | ast.Oscillates() | ast.ListFold() | ast.Unary() | ast.Binary() | ast.Membership()
            | ast.Held() | ast.Since() | ast.Once() | ast.Response() | ast.Doing()
            | ast.Parenthesized() | ast.Broken()
        ):  # fmt: skip
            return None
    return key if key in symbols.conditions else None


def conditions_in(
    node: ast.Expression, entity: str | None, symbols: Symbols
) -> Iterator[ConditionKey]:
    """The conditions that an expression names, in the order in which they are written."""
    waiting = [node]
    while waiting:
        part = waiting.pop()
        key = referred_condition(part, entity, symbols)
        if key is None:
            waiting.extend(reversed(children(part)))
        else:
            yield key
