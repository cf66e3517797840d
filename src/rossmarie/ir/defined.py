"""Operators over time that are defined by other operators: `once` (S45) and `after` (S46).

A machine contains only their definitions. Texts for users show the original operator.
"""

from __future__ import annotations

from dataclasses import dataclass

from rossmarie.ir import model as ir


@dataclass(frozen=True)
class Once:
    """`once condition within duration`."""

    condition: int
    duration_ns: int

    @property
    def operands(self) -> tuple[int, ...]:
        """The propositions that the user names."""
        return (self.condition,)


@dataclass(frozen=True)
class Response:
    """`after cause, answer within duration`."""

    cause: int
    answer: int
    duration_ns: int

    @property
    def operands(self) -> tuple[int, ...]:
        """The propositions that the user names."""
        return (self.cause, self.answer)


def defined(machine: ir.Machine, proposition: int) -> Once | Response | None:
    """The defined operator that a proposition stands for; None if it stands for none."""
    outer = machine.propositions[proposition].node
    held = machine.propositions[outer.operand].node if isinstance(outer, ir.Not) else outer
    if held is outer or not isinstance(held, ir.Held):
        return None
    inner = machine.propositions[held.operand].node
    if isinstance(inner, ir.Not) and held.initially:
        return Once(inner.operand, held.duration_ns)
    if isinstance(inner, ir.Since) and not held.initially:
        return _response(machine, inner, held.duration_ns)
    return None


def _response(machine: ir.Machine, since: ir.Since, duration_ns: int) -> Response | None:
    """`not answer since (cause and not answer)`."""
    missing = machine.propositions[since.held].node
    begun = machine.propositions[since.begun].node
    if not isinstance(missing, ir.Not):
        return None
    if since.begun == since.held:  # the cause is the missing answer
        return Response(since.begun, missing.operand, duration_ns)
    if isinstance(begun, ir.And) and begun.operands[1:] == (since.held,):
        return Response(begun.operands[0], missing.operand, duration_ns)
    return None


def held_of(machine: ir.Machine, proposition: int) -> int | None:
    """The `for` itself, or the `for` in the definition of a proposition; None if there is none."""
    node = machine.propositions[proposition].node
    if isinstance(node, ir.Held):
        return proposition
    is_by_definition = isinstance(node, ir.Not) and defined(machine, proposition) is not None
    return node.operand if isinstance(node, ir.Not) and is_by_definition else None
