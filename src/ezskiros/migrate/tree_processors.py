"""The processor of each call of `skill(...)` in `expand`, on all paths that lead there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import libcst as cst
import libcst.matchers as m

from dslkit.diagnostics import Template
from ezskiros.migrate import implementation_errors, processors
from ezskiros.migrate.calls import last_name, method
from ezskiros.migrate.description import UntranslatedPart


class ProcessorChoice:
    """The processors of the trees in some statements. `argument` is the name of the argument
    `skill` in `expand`.

    `chosen` maps the identity of the call that adds the children to its processor. `dropped` are
    the statements that choose processors, `done` the names that are translated with them, and
    `findings` the mistakes.
    """

    def __init__(self, argument: str, statements: Sequence[cst.CSTNode]) -> None:
        self._argument = argument
        self.chosen: dict[int, cst.BaseExpression] = {}
        self.dropped: set[int] = set()
        self.done: set[int] = set()
        self.findings: list[UntranslatedPart] = []
        self._read(statements, _Flow(processors.DEFAULT))

    def _read(self, statements: Sequence[cst.CSTNode], flow: _Flow) -> _Flow:
        for statement in statements:
            match statement:
                case cst.SimpleStatementLine(body=[cst.Expr(value=cst.Call() as call)]):
                    self._call(statement, call, flow)
                case cst.If():
                    flow = self._branches(statement, flow)
                case _:  # open: any other statement
                    pass
        return flow

    def _call(self, line: cst.SimpleStatementLine, call: cst.Call, flow: _Flow) -> None:
        for owner in (self._argument, "self"):
            if method(call, owner) == "setProcessor" and len(call.args) == 1:
                self.dropped.add(id(line))
                self.done |= {id(each) for each in m.findall(call, m.Name(self._argument))}
                if owner == "self":
                    flow.own = _Own(line, call)
                else:
                    flow.chosen = call.args[0].value
        if isinstance(call.func, cst.Name) and call.func.value == self._argument:
            self._tree(line, call, flow)

    def _tree(self, line: cst.SimpleStatementLine, call: cst.Call, flow: _Flow) -> None:
        self.done.add(id(call.func))
        if flow.is_built:
            self._leave(implementation_errors.SeveralTrees(), call, line)
        if flow.chosen is None:
            found = "a processor that only some branches choose"
            self._leave(implementation_errors.NoTree(found=found), call, line)
            flow.chosen = processors.DEFAULT
        self.chosen[id(call)] = flow.chosen
        own = flow.own
        if own and flow.chosen is processors.DEFAULT and not _is_same(own.chosen, flow.chosen):
            found = last_name(getattr(own.chosen, "func", own.call)) or "it"
            self._leave(implementation_errors.OwnProcessor(found=found), own.call, own.line)
        flow.is_built = True

    def _branches(self, statement: cst.If, flow: _Flow) -> _Flow:
        ends: list[_Flow] = []
        branch: cst.If | cst.Else | None = statement
        while branch is not None:
            found = self._read(branch.body.body, flow.copy())
            if not _leaves(branch.body.body):
                ends.append(found)
            if isinstance(branch, cst.Else):
                return _joined(ends, flow)
            branch = branch.orelse
        return _joined([*ends, flow], flow)

    def _leave(self, template: Template, node: cst.CSTNode, line: cst.CSTNode) -> None:
        self.findings.append(UntranslatedPart(template, node, line))


@dataclass(frozen=True)
class _Own:
    """A processor that a compound sets on itself, which SkiROS2 ignores afterwards."""

    line: cst.SimpleStatementLine
    call: cst.Call

    @property
    def chosen(self) -> cst.BaseExpression:
        return self.call.args[0].value


@dataclass
class _Flow:
    """The state at one point of a method: the processor, None if it depends on branches; and
    whether there is a tree.
    """

    chosen: cst.BaseExpression | None
    own: _Own | None = None
    is_built: bool = False

    def copy(self) -> _Flow:
        """A copy for one branch."""
        return _Flow(self.chosen, self.own, self.is_built)


def _joined(ends: Sequence[_Flow], before: _Flow) -> _Flow:
    """The state after some branches."""
    if not ends:
        return before
    first = ends[0]
    is_same = all(_is_same(each.chosen, first.chosen) for each in ends)
    chosen = first.chosen if is_same else None
    return _Flow(chosen, first.own, any(each.is_built for each in ends))


def _is_same(one: cst.BaseExpression | None, other: cst.BaseExpression | None) -> bool:
    """Say whether two processors are equal. One processor has two names."""
    if one is None or other is None:
        return False
    names = [last_name(each.func) if isinstance(each, cst.Call) else None for each in (one, other)]
    methods = [processors.METHODS.get(name or "") for name in names]
    return methods[0] == methods[1] is not None or one.deep_equals(other)


def _leaves(statements: Sequence[cst.CSTNode]) -> bool:
    """Say whether the code after some statements is never reached."""
    match statements[-1] if statements else None:
        case cst.SimpleStatementLine(body=[*_, cst.Return() | cst.Raise()]):
            return True
        case _:  # open: any other statement, or none
            return False
