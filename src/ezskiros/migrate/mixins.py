"""Translation of a base class of SkiROS2 primitives to a class without SkiROS2's own base."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import libcst as cst

from dslkit.diagnostics import listed
from ezskiros.migrate import errors, implementation_errors
from ezskiros.migrate.built_on import SKIROS2_BASES, left_with
from ezskiros.migrate.calls import last_name, literal_text, method
from ezskiros.migrate.class_bodies import with_marks, without_old_marks
from ezskiros.migrate.comments import without_marks
from ezskiros.migrate.description import UntranslatedPart
from ezskiros.migrate.errors import LeftError
from ezskiros.migrate.implementations import Implementation
from ezskiros.migrate.keys import parameter_names
from ezskiros.migrate.methods import Methods, translated_part
from ezskiros.migrate.skills import MigratedSkill
from ezskiros.migrate.tree_context import TreeContext
from ezskiros.migrate.trees import OLD


def translate_mixin(
    node: cst.ClassDef,
    context: TreeContext,
    code: Callable[[cst.CSTNode], str],
    names: Mapping[str, str],
) -> Implementation:
    """The class without SkiROS2's own base. Its parameters are those of the derived skills."""
    found = Implementation(node, node)
    skills = _skills_on_top(node, context)
    parts = []
    for part in node.body.body:
        uses = _on_top(node, skills, code, context)
        new, said = translated_part(part, uses)
        parts.append(without_old_marks(new))
        found.findings += [*_no_mixin(part), *said.findings]
        found.warnings += said.warnings
    if (left := left_with(node, context)) is not None:
        found.findings.append(UntranslatedPart(left, node.name, node))
    if found.findings:
        found.new = with_marks(node, found.findings)
        return found
    found.new = _without_base(node, names).with_changes(
        body=node.body.with_changes(body=parts), leading_lines=without_marks(node.leading_lines)
    )
    return found


def _skills_on_top(node: cst.ClassDef, context: TreeContext) -> list[MigratedSkill]:
    """The translated skills whose implementations are derived from a class."""
    found = []
    for each in context.skills.bases.on_top((context.path, node.name.value)):
        skills = context.skills.called(each.implements or "", each.path)
        found += skills if len(skills) == 1 and not skills[0].is_left else []
    return list({each.id: each for each in found}.values())


def _without_base(node: cst.ClassDef, names: Mapping[str, str]) -> cst.ClassDef:
    """The class without SkiROS2's own base."""
    called = [(each, last_name(each.value) or "") for each in node.bases]
    bases = [each for each, name in called if names.get(name, name) not in SKIROS2_BASES]
    if bases:
        last = bases[-1].with_changes(comma=cst.MaybeSentinel.DEFAULT)
        return node.with_changes(bases=[*bases[:-1], last])
    default = cst.MaybeSentinel.DEFAULT
    brackets = {} if node.keywords else {"lpar": default, "rpar": default}
    return node.with_changes(bases=[], **brackets)


def _no_mixin(part: cst.CSTNode) -> list[UntranslatedPart]:
    """Findings for methods that only a class with one description can have."""
    if not isinstance(part, cst.FunctionDef):
        return []
    name = f"`def {part.name.value}`"
    if part.name.value == OLD:
        return [UntranslatedPart(implementation_errors.NoTree(found=name), part.name, part)]
    if part.name.value == "modifyDescription":
        return [
            UntranslatedPart(implementation_errors.OtherDescription(found=name), part.name, part)
        ]
    calls = _Children()
    part.visit(calls)
    template = implementation_errors.NoTree(found="a child in a class without a description")
    return [UntranslatedPart(template, call, part) for call in calls.found]


class _Children(cst.CSTVisitor):
    """Finds the children of trees."""

    def __init__(self) -> None:
        self.found: list[cst.Call] = []

    def visit_Call(self, node: cst.Call) -> None:  # noqa: N802
        self.found += [node] if method(node) == "skill" else []


def _on_top(
    node: cst.ClassDef,
    skills: Sequence[MigratedSkill],
    code: Callable[[cst.CSTNode], str],
    context: TreeContext,
) -> Callable[[], _MixinMethods]:
    """A translator of methods for the common parameters of some skills."""
    individuals = [
        {key for key, name in each.names.items() if name in each.individuals} for each in skills
    ]
    both = set.intersection(*individuals) if individuals else set()
    names = {key: skills[0].names[key] for key in both}
    shared = MigratedSkill(node.name.value, context.path, names, {*names.values()})
    return lambda: _MixinMethods(shared, code, node, context.states).of(skills)


class _MixinMethods(Methods):
    """The methods of a class with the parameters of several skills."""

    _skills: Sequence[MigratedSkill] = ()

    def of(self, skills: Sequence[MigratedSkill]) -> _MixinMethods:
        """The same methods, for the skills derived from the class."""
        self._skills = skills
        return self

    def name_of(self, key: cst.BaseExpression) -> str:
        """The common name of a parameter in all skills. Raises `LeftError` if a skill has no such
        parameter.
        """
        text = literal_text(key)
        if text is None:
            computed = errors.ComputedArgument(argument="key", call="params", wanted="the text")
            raise LeftError(computed, key)
        lacking = [
            each.name for each in self._skills if text not in each.names or text in each.added
        ]
        if lacking:
            advice = f"declare it in all descriptions that are built on `{self._skill.name}`"
            unknown = implementation_errors.UnknownKey(
                skill=lacking[0] if len(lacking) == 1 else listed(lacking), key=text, advice=advice
            )
            raise LeftError(unknown, key)
        names = {each.names[text] for each in self._skills} or {*parameter_names([text]).values()}
        if len(names) > 1:
            said = f"uses `{text}`, which skills on top of it call {listed(sorted(names))}"
            raise LeftError(
                implementation_errors.OtherBase(implementation=self._skill.name, found=said), key
            )
        return names.pop()
