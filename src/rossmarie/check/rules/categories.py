"""The categories of rules."""

from __future__ import annotations

from dslkit.diagnostics import listed
from rossmarie.check.rules.errors import UnknownCategory
from rossmarie.check.scopes.context import Context
from rossmarie.ir.filing import SUBJECTS, TASKS, Category
from rossmarie.syntax import ast

_SUBJECTS = {each.value: each for each in SUBJECTS}
_TASKS = {each.value.removeprefix("task "): each for each in TASKS}


def check_categories(rule: ast.Rule, context: Context) -> tuple[Category, ...]:
    """The categories of a rule. Unknown categories are reported only once, not for each exemption
    of the rule.
    """
    found = (
        _known(rule, rule.category, "category", _SUBJECTS, context),
        _known(rule, rule.task, "task", _TASKS, context),
    )
    return tuple(each for each in found if each is not None)


def _known(
    rule: ast.Rule,
    word: ast.Name | None,
    said: str,
    known: dict[str, Category],
    context: Context,
) -> Category | None:
    if word is None or word.text in known:
        return None if word is None else known[word.text]
    if rule.made_from is None:
        finding = UnknownCategory(identifier=word.text, said=said, known=listed(tuple(known)))
        context.report_unknown(finding, word, known)
    return None
