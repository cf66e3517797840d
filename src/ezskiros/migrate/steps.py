"""The small statements of a method `createDescription`, with the comments around them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from dataclasses import dataclass

import libcst as cst

from ezskiros.migrate.calls import Arguments, method
from ezskiros.migrate.comments import texts
from ezskiros.migrate.errors import LeftError


@dataclass
class DescriptionStatement:
    """One small statement of the old description, and the comments around it."""

    node: cst.BaseSmallStatement | cst.BaseCompoundStatement
    statement: cst.CSTNode
    above: list[str]
    behind: str = ""

    @property
    def call(self) -> cst.Call | None:
        """The call, if the statement is a call."""
        match self.node:
            case cst.Expr(value=cst.Call() as found):
                return found
            case _:  # open: any other statement
                return None


def statements_of(function: cst.FunctionDef) -> Sequence[cst.CSTNode]:
    """The statements of a method: lines, or the small statements after its colon."""
    return function.body.body


def steps_of(
    statements: Sequence[cst.CSTNode], function: cst.FunctionDef
) -> Iterator[DescriptionStatement]:
    """The small statements, in order."""
    suite = function.body
    if isinstance(suite, cst.SimpleStatementSuite):
        yield from _line_steps(suite.body, suite, suite.trailing_whitespace.comment, [])
        return
    for statement in statements:
        above = texts(getattr(statement, "leading_lines", ()))
        if isinstance(statement, cst.SimpleStatementLine):
            comment = statement.trailing_whitespace.comment
            yield from _line_steps(statement.body, statement, comment, above)
        elif isinstance(statement, cst.BaseCompoundStatement):
            yield DescriptionStatement(statement, statement, above)


def keys_of(steps: Sequence[DescriptionStatement]) -> Set[str]:
    """The keys of all parameters in order, including those that cannot be translated."""
    found: dict[str, None] = {}
    for step in steps:
        if step.call is not None and method(step.call) == "addParam":
            try:
                found[Arguments(step.call, "addParam").text("key")] = None
            except LeftError:
                continue
    return found.keys()


def _line_steps(
    parts: Sequence[cst.BaseSmallStatement],
    line: cst.CSTNode,
    comment: cst.Comment | None,
    above: list[str],
) -> Iterator[DescriptionStatement]:
    """The small statements of one line. Comments above the line belong to the first one, a comment
    at its end to the last one.
    """
    for number, node in enumerate(parts):
        behind = comment.value if comment and number == len(parts) - 1 else ""
        yield DescriptionStatement(node, line, [] if number else above, behind)
