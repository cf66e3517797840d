"""Variables of a method that stand for a parameter: `speed = self.params["Speed"]`, then
`speed.value`. The translation replaces them by the parameter.
"""

from __future__ import annotations

from collections.abc import Mapping

import libcst as cst
import libcst.matchers as m

from ezskiros.migrate.calls import literal_text
from ezskiros.migrate.parameter_uses import PARAMS, own


def without_aliases(method: cst.FunctionDef) -> cst.FunctionDef:
    """A method whose parameter variables, if they are set once in lines of their own, are replaced
    by the parameters.
    """
    found = {}
    for statement in method.body.body:
        name, value = _alias(statement)
        if name and value is not None and _is_only_asked(method, name):
            found[name] = value
    new = method.visit(_Inlined(found)) if found else method
    assert isinstance(new, cst.FunctionDef)
    return new


def _alias(statement: cst.CSTNode) -> tuple[str, cst.BaseExpression | None]:
    """The variable and the parameter, if a line sets a variable to a parameter."""
    match statement:
        case cst.SimpleStatementLine(
            body=[
                cst.Assign(
                    targets=[cst.AssignTarget(target=cst.Name(value=name))],
                    value=cst.Subscript(
                        value=held, slice=[cst.SubscriptElement(slice=cst.Index(value=key))]
                    ) as value,
                )
            ]
        ) if own(held, PARAMS) and literal_text(key) is not None:
            return name, value
        case _:  # open: any other node
            pass
    return "", None


def _is_only_asked(method: cst.FunctionDef, name: str) -> bool:
    """Say whether each use of a variable, after it is set, is `name.attribute`."""
    named = m.findall(method, m.Name(name))
    asked = m.findall(method, m.Attribute(value=m.Name(name)))
    attributes = m.findall(method, m.Attribute(attr=m.Name(name)))
    keywords = m.findall(method, m.Arg(keyword=m.Name(name)))
    others = len(attributes) + len(keywords)
    return len(named) == len(asked) + 1 + others


class _Inlined(cst.CSTTransformer):
    def __init__(self, found: Mapping[str, cst.BaseExpression]) -> None:
        self._found = found

    def leave_Attribute(  # noqa: N802
        self, original_node: cst.Attribute, updated_node: cst.Attribute
    ) -> cst.Attribute:
        match original_node.value:
            case cst.Name(value=name) if name in self._found:
                return updated_node.with_changes(value=self._found[name].deep_clone())
            case _:  # open: any other node
                pass
        return updated_node

    def leave_IndentedBlock(  # noqa: N802
        self,
        original_node: cst.IndentedBlock,
        updated_node: cst.IndentedBlock,
    ) -> cst.IndentedBlock:
        """Remove the lines that set the variables. The comments of these lines move to the next
        line.
        """
        waiting: list[cst.EmptyLine] = []
        body: list[cst.BaseStatement] = []
        for old, new in zip(original_node.body, updated_node.body, strict=True):
            if self._is_gone(old):
                waiting += [each for each in new.leading_lines if each.comment]  # type: ignore[attr-defined]
                behind = new.trailing_whitespace.comment  # type: ignore[attr-defined]
                waiting += [cst.EmptyLine(comment=behind)] if behind else []
            else:
                lines = [*waiting, *new.leading_lines] if waiting else new.leading_lines  # type: ignore[attr-defined]
                body.append(new.with_changes(leading_lines=lines))
                waiting = []
        body = body or [cst.SimpleStatementLine([cst.Pass()])]
        return updated_node.with_changes(body=body, footer=[*waiting, *updated_node.footer])

    def _is_gone(self, statement: cst.BaseStatement) -> bool:
        return _alias(statement)[0] in self._found
