"""The classes of a module, and their replacements."""

from __future__ import annotations

from collections.abc import Mapping

import libcst as cst

from ezskiros.migrate.calls import method

OLD_DESCRIPTION = "createDescription"
"""The method in which SkiROS2 classes describe a skill or name the skill that they implement."""


def describing_method(node: cst.ClassDef) -> cst.FunctionDef | None:
    """The method `createDescription` of a class."""
    for part in node.body.body:
        if isinstance(part, cst.FunctionDef) and part.name.value == OLD_DESCRIPTION:
            return part
    return None


class _Classes(cst.CSTVisitor):
    def __init__(self) -> None:
        self.found: list[cst.ClassDef] = []

    def visit_ClassDef(self, node: cst.ClassDef) -> bool:  # noqa: N802
        self.found.append(node)
        return describing_method(node) is None


def classes_of(module: cst.Module) -> list[cst.ClassDef]:
    """All classes, including those inside classes without a description."""
    visitor = _Classes()
    module.visit(visitor)
    return visitor.found


class _Calls(cst.CSTVisitor):
    def __init__(self) -> None:
        self.found: set[str] = set()

    def visit_Call(self, node: cst.Call) -> None:  # noqa: N802
        self.found.add(method(node) or "")


def self_calls(function: cst.FunctionDef) -> set[str]:
    """The methods of its own class that a method calls."""
    visitor = _Calls()
    function.visit(visitor)
    return visitor.found


class _Replacer(cst.CSTTransformer):
    def __init__(self, changed: Mapping[int, cst.ClassDef]) -> None:
        self._changed = changed

    def leave_ClassDef(  # noqa: N802
        self, original_node: cst.ClassDef, updated_node: cst.ClassDef
    ) -> cst.ClassDef:
        return self._changed.get(id(original_node), updated_node)


def with_classes(module: cst.Module, changed: Mapping[int, cst.ClassDef]) -> cst.Module:
    """The module with new classes, by the identities of the old classes."""
    found = module.visit(_Replacer(changed))
    assert isinstance(found, cst.Module)
    return found
