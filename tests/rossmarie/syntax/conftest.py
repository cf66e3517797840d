"""Common functions of the parser tests: parse a text, and show a tree without its spans."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any

import pytest

from dslkit.diagnostics import Collector, Diagnostic
from dslkit.source import SourceFile, Span
from rossmarie.syntax import ast, parse

Parsed = tuple[ast.Module, tuple[Diagnostic, ...]]


def parse_text(text: str) -> Parsed:
    collector = Collector()
    module = parse(SourceFile("rules.ross", text), collector)
    return module, collector.sorted()


def bare(node: Any) -> Any:
    """A tree as nested tuples, without spans: equal for texts that mean the same."""
    if isinstance(node, tuple):
        return tuple(bare(part) for part in node)
    if isinstance(node, Span) or not dataclasses.is_dataclass(node):
        return None if isinstance(node, Span) else node
    values = (getattr(node, field.name) for field in dataclasses.fields(node))
    return (type(node).__name__, *(bare(value) for value in values))


@pytest.fixture(scope="session")
def parsed() -> Callable[[str], Parsed]:
    """Parses a text; gives the module and the findings."""
    return parse_text


@pytest.fixture(scope="session")
def accepted() -> Callable[[str], ast.Module]:
    """Parses a text that has to be without findings."""

    def parse_without_findings(text: str) -> ast.Module:
        module, found = parse_text(text)
        assert [f"{one.code} {one.primary.span}: {one.title}" for one in found] == []
        return module

    return parse_without_findings


@pytest.fixture(scope="session")
def without_spans() -> Callable[[ast.Module], Any]:
    """The items of a module as nested tuples without spans."""
    return lambda module: bare(module.items)
