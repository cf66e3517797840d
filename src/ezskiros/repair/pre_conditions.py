"""Insertion of missing pre-conditions into the source of a description; the rest stays
unchanged.
"""

from __future__ import annotations

from collections.abc import Sequence

import libcst as cst
import libcst.matchers as m

from dslkit.source.python_file import too_deep
from ezskiros.skills import description as words

_METHOD = "description"
_FUNCTIONS = {"specified", "generated", "of_type", "abstract"}


def with_pre_conditions(text: str, skill: str, conditions: Sequence[str]) -> str | None:
    """The text of a module with conditions added to the class of a skill, after its existing
    conditions.

    None if this is impossible: the class has no description of its own in the module, the text is
    not valid Python, or the module does not have the names that the conditions need.
    """
    if too_deep(text) is not None:
        return None
    try:
        module = cst.parse_module(text)
        lines = [cst.parse_statement(each, module.config_for_parsing) for each in conditions]
        return _with_conditions(module, skill, lines) if _has_names(module, lines) else None
    except (cst.ParserSyntaxError, cst.CSTLogicError, RecursionError, ValueError):
        return None


def _with_conditions(
    module: cst.Module, skill: str, lines: Sequence[cst.BaseStatement]
) -> str | None:
    adding = _Adding(skill, [each for each in lines if isinstance(each, cst.SimpleStatementLine)])
    changed = module.visit(adding)
    return changed.code if adding.is_done else None


class _Adding(cst.CSTTransformer):
    """Adds conditions to the method `description` of one class at the top level of a module."""

    def __init__(self, skill: str, lines: Sequence[cst.SimpleStatementLine]) -> None:
        self._skill, self._lines = skill, lines
        self._within: list[str] = []
        self.is_done = False

    def visit_ClassDef(self, node: cst.ClassDef) -> None:  # noqa: N802 - names of libcst
        self._within.append(node.name.value)

    def leave_ClassDef(  # noqa: N802
        self, _original: cst.ClassDef, updated_node: cst.ClassDef
    ) -> cst.ClassDef:
        self._within.pop()
        return updated_node

    def visit_FunctionDef(self, node: cst.FunctionDef) -> None:  # noqa: N802
        self._within.append(node.name.value)

    def leave_FunctionDef(  # noqa: N802
        self, _original: cst.FunctionDef, updated_node: cst.FunctionDef
    ) -> cst.FunctionDef:
        path = list(self._within)
        self._within.pop()
        owner = _first_parameter(updated_node)
        if path != [self._skill, _METHOD] or self.is_done or owner is None:
            return updated_node
        self.is_done = True
        lines = [_of(owner, each) for each in self._lines]
        return updated_node.with_changes(body=_with_lines(updated_node.body, owner, lines))


def _first_parameter(method: cst.FunctionDef) -> str | None:
    known = (*method.params.posonly_params, *method.params.params)
    return known[0].name.value if known else None


def _of(owner: str, line: cst.SimpleStatementLine) -> cst.SimpleStatementLine:
    """The line with the first parameter of the method instead of `self`."""
    replaced = m.replace(
        line,
        m.Attribute(value=m.Name("self"), attr=m.Name("pre_conditions")),
        cst.Attribute(cst.Name(owner), cst.Name("pre_conditions")),
    )
    assert isinstance(replaced, cst.SimpleStatementLine)
    return replaced


def _with_lines(
    body: cst.BaseSuite, owner: str, lines: Sequence[cst.SimpleStatementLine]
) -> cst.IndentedBlock:
    """A body with more statements. A single `pass` or `...` is removed."""
    block = body if isinstance(body, cst.IndentedBlock) else _as_block(body)
    old = [each for each in block.body if not _is_nothing(each)]
    place = _place(old, owner)
    return block.with_changes(body=[*old[:place], *lines, *old[place:]])


def _as_block(body: cst.BaseSuite) -> cst.IndentedBlock:
    """Move the statements after the colon to lines below it."""
    assert isinstance(body, cst.SimpleStatementSuite)
    return cst.IndentedBlock([cst.SimpleStatementLine(list(body.body))])


def _place(body: Sequence[cst.BaseStatement], owner: str) -> int:
    """The position after the existing pre-conditions, otherwise after the docstring."""
    adding = m.AugAssign(
        target=m.Attribute(value=m.Name(owner), attr=m.Name("pre_conditions")),
        operator=m.AddAssign(),
    )
    places = [index for index, each in enumerate(body) if m.findall(each, adding)]
    returns = [index for index, each in enumerate(body) if _is_return(each)]
    if places:
        return min([places[-1] + 1, *returns])
    return int(bool(body) and _is_text(body[0]))


def _is_return(line: cst.BaseStatement) -> bool:
    return m.matches(line, m.SimpleStatementLine(body=[m.Return()]))


def _is_nothing(line: cst.BaseStatement) -> bool:
    nothing = m.SimpleStatementLine(body=[m.Pass() | m.Expr(value=m.Ellipsis())])
    return m.matches(line, nothing)


def _is_text(line: cst.BaseStatement) -> bool:
    text = m.Expr(value=m.SimpleString() | m.ConcatenatedString())
    return m.matches(line, m.SimpleStatementLine(body=[text]))


def _has_names(module: cst.Module, lines: Sequence[cst.CSTNode]) -> bool:
    """Say whether a module has the functions and the namespaces of conditions."""
    needed: set[str] = set()
    for line in lines:
        for call in m.findall(line, m.Call(func=m.Name())):
            assert isinstance(call, cst.Call)
            assert isinstance(call.func, cst.Name)
            needed.add(call.func.value)
            if call.func.value == words.of_type.__name__:
                owner = call.args[1].value
                needed |= {owner.value.value} if m.matches(owner, m.Attribute(m.Name())) else set()  # type: ignore[attr-defined]
    return needed <= _bound(module)


def _bound(module: cst.Module) -> set[str]:
    """The names that a module imports or assigns at its top level."""
    found: set[str] = set()
    for each in m.findall(module, m.ImportFrom()):
        assert isinstance(each, cst.ImportFrom)
        if isinstance(each.names, cst.ImportStar):
            is_ours = each.module is not None and m.matches(each.module, m.Name("ezskiros"))
            found |= _FUNCTIONS if is_ours else set()
        else:
            found |= {alias.evaluated_alias or alias.evaluated_name for alias in each.names}
    for line in module.body:
        for target in m.findall(line, m.AssignTarget()):
            found |= {name.value for name in m.findall(target, m.Name())}  # type: ignore[attr-defined]
    return found
