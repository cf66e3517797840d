"""Elements chosen by the name of a constant: `joints[elbow]` becomes `joints["elbow_joint"]`."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Any

from dslkit.diagnostics import Collector, DidYouMean
from dslkit.source import Span
from rossmarie.check.instances.errors import NoElementName
from rossmarie.check.wording.suggestions import near_name, rename
from rossmarie.syntax import ast, walk
from rossmarie.syntax.walk import expressions


def with_elements(modules: Sequence[ast.Module], collector: Collector) -> list[ast.Module]:
    """The modules, with each constant in an index replaced by its text. A constant that is not a
    string is reported.
    """
    asking = {id(item) for each in modules for item in each.items if _asks(item)}
    if not asking:
        return list(modules)
    items = [item for each in modules for item in each.items if isinstance(item, ast.Constant)]
    lookup = _Lookup({item.name.text: item for item in reversed(items)}, collector)
    return [
        dataclasses.replace(
            each,
            items=tuple(lookup.in_(item) if id(item) in asking else item for item in each.items),
        )
        for each in modules
    ]


def _asks(item: ast.Item) -> bool:
    parts = (part for each in expressions(item) for part in walk(each))
    return any(isinstance(part, ast.Index) and part.constant is not None for part in parts)


class _Lookup:
    def __init__(self, constants: Mapping[str, ast.Constant], collector: Collector) -> None:
        self._constants = constants
        self._collector = collector

    def in_(self, value: Any) -> Any:
        """A node with everything inside it. The recursion follows the tree, whose depth the syntax
        limits.
        """
        if isinstance(value, tuple):
            return tuple([self.in_(each) for each in value])
        if not dataclasses.is_dataclass(value) or isinstance(value, type | Span):
            return value
        parts = {
            each.name: self.in_(getattr(value, each.name)) for each in dataclasses.fields(value)
        }
        if isinstance(value, ast.Index) and value.constant is not None:
            text = self._text(value.constant)
            return ast.Broken(value.span) if text is None else ast.Index(**{**parts, "index": text})
        return type(value)(**parts)

    def _text(self, name: ast.Name) -> str | None:
        """The text of a constant; None after reporting that it is not a text."""
        seen: set[str] = set()
        at = name.text
        while at in self._constants and at not in seen:
            seen.add(at)
            value = _inside(self._constants[at].value)
            if isinstance(value, ast.Text):
                return value.value
            if not isinstance(value, ast.Reference):
                break
            at = value.name.text
        if not any(_is_reported(self._constants[each]) for each in seen):
            self._report(name)
        return None

    def _report(self, name: ast.Name) -> None:
        text = name.text
        reason, advice = "no constant has this name", f'declare `const {text} = "NAME";`'
        if text in self._constants:
            reason, advice = "this constant is not a string", "take another constant"
        finding = NoElementName(identifier=text, reason=reason, advice=advice)
        strings = [each for each, it in self._constants.items() if isinstance(it.value, ast.Text)]
        near = near_name(text, strings)
        if near is None:
            self._collector.add(finding.at(name.span))
        else:
            help = DidYouMean(near=near)
            self._collector.add(finding.at(name.span, help=help, fix=rename(name, near)))


def _inside(value: ast.Expression) -> ast.Expression:
    while isinstance(value, ast.Parenthesized):
        value = value.inner
    return value


def _is_reported(constant: ast.Constant) -> bool:
    """Say whether another finding reports the value: it is not a value, or not the string that a
    parameter requires.
    """
    default = None if constant.parameter is None else constant.parameter.default
    return isinstance(constant.value, ast.Broken) or isinstance(default, ast.Text)
