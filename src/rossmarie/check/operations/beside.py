"""The numbers that may be used beside elements (S74): numbers of messages, and functions of them
without a memory.

A number that depends on other elements, on an age or on several messages is not allowed there.
"""

from __future__ import annotations

from rossmarie.check.scopes.context import Context
from rossmarie.core import Sampling
from rossmarie.syntax import ast
from rossmarie.syntax.walk import walk

QUANTIFIERS = frozenset({"any", "all"})
CONDITIONAL = QUANTIFIERS | {"count"}
EXTREMES = frozenset({"min", "max"})
OF_SAMPLES = frozenset(each.value for each in Sampling) | {"changed"}


def nature_of_call(node: ast.Call, context: Context) -> str | None:
    """The reason why a call may not be used beside elements, or be applied to an element; None if
    it may.
    """
    name = node.function.text
    if any(isinstance(argument, ast.Edges) for argument in node.arguments):
        return "this counts over time"
    if name in CONDITIONAL or (name in EXTREMES and len(node.arguments) == 1):
        return "this looks at another array"
    if name == "age":
        return "this is the age of a whole message"
    if name in OF_SAMPLES:
        return "this looks at several messages"
    names = (each.name.text for each in node.arguments if isinstance(each, ast.Reference))
    motions = [context.motions[each] for each in names if each in context.motions]
    if any(unfit_part(motion.speed, context) is not None for motion in motions):
        return "the speed of this motion looks at more than one message"
    return None


def unfit_part(number: ast.Expression, context: Context) -> tuple[ast.Expression, str] | None:
    """The first part of a number that may not be used beside elements, and the reason; None if the
    whole number may be used.
    """
    for part in walk(number):
        if isinstance(part, ast.ListFold):
            return part, "this looks at a list"
        nature = nature_of_call(part, context) if isinstance(part, ast.Call) else None
        if nature is not None:
            return part, nature
    return None
