"""Methods of a compound skill that its tree calls. Methods that return one child become part of the
tree.
"""

from __future__ import annotations

from collections.abc import Mapping

import libcst as cst
import libcst.matchers as m

from ezskiros.migrate.calls import method

MAKERS = frozenset({"skill", "getSkill", "getNode"})
"""The SkiROS2 methods that make a child."""


def made_by(helper: cst.FunctionDef) -> cst.BaseExpression | None:
    """The child that a method returns, if the method only returns a child."""
    match helper.body:
        case cst.IndentedBlock(
            body=[*_, cst.SimpleStatementLine(body=[cst.Return(value=cst.Call() as made)])] as body
        ) if len(body) == 1:
            names = {method(each) for each in m.findall(made, m.Call())}  # type: ignore[arg-type]
            return made if names & MAKERS else None
        case _:  # open: any other node
            pass
    return None


def inlined(helper: cst.FunctionDef, call: cst.Call) -> cst.BaseExpression | None:
    """The expression that a method returns, with the arguments of a call; None if they do not
    fit.
    """
    made, given = made_by(helper), _arguments(helper, call)
    if made is None or given is None:
        return None
    found = made.visit(_Filled(given))
    assert isinstance(found, cst.BaseExpression)
    return found


def knows_robot(helper: cst.FunctionDef) -> bool:
    """Say whether a method uses attributes that only a running skill has."""
    own_names = m.findall(helper, m.Attribute(value=m.Name("self")))
    return bool(own_names)


def _arguments(helper: cst.FunctionDef, call: cst.Call) -> dict[str, cst.BaseExpression] | None:
    """The arguments of a call by parameter name; None if they do not fit."""
    parameters = helper.params.params[1:]
    names = [each.name.value for each in parameters]
    given = {each.name.value: each.default for each in parameters if each.default is not None}
    for position, argument in enumerate(call.args):
        keyword = argument.keyword.value if argument.keyword else None
        name = keyword or (names[position] if position < len(names) else "")
        if argument.star or name not in names:
            return None
        given[name] = argument.value
    return given if {*given} == {*names} and not helper.decorators else None


class _Filled(cst.CSTTransformer):
    """Replaces the parameters of a method by arguments."""

    def __init__(self, given: Mapping[str, cst.BaseExpression]) -> None:
        self._given = given

    def leave_Attribute(  # noqa: N802
        self, original_node: cst.Attribute, updated_node: cst.Attribute
    ) -> cst.BaseExpression:
        return updated_node.with_changes(attr=original_node.attr)

    def leave_Arg(self, original_node: cst.Arg, updated_node: cst.Arg) -> cst.Arg:  # noqa: N802
        return updated_node.with_changes(keyword=original_node.keyword)

    def leave_Name(  # noqa: N802
        self, original_node: cst.Name, updated_node: cst.Name
    ) -> cst.BaseExpression:
        found = self._given.get(original_node.value)
        return found.deep_clone() if found is not None else updated_node
