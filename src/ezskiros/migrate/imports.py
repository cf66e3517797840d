"""Imports: removal of unused SkiROS2 imports, and addition of EzSkiROS imports."""

from __future__ import annotations

import keyword
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import libcst as cst
from libcst.helpers import get_full_name_for_node

from ezskiros.migrate.calls import CONDITION_CLASSES
from ezskiros.migrate.processors import NAMES as PROCESSORS

OLD_API = frozenset(
    {"SkillDescription", "ParamTypes", "ParamOptions", "Element", *CONDITION_CLASSES}
)
"""The SkiROS2 names that descriptions import."""
_IMPLEMENTING = frozenset({"SkillBase", "PrimitiveBase", "State", *PROCESSORS})
"""The SkiROS2 names that only implementations import."""
_OLD_MODULES = frozenset(
    {"params", "world_element", "conditions", "abstract_skill", "skill", "primitive", "processors"}
)
_LENGTH = 88

Line: TypeAlias = cst.SimpleStatementLine | cst.BaseCompoundStatement


class _Used(cst.CSTVisitor):
    """The names that a module uses outside its imports, including those of `__all__`."""

    def __init__(self) -> None:
        self.found: set[str] = set()

    def visit_Import(self, node: cst.Import) -> bool:  # noqa: N802, ARG002
        return False

    def visit_ImportFrom(self, node: cst.ImportFrom) -> bool:  # noqa: N802, ARG002
        return False

    def visit_Attribute(self, node: cst.Attribute) -> bool:  # noqa: N802
        node.value.visit(self)
        return False

    def visit_Arg(self, node: cst.Arg) -> bool:  # noqa: N802
        node.value.visit(self)
        return False

    def visit_Name(self, node: cst.Name) -> None:  # noqa: N802
        self.found.add(node.value)

    def visit_Assign(self, node: cst.Assign) -> None:  # noqa: N802
        targets = {get_full_name_for_node(each.target) for each in node.targets}
        if "__all__" in targets and isinstance(node.value, (cst.List, cst.Tuple)):
            values = [each.value for each in node.value.elements]
            strings = [each for each in values if isinstance(each, cst.SimpleString)]
            self.found |= {str(each.evaluated_value) for each in strings}


def used_names(module: cst.CSTNode) -> set[str]:
    """The names that a module, or a part of it, uses outside its imports."""
    visitor = _Used()
    module.visit(visitor)
    return visitor.found


def imported(module: cst.Module, source: str) -> dict[str, str]:
    """The original names of all imports from `source` or its modules, by their local names."""
    found: dict[str, str] = {}
    for node in _imports(module):
        if isinstance(node, cst.ImportFrom) and not isinstance(node.names, cst.ImportStar):
            name = module_name(node)
            if name == source or name.startswith((f"{source}.", f"{source}_")):
                found |= {_bound(each): each.evaluated_name for each in node.names}
    return found


def imported_names(module: cst.Module) -> dict[str, str]:
    """The original names of all imports, by their local names."""
    return {
        _bound(each): each.evaluated_name
        for node in _imports(module)
        if isinstance(node, cst.ImportFrom) and not isinstance(node.names, cst.ImportStar)
        for each in node.names
    }


def sources(module: cst.Module) -> set[str]:
    """The modules that a module imports, or from which it imports names."""
    found = set()
    for node in _imports(module):
        source = module_name(node) if isinstance(node, cst.ImportFrom) else ""
        found |= {source} if source else set()
        for each in () if isinstance(node.names, cst.ImportStar) else node.names:
            inner = source if source.endswith(".") or not source else f"{source}."
            found.add(inner + each.evaluated_name)
    return found


def bound_names(module: cst.Module, without: Sequence[str]) -> set[str]:
    """The names that imports bind, except imports from some modules."""
    found = set()
    for node in _imports(module):
        if isinstance(node.names, cst.ImportStar):
            continue
        for each in node.names:
            name = module_name(node) if isinstance(node, cst.ImportFrom) else each.evaluated_name
            found |= set() if name.startswith(tuple(without)) else {_bound(each)}
    return found


def has_star(module: cst.Module, source: str) -> bool:
    """Say whether a module has an `import *` from a module of some package."""
    return any(
        isinstance(node.names, cst.ImportStar) and module_name(node).startswith(source)
        for node in _imports(module)
        if isinstance(node, cst.ImportFrom)
    )


def module_name(node: cst.ImportFrom) -> str:
    """The module of an import, such as `.world` of `from .world import cora`."""
    name = get_full_name_for_node(node.module) if node.module else ""
    return "." * len(node.relative) + (name or "")


def _imports(module: cst.Module) -> list[cst.Import | cst.ImportFrom]:
    """The imports at the top level."""
    lines = (each for each in module.body if isinstance(each, cst.SimpleStatementLine))
    return [
        small
        for line in lines
        for small in line.body
        if isinstance(small, (cst.Import, cst.ImportFrom))
    ]


def _bound(alias: cst.ImportAlias) -> str:
    """The name that an import binds."""
    return alias.evaluated_alias or alias.evaluated_name.partition(".")[0]


@dataclass(frozen=True)
class WantedNames:
    """Names to import from one module, with their local names."""

    source: str
    names: Mapping[str, str]

    def text(self) -> list[str]:
        """The import statement, over several lines if it is long."""
        if not self.names:
            return [f"import {self.source}"]
        parts = [
            name if name == spelled else f"{name} as {spelled}"
            for name, spelled in sorted(self.names.items(), key=lambda item: _order(item[0]))
        ]
        one = f"from {self.source} import {', '.join(parts)}"
        if len(one) <= _LENGTH:
            return [one]
        return [f"from {self.source} import (", *(f"    {part}," for part in parts), ")"]


def _order(name: str) -> tuple[int, str]:
    """A sort key: constants, then classes, then functions, as in isort."""
    return (0 if name.isupper() else 1 if name[:1].isupper() else 2, name)


def with_imports(
    module: cst.Module, wanted: Sequence[WantedNames], before: Collection[str]
) -> cst.Module:
    """A module with other imports, without unused imports of SkiROS2's API.

    If no names of a module are wanted, the module itself is imported. `before` are the names that
    the module used before.
    """
    new_names = {name for each in wanted for name in each.names.values()}
    # The former meanings of these names are no longer needed.
    cleaner = _Cleaner(used_names(module) - new_names, before)
    body: list[Line] = []
    above: Sequence[cst.EmptyLine] = ()
    place: int | None = None
    for statement in module.body:
        kept = cleaner.line(statement)
        if kept is not statement and place is None:
            place = len(body) + (kept is not None)
            above = _above(statement) if kept is None else ()
        elif kept is None:
            above = [*above, *(line for line in _above(statement) if line.comment)]
        body += [kept] if kept is not None else []
    place = max(_after_imports(body) if place is None else place, _after_stars(body))
    texts = [text for each in wanted for text in _merged(each, body)]
    codes = [module.default_newline.join([*text, ""]) for text in texts]
    new = [cst.parse_statement(code, config=module.config_for_parsing) for code in codes]
    body[place:place] = new
    if above and place < len(body):
        lines = [*above, *_above(body[place])]
        body[place] = body[place].with_changes(leading_lines=lines)
    return module.with_changes(body=body)


def _above(statement: cst.CSTNode) -> Sequence[cst.EmptyLine]:
    """The lines above a statement."""
    lines: Sequence[cst.EmptyLine] = getattr(statement, "leading_lines", ())
    return lines


@dataclass(frozen=True)
class _Cleaner:
    """Removes imports of SkiROS2's API that are not in `used`, but were in `before`."""

    used: Collection[str]
    before: Collection[str]

    def line(self, statement: Line) -> Line | None:
        """A line without the removed names; None if the line becomes empty."""
        if not isinstance(statement, cst.SimpleStatementLine):
            return statement
        cleaned = [self._statement(small) for small in statement.body]
        left = [each for each in cleaned if each is not None]
        if all(new is old for new, old in zip(cleaned, statement.body, strict=True)):
            return statement
        return statement.with_changes(body=left) if left else None

    def _statement(self, node: cst.BaseSmallStatement) -> cst.BaseSmallStatement | None:
        if not isinstance(node, (cst.Import, cst.ImportFrom)):
            return node
        if isinstance(node.names, cst.ImportStar):
            return node
        kept = [each for each in node.names if not self._is_obsolete(node, each)]
        if len(kept) == len(node.names):
            return node
        if kept and not (isinstance(node, cst.ImportFrom) and node.lpar):
            kept[-1] = kept[-1].with_changes(comma=cst.MaybeSentinel.DEFAULT)
        return node.with_changes(names=kept) if kept else None

    def _is_obsolete(self, node: cst.Import | cst.ImportFrom, alias: cst.ImportAlias) -> bool:
        is_from = isinstance(node, cst.ImportFrom)
        source = module_name(node) if isinstance(node, cst.ImportFrom) else alias.evaluated_name
        name = _bound(alias)
        if not source.startswith("skiros2") or name in self.used:
            return False
        if is_from and alias.evaluated_name in OLD_API:
            return True
        if is_from and alias.evaluated_name in _IMPLEMENTING:
            return name in self.before
        is_module = alias.evaluated_name.rpartition(".")[2] in _OLD_MODULES
        return is_module and name in self.before and (is_from or alias.asname is not None)


def _merged(wanted: WantedNames, body: list[Line]) -> list[list[str]]:
    """The import as new lines; no lines if an existing import can take the names."""
    if not wanted.names:
        return [] if _has_import(body, wanted.source) else [wanted.text()]
    for number, line in enumerate(body):
        have = _imported_by(line, wanted.source)
        if have is not None:
            text = "\n".join(WantedNames(wanted.source, {**have, **wanted.names}).text())
            new = cst.parse_statement(text)
            assert isinstance(new, cst.SimpleStatementLine)
            body[number] = line.with_changes(body=new.body)
            return []
    return [wanted.text()]


def _imported_by(line: Line, source: str) -> dict[str, str] | None:
    """The names that a line imports from a module; None for other or more complex lines."""
    match line:
        case cst.SimpleStatementLine(body=[cst.ImportFrom(lpar=None) as small]):
            if module_name(small) == source and not isinstance(small.names, cst.ImportStar):
                return {each.evaluated_name: _bound(each) for each in small.names}
        case _:  # open: any other line
            pass
    return None


def _has_import(body: Sequence[Line], name: str) -> bool:
    return any(
        each.evaluated_name == name and each.asname is None
        for node in _imports(cst.Module(body=list(body)))
        if isinstance(node, cst.Import)
        for each in node.names
    )


def _after_imports(body: Sequence[Line]) -> int:
    """The position after the imports at the top, otherwise after the docstring."""
    places = [number for number, each in enumerate(body) if _is_import(each)]
    if places:
        return places[-1] + 1
    is_text = bool(body) and cst.Module(body=list(body)).get_docstring() is not None
    return 1 if is_text else 0


def _after_stars(body: Sequence[Line]) -> int:
    """The position after the last `import *`, which would hide earlier names."""
    places = [
        number
        for number, line in enumerate(body)
        if isinstance(line, cst.SimpleStatementLine)
        for small in line.body
        if isinstance(small, cst.ImportFrom) and isinstance(small.names, cst.ImportStar)
    ]
    return places[-1] + 1 if places else 0


def _is_import(statement: cst.CSTNode) -> bool:
    return isinstance(statement, cst.SimpleStatementLine) and any(
        isinstance(small, (cst.Import, cst.ImportFrom)) for small in statement.body
    )


def is_module(text: str) -> bool:
    """Say whether a text is valid after `from`: `world`, `.world`, `skills.world`."""
    name = text.lstrip(".")
    parts = name.split(".") if name else []
    is_fine = all(part.isidentifier() and not keyword.iskeyword(part) for part in parts)
    return is_fine and bool(text)
