"""Translation of a SkiROS2 implementation class to a class derived from `Pick.SkillBase`."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import libcst as cst

from dslkit.diagnostics import Template
from ezskiros.migrate import implementation_errors, own_conditions
from ezskiros.migrate.built_on import SKIROS2_BASES, left_with, other_base
from ezskiros.migrate.calls import Arguments, last_name, literal_text, method
from ezskiros.migrate.class_bodies import (
    behind,
    empty_lines,
    lines_of,
    switch,
    with_lines,
    with_marks,
    without_old_marks,
)
from ezskiros.migrate.classes import OLD_DESCRIPTION
from ezskiros.migrate.comments import inner_comments, texts, without_marks
from ezskiros.migrate.description import UntranslatedPart
from ezskiros.migrate.docstrings import docstring_of
from ezskiros.migrate.errors import LeftError
from ezskiros.migrate.methods import Methods, translated_part
from ezskiros.migrate.parameter_uses import ParameterUses
from ezskiros.migrate.shared_keys import SharingChild, SharingTree
from ezskiros.migrate.skills import MigratedSkill
from ezskiros.migrate.tree_context import TreeContext
from ezskiros.migrate.trees import OLD, TreeUses

PLANNED = "available_for_planning"
"""The EzSkiROS attribute for SkiROS2's `setAvailableForPlanning`."""


@dataclass
class Implementation:
    """A class that implements a skill, its translation, and the reasons if it stays unchanged."""

    node: cst.ClassDef
    new: cst.ClassDef
    findings: list[UntranslatedPart] = field(default_factory=list)
    warnings: list[UntranslatedPart] = field(default_factory=list)
    skill: MigratedSkill | None = None
    children: Sequence[SharingChild] = ()

    def sharing(self) -> SharingTree | None:
        """The tree with the keys that its children share; None if its skill is unknown."""
        if self.skill is None:
            return None
        can_be = all(isinstance(each.template, _SHARED) for each in self.findings)
        return SharingTree(self.node.name.value, self.skill, self.children, can_be)

    def leave_out(self) -> None:
        """Drop undeclared keys that are not a reason to stay unchanged, if there are other reasons,
        and keep each key once.
        """
        others = [each for each in self.findings if not _is_open(each.template)]
        reported: dict[object, UntranslatedPart] = {}
        for each in others or self.findings:
            is_shared = isinstance(each.template, _SHARED)
            reported.setdefault(getattr(each.template, "key", "") if is_shared else id(each), each)
        self.findings = list(reported.values())


_SHARED = implementation_errors.SharedName


def _is_open(template: Template) -> bool:
    """Say whether a finding is about an undeclared key that a description may get as a
    parameter.
    """
    return isinstance(template, _SHARED) and not template.why


def described_by(node: cst.ClassDef) -> cst.Call | None:
    """The call of `setDescription` in a class that implements a skill; None for other classes."""
    function = _functions(node).get(OLD_DESCRIPTION)
    for statement in function.body.body if function is not None else ():
        for small in _small(statement):
            match small:
                case cst.Expr(value=cst.Call() as call) if method(call) == "setDescription":
                    return call
                case _:  # open: any other node
                    pass
    return None


def _small(statement: cst.CSTNode) -> Sequence[cst.CSTNode]:
    """The small statements of a line, otherwise the statement itself."""
    return statement.body if isinstance(statement, cst.SimpleStatementLine) else [statement]


def label_of(call: cst.Call) -> str | None:
    """The name that an implementation gives itself, if it is a literal."""
    try:
        label = Arguments(call, "setDescription").get("label")
    except LeftError:
        return None
    return literal_text(label) if label is not None else None


def description_name(call: cst.Call) -> str | None:
    """The name of the description, such as `Pick` in `self.setDescription(Pick(), ...)`."""
    match call.args:
        case [cst.Arg(value=cst.Call(func=func)), *_]:
            return last_name(func)
        case _:  # open: any other arguments
            return None


def translate_implementation(
    node: cst.ClassDef,
    context: TreeContext,
    code: Callable[[cst.CSTNode], str],
    names: Mapping[str, str],
) -> Implementation:
    """The class derived from the `SkillBase` of its skill.

    `code` gives the text of an expression. `names` maps the imported names of the file to their
    original names.
    """
    return _Class(node, context, code, names).translated()


class _Class:
    def __init__(
        self,
        node: cst.ClassDef,
        context: TreeContext,
        code: Callable[[cst.CSTNode], str],
        names: Mapping[str, str],
    ) -> None:
        self._node, self._context, self._code, self._names = node, context, code, names
        self._found = Implementation(node, node)
        self._is_planned = True

    def translated(self) -> Implementation:
        found = self._found
        try:
            skill, base = self._skill()
        except LeftError as left:
            found.findings.append(UntranslatedPart(left.template, left.node, self._node))
            return self._left()
        bases = self._bases(base)
        comments = self._description()
        parts, used = self._methods(skill)
        found.skill = skill
        found.leave_out()
        if found.findings:
            return self._left()
        body = self._body(parts, comments, used)
        found.new = self._node.with_changes(
            bases=bases, body=body, leading_lines=without_marks(self._node.leading_lines)
        )
        return found

    def _leave(self, template: Template, node: cst.CSTNode, statement: cst.CSTNode) -> None:
        self._found.findings.append(UntranslatedPart(template, node, statement))

    def _left(self) -> Implementation:
        self._found.new = with_marks(self._node, self._found.findings)
        return self._found

    # --- its skill ----------------------------------------------------------------------------

    def _skill(self) -> tuple[MigratedSkill, cst.BaseExpression]:
        """The skill, and its local name. Raises `LeftError` if the skill is unknown."""
        call = described_by(self._node)
        assert call is not None
        given = Arguments(call, "setDescription")
        made, label = given["description"], given.get("label")
        is_made = isinstance(made, cst.Call) and not made.args
        if not is_made or not isinstance(made, cst.Call) or (name := last_name(made.func)) is None:
            raise LeftError(
                implementation_errors.OtherDescription(found=f"`{self._code(made)}`"), made
            )
        if label is not None and "__name__" not in self._code(label) and label_of(call) is None:
            raise LeftError(
                implementation_errors.OtherDescription(found=f"`{self._code(label)}`"), label
            )
        name = self._names.get(name, name)
        found = self._context.skills.called(name, self._context.path)
        if len(found) != 1 or found[0].is_left:
            said = found[0].left_as() if found else "not described in these files"
            raise LeftError(implementation_errors.UnusableSkill(skill=name, found=said), made)
        return found[0], made.func

    def _bases(self, skill: cst.BaseExpression) -> list[cst.Arg]:
        """The base classes, with that of the skill instead of SkiROS2's."""
        new = cst.Attribute(skill.deep_clone(), cst.Name("SkillBase"))
        bases = []
        is_plain = False
        for each in self._node.bases:
            name = last_name(each.value)
            is_old = self._names.get(name or "", name) in SKIROS2_BASES
            is_plain = is_plain or is_old
            bases.append(each.with_changes(value=new) if is_old else each)
        if not is_plain and (found := other_base(self._node, self._context, self._names)):
            self._leave(found, self._node.name, self._node)
        elif not is_plain:
            bases.append(cst.Arg(new))  # last, because the other base classes override it
        if (left := left_with(self._node, self._context)) is not None:
            self._leave(left, self._node.name, self._node)
        return bases

    def _description(self) -> list[str]:
        """The comments of `createDescription`, which is removed because it contains nothing
        else.
        """
        function = _functions(self._node)[OLD_DESCRIPTION]
        call = described_by(self._node)
        label = label_of(call) if call is not None else None
        comments = [f"# {label}"] if label not in (None, "", self._node.name.value) else []
        comments += texts(function.leading_lines)
        for part in function.body.body:
            comments += texts(getattr(part, "leading_lines", ()))
            comments += behind(part)
            for each in _small(part):
                is_known = isinstance(each, cst.Expr) and each.value is call
                doc = docstring_of(part)
                if doc is not None:
                    comments += [f"# {line.strip()}" for line in lines_of(doc)]
                elif (planned := _planning(each)) is not None:
                    self._is_planned = planned
                elif not is_known and not isinstance(each, cst.Pass):
                    self._leave(
                        implementation_errors.OtherDescription(found=self._shown(each)), each, part
                    )
        comments += texts(getattr(function.body, "footer", ()))
        return [each for each in comments if each]

    def _shown(self, node: cst.CSTNode) -> str:
        bare = node.with_changes(leading_lines=()) if hasattr(node, "leading_lines") else node
        first = self._code(bare).strip().partition("\n")[0]
        return f"`{first}`" if len(first) <= 50 else f"`{first[:47]}...`"

    # --- its methods --------------------------------------------------------------------------

    def _methods(self, skill: MigratedSkill) -> tuple[dict[int, cst.CSTNode | None], set[str]]:
        """The new parts of the class by the old parts, None for removed parts; and the methods that
        became part of the tree.
        """
        new: dict[int, cst.CSTNode | None] = {}
        used: set[str] = set()
        tree = _functions(self._node).get(OLD)
        if tree is not None:
            uses = TreeUses(skill, self._code, self._context)
            new[id(tree)] = tree.visit(uses)  # type: ignore[assignment]
            self._take(uses)
            used = uses.used
            self._found.children = uses.sharing
        for part in self._node.body.body:
            name = part.name.value if isinstance(part, cst.FunctionDef) else ""
            if part is tree or name == OLD_DESCRIPTION or name in used:
                continue
            if isinstance(part, cst.FunctionDef) and name == own_conditions.OLD:
                new[id(part)] = self._own_conditions(part, skill)
                continue
            new[id(part)], plain = translated_part(part, lambda: self._uses(skill))
            self._take(plain)
        self._found.warnings = list(
            {getattr(each.template, "found", ""): each for each in self._found.warnings}.values()
        )
        return new, used

    def _own_conditions(
        self, function: cst.FunctionDef, skill: MigratedSkill
    ) -> cst.FunctionDef | None:
        """The method `conditions`; None if it would be empty."""
        context = self._context
        found, left = own_conditions.translate_own(
            function, skill, context.names, context.known, self._code
        )
        self._found.findings += left
        return found

    def _uses(self, skill: MigratedSkill) -> Methods:
        return Methods(skill, self._code, self._node, self._context.states)

    def _take(self, uses: ParameterUses) -> None:
        self._found.findings += uses.findings
        self._found.warnings += uses.warnings

    def _body(
        self, parts: Mapping[int, cst.CSTNode | None], comments: Sequence[str], used: set[str]
    ) -> cst.BaseSuite:
        """The body. The comments of removed parts move above the next part."""
        waiting: list[str] = []
        body: list[cst.CSTNode] = []
        for part in self._node.body.body:
            if isinstance(part, cst.FunctionDef) and part.name.value == OLD_DESCRIPTION:
                waiting += comments
                if not self._is_planned:
                    body.append(switch(PLANNED, waiting, is_first=not body))
                    waiting = []
            elif not (isinstance(part, cst.FunctionDef) and part.name.value in used):
                new = parts[id(part)]
                if new is None:
                    waiting += inner_comments(without_old_marks(part))
                    continue
                body.append(with_lines(without_old_marks(new), waiting, is_first=not body))
                waiting = []
        footer = getattr(self._node.body, "footer", ())
        if not body or all(docstring_of(each) is not None for each in body):
            body.append(with_lines(cst.SimpleStatementLine([cst.Pass()]), waiting, is_first=True))
            waiting = []
        lines = [*empty_lines(waiting), *footer]
        if isinstance(self._node.body, cst.IndentedBlock):
            return self._node.body.with_changes(body=body, footer=lines)
        return cst.IndentedBlock(body=body, footer=lines)  # type: ignore[arg-type]


def _planning(statement: cst.CSTNode) -> bool | None:
    """Say whether the statement makes a skill available for planning; None for other statements."""
    match statement:
        case cst.Expr(
            value=cst.Call(args=[cst.Arg(value=cst.Name(value="True" | "False" as said))]) as call
        ) if method(call) == "setAvailableForPlanning":
            return said == "True"
        case _:  # open: any other node
            pass
    return None


def _functions(node: cst.ClassDef) -> dict[str, cst.FunctionDef]:
    """The methods of a class."""
    return {each.name.value: each for each in node.body.body if isinstance(each, cst.FunctionDef)}


def helpers_of(node: cst.ClassDef) -> Mapping[str, cst.FunctionDef]:
    """The methods of a class that its other methods may call."""
    return _functions(node)


def labels_in(classes: Iterable[cst.ClassDef]) -> dict[str, str]:
    """The names that classes of implementations give themselves, with their Python names."""
    found = {}
    for node in classes:
        call = described_by(node)
        label = label_of(call) if call is not None else None
        if label:
            found[label] = node.name.value
    return found
