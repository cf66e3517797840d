"""Translation of `self.params["Speed"].value` to `self.params.Speed`."""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import TypeVar

import libcst as cst

from dslkit.diagnostics import Template
from ezskiros.migrate import errors, implementation_errors
from ezskiros.migrate.calls import literal_text
from ezskiros.migrate.description import UntranslatedPart
from ezskiros.migrate.errors import LeftError
from ezskiros.migrate.skills import MigratedSkill

PARAMS = {"params", "_params"}
_GET, _SET = {"getValue"}, {"setValue"}
_GET_BY_KEY, _SET_BY_KEY = {"getParamValue"}, {"specify"}
_OF_SKIROS2 = {
    *("wmi", "_wmi", "node", "setOutput", "specifyParam", "specifyParams", "startError"),
    *("progress_code", "_progress_code", "progress_msg", "_progress_msg", "_setProgress"),
    *("hasState", "waitState"),
}
"""The names that SkiROS2's base classes of skills have, but those of EzSkiROS do not."""


def _unset_key(call: cst.BaseExpression) -> cst.BaseExpression | None:
    """The key in a call that removes the value of a parameter."""
    match call:
        case cst.Call(
            func=cst.Attribute(
                value=cst.Subscript(
                    value=held, slice=[cst.SubscriptElement(slice=cst.Index(value=key))]
                ),
                attr=cst.Name(value="unset"),
            ),
            args=[],
        ) if own(held, PARAMS):
            return key
        case _:  # open: any other node
            pass
    return None


Node = TypeVar("Node", bound=cst.CSTNode)


def own(node: cst.CSTNode, names: Collection[str]) -> bool:
    """Say whether an expression is `self.name`, for one of some names."""
    match node:
        case cst.Attribute(value=cst.Name(value="self"), attr=cst.Name(value=name)):
            return name in names
        case _:  # open: any other node
            return False


def parameter_key(node: cst.CSTNode) -> cst.BaseExpression | None:
    """The expression for the key, in an expression for the value of a parameter."""
    match node:
        case cst.Attribute(
            value=cst.Subscript(
                value=held, slice=[cst.SubscriptElement(slice=cst.Index(value=key))]
            ),
            attr=cst.Name(value="value"),
        ) if own(held, PARAMS):
            return key
        case cst.Call(
            func=cst.Attribute(
                value=cst.Subscript(
                    value=held, slice=[cst.SubscriptElement(slice=cst.Index(value=key))]
                ),
                attr=cst.Name(value=name),
            ),
            args=[],
        ) if own(held, PARAMS) and name in _GET:
            return key
        case cst.Call(
            func=cst.Attribute(value=held, attr=cst.Name(value=name)), args=[cst.Arg(value=key)]
        ) if own(held, PARAMS) and name in _GET_BY_KEY:
            return key
        case _:  # open: any other node
            pass
    return None


def _setting(call: cst.Call) -> tuple[cst.BaseExpression, cst.BaseExpression] | None:
    """The key and the value in a call that sets a parameter."""
    match call:
        case cst.Call(
            func=cst.Attribute(
                value=cst.Subscript(
                    value=held, slice=[cst.SubscriptElement(slice=cst.Index(value=key))]
                ),
                attr=cst.Name(value=name),
            ),
            args=[cst.Arg(value=value, star="", keyword=None)],
        ) if own(held, PARAMS) and name in _SET:
            return key, value
        case cst.Call(
            func=cst.Attribute(value=held, attr=cst.Name(value=name)),
            args=[cst.Arg(value=key, star=""), cst.Arg(value=value, star="", keyword=None)],
        ) if own(held, PARAMS) and name in _SET_BY_KEY:
            return key, value
        case _:  # open: any other node
            pass
    return None


class ParameterUses(cst.CSTTransformer):
    """Translates the uses of parameters in the methods of an implementation of `skill`.

    `findings` are the mistakes, and `warnings` the hints, each with its statement. `code` gives the
    text of an expression.
    """

    def __init__(self, skill: MigratedSkill, code: Callable[[cst.CSTNode], str]) -> None:
        self._skill, self._code = skill, code
        self.findings: list[UntranslatedPart] = []
        self.warnings: list[UntranslatedPart] = []
        self._statements: list[cst.CSTNode] = []
        self._read: set[int] = set()
        self._reported: set[int] = set()
        self._place: cst.CSTNode | None = None

    # --- findings ---------------------------------------------------------------------------------

    def leave(self, template: Template, node: cst.CSTNode) -> None:
        """Report a part without a translation."""
        self.findings.append(self._finding(template, node))

    def _finding(self, template: Template, node: cst.CSTNode) -> UntranslatedPart:
        return UntranslatedPart(template, self._place or node, self._statements[-1])

    def on_visit(self, node: cst.CSTNode) -> bool:
        """Record the current statement."""
        if isinstance(node, (cst.SimpleStatementLine, cst.BaseCompoundStatement)):
            self._statements.append(node)
        return super().on_visit(node)

    def on_leave(  # type: ignore[override]
        self, original_node: cst.CSTNode, updated_node: cst.CSTNode
    ) -> cst.CSTNode | cst.RemovalSentinel | cst.FlattenSentinel[cst.CSTNode]:
        """Leave the current statement."""
        found = super().on_leave(original_node, updated_node)
        if self._statements and self._statements[-1] is original_node:
            self._statements.pop()
        return found

    # --- visited expressions ----------------------------------------------------------------------

    def params(self) -> cst.BaseExpression:
        """The expression for the parameters."""
        return cst.Attribute(cst.Name("self"), cst.Name("params"))

    def of_skiros2(self, node: cst.Attribute) -> None:
        """Report an attribute that EzSkiROS does not have; it stays unchanged."""
        self._warn_of(f"self.{node.attr.value}", node)

    def _warn_of(self, found: str, node: cst.CSTNode) -> None:
        reported = {getattr(each.template, "found", "") for each in self.warnings}
        if found not in reported:
            self.warnings.append(self._finding(implementation_errors.OfSkiros2(found=found), node))

    def visit_Attribute(self, node: cst.Attribute) -> None:  # noqa: D102, N802
        self._remember(node)
        if own(node, _OF_SKIROS2) and id(node) not in self._reported:
            self.of_skiros2(node)

    def visit_Call(self, node: cst.Call) -> bool | None:  # noqa: D102, N802
        self._remember(node)
        if _setting(node) is not None or self._unsets_individual(node):
            self._remember_params(node.func)
        return None

    def _unsets_individual(self, node: cst.BaseExpression) -> bool:
        """Say whether an assignment removes the value of a parameter for an individual. Other
        parameters cannot be without a value.
        """
        key = _unset_key(node)
        name = self._skill.names.get(literal_text(key) or "") if key is not None else None
        return name in self._skill.individuals

    def _remember(self, node: cst.BaseExpression) -> None:
        """Treat `self.params` in an expression as a part of it."""
        if parameter_key(node) is not None:
            self._remember_params(node)

    def _remember_params(self, node: cst.CSTNode) -> None:
        while not own(node, PARAMS):
            node = node.func if isinstance(node, cst.Call) else node.value  # type: ignore[attr-defined]
        self._read.add(id(node))

    def leave_Attribute(  # noqa: D102, N802
        self, original_node: cst.Attribute, updated_node: cst.Attribute
    ) -> cst.BaseExpression:
        if own(original_node, PARAMS) and id(original_node) not in self._read:
            self.leave(implementation_errors.ParameterUse(found=self.shown()), original_node)
        return self._value(original_node, updated_node)

    def leave_Call(  # noqa: D102, N802
        self, original_node: cst.Call, updated_node: cst.Call
    ) -> cst.BaseExpression:
        return self._value(original_node, updated_node)

    def _value(
        self, original: cst.BaseExpression, updated: cst.BaseExpression
    ) -> cst.BaseExpression:
        key = parameter_key(original)
        if key is None:
            return updated
        try:
            return self._parameter(key)
        except LeftError as left:
            self.leave(left.template, left.node)
            return updated

    def _parameter(self, key: cst.BaseExpression) -> cst.Attribute:
        """The translated parameter, such as `self.params.Speed`. Raises `LeftError`."""
        return cst.Attribute(self.params(), cst.Name(self.name_of(key)))

    def name_of(self, key: cst.BaseExpression) -> str:
        """The name of the parameter with a key. Raises `LeftError` if there is none."""
        text = literal_text(key)
        if text is None:
            computed = errors.ComputedArgument(argument="key", call="params", wanted="the text")
            raise LeftError(computed, key)
        if text not in self._skill.names or text in self._skill.added:
            raise LeftError(implementation_errors.UnknownKey(skill=self._skill.name, key=text), key)
        return self._skill.names[text]

    def leave_Expr(  # noqa: D102, N802
        self, original_node: cst.Expr, updated_node: cst.Expr
    ) -> cst.BaseSmallStatement:
        call, new = original_node.value, updated_node.value
        if self._unsets_individual(call):
            key = _unset_key(call)
            assert key is not None
            target = cst.AssignTarget(self._parameter(key))
            return cst.Assign([target], cst.Name("None"), semicolon=updated_node.semicolon)
        set_here = _setting(call) if isinstance(call, cst.Call) else None
        if set_here is None or not isinstance(new, cst.Call):
            return updated_node
        try:
            target = cst.AssignTarget(self._parameter(set_here[0]))
        except LeftError as left:
            self.leave(left.template, left.node)
            return updated_node
        return cst.Assign([target], new.args[-1].value, semicolon=updated_node.semicolon)

    def visit_Return(self, node: cst.Return) -> None:  # noqa: D102, N802
        if _start_error(node) is not None:
            self._reported.add(id(node.value.func))  # type: ignore[union-attr]

    def leave_SimpleStatementLine(  # noqa: N802
        self, original_node: cst.SimpleStatementLine, updated_node: cst.SimpleStatementLine
    ) -> cst.BaseStatement | cst.FlattenSentinel[cst.BaseStatement]:
        """Split `return self.startError(...)` into two statements: the failure, and the result of
        the start.
        """
        match original_node.body, updated_node.body:
            case [cst.Return() as old], [cst.Return(value=cst.Call() as call) as new]:
                if _start_error(old) is None:
                    return updated_node
                fail = call.with_changes(func=cst.Attribute(cst.Name("self"), cst.Name("fail")))
                first = cst.SimpleStatementLine(
                    [cst.Expr(fail)], leading_lines=updated_node.leading_lines
                )
                second = updated_node.with_changes(
                    body=[new.with_changes(value=cst.Name("False"))], leading_lines=()
                )
                return cst.FlattenSentinel([first, second])
            case _:  # open: any other line
                return updated_node

    def shown(self) -> str:
        """The text of the current statement, shortened."""
        bare = self._statements[-1].with_changes(leading_lines=())
        first = self._code(bare).strip().partition("\n")[0]
        return f"`{first}`" if len(first) <= 50 else f"`{first[:47]}...`"


def _start_error(node: cst.Return) -> cst.Call | None:
    """The call in `return self.startError(...)`."""
    found = node.value
    is_one = isinstance(found, cst.Call) and own(found.func, {"startError"})
    return found if is_one and isinstance(found, cst.Call) else None
