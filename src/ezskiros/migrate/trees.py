"""Translation of the method `expand` to `expandBT`: the same tree, with skills by name."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import libcst as cst

from ezskiros.migrate import implementation_errors, processors
from ezskiros.migrate.calls import literal_text, method
from ezskiros.migrate.comments import inner_comments
from ezskiros.migrate.errors import LeftError
from ezskiros.migrate.imports import used_names
from ezskiros.migrate.parameter_uses import ParameterUses, parameter_key
from ezskiros.migrate.shared_keys import SharingChild
from ezskiros.migrate.skills import MigratedSkill
from ezskiros.migrate.tree_children import ChildTranslation
from ezskiros.migrate.tree_context import PartPosition, TreeContext
from ezskiros.migrate.tree_methods import MAKERS, inlined, knows_robot, made_by
from ezskiros.migrate.tree_processors import ProcessorChoice

OLD, NEW = "expand", "expandBT"


class TreeUses(ParameterUses):
    """Translates the method `expand` of an implementation of `skill`.

    `used` are the methods of the class that became part of the tree.
    """

    def __init__(
        self, skill: MigratedSkill, code: Callable[[cst.CSTNode], str], context: TreeContext
    ) -> None:
        super().__init__(skill, code)
        self._context = context
        self._children = ChildTranslation(skill, code, self.shown, context)
        self._argument = ""
        self._chosen: dict[int, cst.BaseExpression] = {}
        self._dropped: set[int] = set()
        self._done: set[int] = set()
        self._individuals: set[str] = set()
        self._where: PartPosition | None = None
        # Nodes that are identified by `id` must be kept alive, because Python reuses the identity
        # of a deleted object.
        self._gone: dict[int, cst.CSTNode] = {}
        self._filled: list[cst.CSTNode] = []
        self._inlining: list[cst.FunctionDef] = []
        self.used: set[str] = set()

    def params(self) -> cst.BaseExpression:
        """The argument of `expandBT`."""
        return cst.Name(self._children.params)

    def _unsets_individual(self, node: cst.BaseExpression) -> bool:  # noqa: ARG002
        """Return False: no parameter changes while a tree is built."""
        return False

    def of_skiros2(self, node: cst.Attribute) -> None:
        """Report an attribute of SkiROS2: a tree is known before the robot runs."""
        self.leave(implementation_errors.NoTree(found=self.shown()), node)

    @property
    def sharing(self) -> Sequence[SharingChild]:
        """The keys that the children share."""
        return self._children.sharing

    # --- the method ---------------------------------------------------------------------------

    def visit_FunctionDef(self, node: cst.FunctionDef) -> bool | None:  # noqa: D102, N802
        if node.name.value != OLD or self._argument:
            return None
        plain = node.params.params
        if len(plain) != 2 or node.decorators or not isinstance(node.body, cst.IndentedBlock):
            self.leave(implementation_errors.NoTree(found=f"`def {node.name.value}`"), node.name)
            return False
        self._argument = plain[1].name.value
        while self._children.params in used_names(node) - {self._argument}:
            self._children.params += "_"
        self._done.add(id(plain[1].name))
        plan = ProcessorChoice(self._argument, node.body.body)
        self._chosen, self._dropped = plan.chosen, plan.dropped
        self._done |= plan.done
        self.findings += plan.findings
        return None

    def leave_FunctionDef(  # noqa: D102, N802
        self, original_node: cst.FunctionDef, updated_node: cst.FunctionDef
    ) -> cst.FunctionDef:
        if original_node.name.value != OLD or self.findings:
            return updated_node
        first, *rest = updated_node.params.params
        rest = [each.with_changes(name=cst.Name(self._children.params)) for each in rest]
        parameters = updated_node.params.with_changes(params=[first, *rest])
        imports = [cst.parse_statement(line) for line in self._children.imports]
        body = updated_node.body.with_changes(body=[*imports, *updated_node.body.body])
        return updated_node.with_changes(name=cst.Name(NEW), params=parameters, body=body)

    # --- statements ---------------------------------------------------------------------------

    def leave_SimpleStatementLine(  # noqa: D102, N802
        self, original_node: cst.SimpleStatementLine, updated_node: cst.SimpleStatementLine
    ) -> cst.BaseStatement | cst.FlattenSentinel[cst.BaseStatement]:
        if id(original_node) in self._dropped:
            self._gone[id(updated_node)] = updated_node
            return updated_node
        return super().leave_SimpleStatementLine(original_node, updated_node)

    def leave_IndentedBlock(  # noqa: N802
        self,
        original_node: cst.IndentedBlock,  # noqa: ARG002
        updated_node: cst.IndentedBlock,
    ) -> cst.IndentedBlock:
        """Remove the statements that choose a processor. Their comments move to the next
        statement.
        """
        waiting: list[cst.EmptyLine] = []
        body: list[cst.BaseStatement] = []
        for new in updated_node.body:
            if id(new) in self._gone:
                waiting += _comments_of(new)
            else:
                lines = [*waiting, *new.leading_lines] if waiting else new.leading_lines  # type: ignore[attr-defined]
                body.append(new.with_changes(leading_lines=lines))
                waiting = []
        if not body:
            body = [cst.SimpleStatementLine([cst.Pass()])]
        return updated_node.with_changes(body=body, footer=[*waiting, *updated_node.footer])

    def visit_Assign(self, node: cst.Assign) -> None:  # noqa: D102, N802
        key = parameter_key(node.value)
        for each in node.targets:
            if parameter_key(each.target) is not None:
                self.leave(implementation_errors.NoTree(found=self.shown()), node)
            if key is not None and isinstance(each.target, cst.Name) and self._is_individual(key):
                self._individuals.add(each.target.value)

    def visit_Name(self, node: cst.Name) -> None:  # noqa: D102, N802
        if node.value == self._argument and id(node) not in self._done:
            self.leave(implementation_errors.NoTree(found=self.shown()), node)

    def visit_Arg(self, node: cst.Arg) -> None:  # noqa: D102, N802
        self._done.add(id(node.keyword))  # not a variable

    def visit_Attribute(self, node: cst.Attribute) -> None:  # noqa: D102, N802
        super().visit_Attribute(node)
        self._done.add(id(node.attr))
        key = parameter_key(node.value)
        is_individual = isinstance(node.value, cst.Name) and node.value.value in self._individuals
        if is_individual or (key is not None and self._is_individual(key)):
            self.leave(implementation_errors.QueriedIndividual(found=self.shown()), node)

    def _is_individual(self, key: cst.BaseExpression) -> bool:
        return self._skill.names.get(literal_text(key) or "") in self._skill.individuals

    # --- children -----------------------------------------------------------------------------

    def visit_Call(self, node: cst.Call) -> bool | None:  # noqa: D102, N802
        super().visit_Call(node)
        if _is_group(node):
            self._done.add(id(node.func))
        name = method(node)
        is_dropped = name == "setProcessor" and id(self._statements[-1]) in self._dropped
        if name is None or name in MAKERS or is_dropped:
            return None
        helper = self._context.helpers.get(name)
        if helper is not None and made_by(helper) is not None:
            return False  # the result of the method
        if helper is None or knows_robot(helper):
            self.leave(implementation_errors.NoTree(found=f"`self.{name}(...)`"), node)
        return None

    def leave_Call(  # noqa: D102, N802
        self, original_node: cst.Call, updated_node: cst.Call
    ) -> cst.BaseExpression:
        try:
            return self._call(original_node, updated_node)
        except LeftError as left:
            self.leave(left.template, left.node)
            return updated_node

    def _call(self, original: cst.Call, updated: cst.Call) -> cst.BaseExpression:
        """Translate a call. Raises `LeftError`."""
        if id(original) in self._chosen:
            return processors.wrapper(self._chosen[id(original)])(updated)
        if _is_group(original) and isinstance(original.func, cst.Call):
            return processors.wrapper(original.func.args[0].value)(updated)
        name = method(original)
        helper = self._context.helpers.get(name or "")
        if helper is not None and made_by(helper) is not None:
            return self._inlined(original, helper)
        if name == "skill" and id(original) not in self._done:
            place = self._inside(self._where or self._context.place(original))
            return self._children.translated(original, updated, place)
        if name in MAKERS and id(original) not in self._done:
            raise LeftError(implementation_errors.NoTree(found=self.shown()), original)
        return super().leave_Call(original, updated)

    def _inlined(self, call: cst.Call, helper: cst.FunctionDef) -> cst.BaseExpression:
        """The expression that a method returns for some arguments, instead of its call. Raises
        `LeftError`.
        """
        filled = None if helper in self._inlining else inlined(helper, call)
        if filled is None or inner_comments(helper):
            raise LeftError(implementation_errors.NoTree(found=f"`{self._code(call)}`"), call)
        self.used.add(helper.name.value)
        place, where = self._place, self._where
        self._place, self._where = place or call, where or self._context.place(call)
        self._filled.append(filled)
        self._inlining.append(helper)
        found = filled.visit(self)
        self._inlining.pop()
        self._place, self._where = place, where
        assert isinstance(found, cst.BaseExpression)
        return found

    def _inside(self, place: PartPosition) -> PartPosition:
        """A position, with the additional indentation inside its statement."""
        before = self._context.place(self._statements[-1]).indent
        return PartPosition(place.column, place.indent.removeprefix(before))


def _is_group(call: cst.Call) -> bool:
    """Say whether a call is `self.skill(Serial())(...)`."""
    inner = call.func
    if not isinstance(inner, cst.Call) or method(inner) != "skill" or len(inner.args) != 1:
        return False
    return literal_text(inner.args[0].value) is None


def _comments_of(line: cst.CSTNode) -> list[cst.EmptyLine]:
    """The comments of a removed statement."""
    assert isinstance(line, cst.SimpleStatementLine)
    behind = line.trailing_whitespace.comment
    lines = [each for each in line.leading_lines if each.comment]
    return [*lines, *([cst.EmptyLine(comment=behind)] if behind else [])]
