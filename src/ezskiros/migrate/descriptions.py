"""The description classes of a file, and their replacements."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field

import libcst as cst

from dslkit.diagnostics import Template
from ezskiros.migrate import errors
from ezskiros.migrate.calls import last_name
from ezskiros.migrate.classes import describing_method, self_calls
from ezskiros.migrate.comments import marked, without_marks
from ezskiros.migrate.description import Translation, UntranslatedPart
from ezskiros.migrate.imports import imported
from ezskiros.migrate.names import FileNames
from ezskiros.migrate.skills import MigratedSkill, skill_of
from ezskiros.migrate.steps import statements_of


@dataclass
class Description:
    """A class that describes a skill, with the node of the class."""

    node: cst.ClassDef
    method: cst.FunctionDef
    names: FileNames = field(default_factory=FileNames)
    translation: Translation = field(default_factory=Translation)

    @property
    def name(self) -> str:
        """The name of the skill."""
        return self.node.name.value

    @property
    def findings(self) -> list[UntranslatedPart]:
        """The findings that prevent the translation; empty if there are none."""
        return self.translation.findings

    def skill(self, path: str) -> MigratedSkill:
        """The facts about the skill that implementations use."""
        if self.findings:
            codes = [each.template.code for each in self.findings]
            return MigratedSkill(self.name, path, left_for=codes)
        return skill_of(self.name, path, self.translation.parameters)

    def leave(self, template: Template, node: cst.CSTNode) -> None:
        """Keep the whole class unchanged."""
        self.translation.findings.append(UntranslatedPart(template, node, self.node))


class Descriptions:
    """Finds the descriptions of a module, and writes the classes that replace them.

    Descriptions in `inherited` stay unchanged, because classes elsewhere are derived from them.
    """

    def __init__(self, module: cst.Module, inherited: Collection[str]) -> None:
        self._module, self._inherited = module, inherited
        self._aliases = {
            name for name, what in imported(module, "skiros2").items() if what == "SkillDescription"
        }

    def of(self, classes: Sequence[cst.ClassDef]) -> list[Description]:
        """The descriptions among some classes."""
        return [each for node in classes if (each := self._description(node))]

    def _description(self, node: cst.ClassDef) -> Description | None:
        function = describing_method(node)
        if function is None:
            return None
        calls = self_calls(function)
        if "setDescription" in calls:
            return None
        is_one = any(self._is_base(each) for each in node.bases)
        is_one = is_one or any(each.startswith("add") for each in calls)
        return Description(node, function) if is_one else None

    def _is_base(self, argument: cst.Arg) -> bool:
        """Say whether a base is SkiROS2's own class of descriptions."""
        name = last_name(argument.value)
        return name == "SkillDescription" or name in self._aliases

    # --- derived descriptions ---------------------------------------------------------------------

    def leave_related(self, found: Sequence[Description]) -> None:
        """Keep descriptions unchanged that inherit from others, and their base descriptions."""
        by_name = {each.name: each for each in found}
        for each in found:
            for base, node in self._bases(each):
                _derived(each, f"inherits from `{base}`", node)
                if base in by_name:
                    below = by_name[base]
                    _derived(below, f"is the base of `{each.name}`", below.node.name)
            if each.name in self._inherited:
                _derived(each, "is the base of a description elsewhere", each.node.name)

    def _bases(self, each: Description) -> Iterator[tuple[str, cst.BaseExpression]]:
        """The base classes of a description, besides SkiROS2's own."""
        for argument in each.node.bases:
            name = last_name(argument.value)
            if not self._is_base(argument) and name != "object":
                yield name or "another class", argument.value

    # --- new classes ------------------------------------------------------------------------------

    def new_class(self, each: Description, base: str) -> cst.ClassDef:
        """The class derived from `base`; for an unchanged description the old class, with marks."""
        if each.findings:
            return _marked(each)
        newline = self._module.default_newline
        text = newline.join([*each.translation.lines, ""])
        new = cst.parse_statement(text, config=self._module.config_for_parsing)
        assert isinstance(new, cst.FunctionDef)
        lines = without_marks(each.method.leading_lines)
        new = new.with_changes(leading_lines=lines)
        body = [new if part is each.method else part for part in each.node.body.body]
        bases = [
            argument.with_changes(value=cst.parse_expression(base))
            if self._is_base(argument)
            else argument
            for argument in each.node.bases
        ]
        return each.node.with_changes(
            body=each.node.body.with_changes(body=body),
            bases=bases,
            leading_lines=without_marks(each.node.leading_lines),
        )


def _derived(each: Description, said: str, node: cst.CSTNode) -> None:
    each.leave(errors.DerivedDescription(skill=each.name, found=said), node)


def _marked(each: Description) -> cst.ClassDef:
    """The old class, with a comment above each part that has no translation."""
    templates: dict[int, list[Template]] = {}
    for finding in each.findings:
        templates.setdefault(id(finding.statement), []).append(finding.template)
    inside = isinstance(each.method.body, cst.IndentedBlock)
    statements = statements_of(each.method)
    above = list(templates.get(id(each.method), ()))
    if inside:
        body = [
            part.with_changes(
                leading_lines=marked(part.leading_lines, templates.get(id(part), ()))  # type: ignore[attr-defined]
            )
            for part in statements
        ]
        block = each.method.body.with_changes(body=body)
    else:
        block = each.method.body
        above += [t for part in statements for t in templates.get(id(part), ())]
    new = each.method.with_changes(
        body=block, leading_lines=marked(each.method.leading_lines, above)
    )
    parts = [new if part is each.method else part for part in each.node.body.body]
    return each.node.with_changes(
        body=each.node.body.with_changes(body=parts),
        leading_lines=marked(each.node.leading_lines, templates.get(id(each.node), ())),
    )
