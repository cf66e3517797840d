"""Translation of the method `modifyDescription` to the method `conditions`: the pre-conditions of a
single implementation.
"""

from __future__ import annotations

from collections.abc import Callable

import libcst as cst

from ezskiros.migrate import implementation_errors
from ezskiros.migrate.calls import Arguments, last_name, method
from ezskiros.migrate.comments import inner_comments, texts, without_marks
from ezskiros.migrate.conditions import ConditionReader
from ezskiros.migrate.description import UntranslatedPart
from ezskiros.migrate.docstrings import docstring_of
from ezskiros.migrate.errors import LeftError
from ezskiros.migrate.names import FileNames
from ezskiros.migrate.skills import MigratedSkill
from ezskiros.migrate.steps import DescriptionStatement, statements_of, steps_of
from ezskiros.migrate.values import KnownValues
from ezskiros.skills.markers import ParameterKind

OLD, NEW = "modifyDescription", "conditions"


def translate_own(
    function: cst.FunctionDef,
    skill: MigratedSkill,
    names: FileNames,
    known: KnownValues,
    code: Callable[[cst.CSTNode], str],
) -> tuple[cst.FunctionDef | None, list[UntranslatedPart]]:
    """The new method, None if it would be empty, and the findings.

    The used names are added to `names`.
    """
    return _Method(function, skill, names, known, code).translated()


class _Method:
    def __init__(
        self,
        function: cst.FunctionDef,
        skill: MigratedSkill,
        names: FileNames,
        known: KnownValues,
        code: Callable[[cst.CSTNode], str],
    ) -> None:
        self._function, self._code = function, code
        individuals = {key: name for key, name in skill.names.items() if name in skill.individuals}
        others = {key: name for key, name in skill.names.items() if key not in individuals}
        names.hidden = {*skill.names.values()}
        self._reader = ConditionReader(names, known, code, individuals, others)
        self._argument = ""
        self._lines: list[str] = []
        self._findings: list[UntranslatedPart] = []

    def translated(self) -> tuple[cst.FunctionDef | None, list[UntranslatedPart]]:
        plain = self._function.params.params
        if len(plain) != 2 or self._function.decorators:
            self._leave(self._function.name, self._function)
            return None, self._findings
        self._argument = plain[1].name.value
        for step in steps_of(statements_of(self._function), self._function):
            self._try(step)
        self._lines += texts(getattr(self._function.body, "footer", ()))
        if self._findings or not any("+=" in each for each in self._lines):
            return None, self._findings
        return self._written(), []

    def _try(self, step: DescriptionStatement) -> None:
        """Translate one statement, or add the finding."""
        try:
            self._read(step)
        except LeftError as left:
            self._findings.append(UntranslatedPart(left.template, left.node, step.statement))

    def _leave(self, node: cst.CSTNode, statement: cst.CSTNode) -> None:
        bare = node.with_changes(leading_lines=()) if hasattr(node, "leading_lines") else node
        first = self._code(bare).strip().partition("\n")[0]
        shown = f"`def {first}`" if node is self._function.name else f"`{first}`"
        found = implementation_errors.OtherDescription(found=shown)
        self._findings.append(UntranslatedPart(found, node, statement))

    def _read(self, step: DescriptionStatement) -> None:
        """Translate one statement. Raises `LeftError` if a condition has no translation."""
        doc = docstring_of(step.statement)
        call = step.call
        if call is not None and method(call, self._argument) == "addPreCondition":
            found = self._reader.read(Arguments(call, "addPreCondition")["condition"])
            said = f"# {'; '.join(found.labels)}" if found.labels else ""
            comments = [*step.above, *inner_comments(step.node)]
            line = f"self.pre_conditions += {found.text}"
            self._lines += [*comments, "  ".join(filter(None, [line, step.behind or said]))]
        elif doc is not None:
            self._lines += [*step.above, self._code(doc)]
        elif isinstance(step.node, cst.Pass) or self._is_declared(call):
            self._lines += [*step.above, *([step.behind] if step.behind else [])]
        else:
            self._leave(step.node, step.statement)

    def _is_declared(self, call: cst.Call | None) -> bool:
        """Say whether a call adds an optional parameter. The sharing children declare such a
        parameter in the description.
        """
        if call is None or method(call, self._argument) != "addParam":
            return False
        kind = Arguments(call, "addParam").get("param_type")
        return kind is not None and last_name(kind) == ParameterKind.OPTIONAL.name.capitalize()

    def _written(self) -> cst.FunctionDef:
        names = ["self", *sorted(self._reader.mentioned)]
        lines = [f"def {NEW}({', '.join(names)}):"]
        lines += [f"    {each}" for each in self._lines]
        written = cst.parse_statement("\n".join(lines) + "\n")
        assert isinstance(written, cst.FunctionDef)
        leading = without_marks(self._function.leading_lines)
        return written.with_changes(leading_lines=leading)
