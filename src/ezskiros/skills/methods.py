"""The source of implementation methods: their return values and comparisons."""

from __future__ import annotations

import ast
import inspect
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from types import FunctionType

from dslkit.source import SourceFile, Span
from dslkit.source.call_site import node_span, source_file
from ezskiros.skills.implementation import SkillImplementation


@dataclass(frozen=True)
class WrittenMethod:
    """A method in source form."""

    file: SourceFile
    node: ast.FunctionDef

    def returns(self) -> Iterator[ast.Return]:
        """The return statements, without those of inner functions."""
        return _returns(self.node.body)

    def returned(self) -> Iterator[ast.expr | None]:
        """The returned expressions, including both results of `one if condition else other`."""
        for each in self.returns():
            yield from _alternatives(each.value)

    def compared_by_identity(self) -> Iterator[Span]:
        """Comparisons of a parameter, `params.Name`, by `is`."""
        for node in ast.walk(self.node):
            if isinstance(node, ast.Compare) and _is_identity_of_parameter(node):
                yield node_span(self.file, node)

    def ends_with_return(self) -> bool:
        """Say whether every path ends with a return or an exception."""
        return _ends(self.node.body)


def _is_identity_of_parameter(node: ast.Compare) -> bool:
    is_identity = any(isinstance(each, (ast.Is, ast.IsNot)) for each in node.ops)
    sides = (node.left, *node.comparators)
    attributes = (each.value for each in sides if isinstance(each, ast.Attribute))
    names = (each.id for each in attributes if isinstance(each, ast.Name))
    return is_identity and "params" in names


def own_method(implementation: type, name: str) -> FunctionType | None:
    """A method that users wrote."""
    found = inspect.getattr_static(implementation, name, None)
    is_own = isinstance(found, FunctionType) and found is not vars(SkillImplementation).get(name)
    return found if is_own else None


def written(method: FunctionType) -> WrittenMethod | None:
    """A method in source form; None without a source."""
    file = source_file(method.__code__.co_filename)
    node = _functions(file).get(method.__code__.co_firstlineno) if file else None
    return WrittenMethod(file, node) if file and node else None


@lru_cache(maxsize=64)
def _functions(file: SourceFile) -> dict[int, ast.FunctionDef]:
    """The functions of a file by their first lines, including decorators."""
    functions = (
        each for each in ast.walk(ast.parse(file.text)) if isinstance(each, ast.FunctionDef)
    )
    return {
        min([each.lineno, *(above.lineno for above in each.decorator_list)]): each
        for each in functions
    }


@cache
def reported_states(implementation: type) -> frozenset[str] | None:
    """The methods among `success`, `step` and `fail` whose results an `execute` returns; None if
    this is not visible.
    """
    method = own_method(implementation, "execute")
    found = written(method) if method else None
    if found is None:
        return None
    names = {reported_state(each) for each in found.returned()}
    return None if None in names else frozenset(filter(None, names))


def reported_state(value: ast.expr | None) -> str | None:
    """The name of the method in a call such as `self.success(...)`."""
    match value:
        case ast.Call(func=ast.Attribute(value=ast.Name(id="self"), attr=name)):
            return name if name in ("success", "step", "fail") else None
        case _:  # open: any other expression
            return None


def _alternatives(value: ast.expr | None) -> Iterator[ast.expr | None]:
    if isinstance(value, ast.IfExp):
        yield from _alternatives(value.body)
        yield from _alternatives(value.orelse)
    else:
        yield value


def _returns(body: Sequence[ast.stmt]) -> Iterator[ast.Return]:
    for statement in body:
        if isinstance(statement, ast.Return):
            yield statement
        elif not isinstance(statement, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            for part in _blocks(statement):
                yield from _returns(part)


def _blocks(statement: ast.stmt) -> Iterator[list[ast.stmt]]:
    for _, value in ast.iter_fields(statement):
        if isinstance(value, list):
            yield [each for each in value if isinstance(each, ast.stmt)]
            for each in value:
                if isinstance(each, (ast.ExceptHandler, ast.match_case)):
                    yield each.body


def _ends(body: Sequence[ast.stmt]) -> bool:
    """Say whether the end of these statements is never reached."""
    return any(_leaves(statement) for statement in body)


def _leaves(statement: ast.stmt) -> bool:
    """Say whether the code after a statement is never reached."""
    match statement:
        case ast.Return() | ast.Raise():
            return True
        case ast.If(body=body, orelse=other):
            return _ends(body) and _ends(other)
        case ast.With(body=body):
            return _ends(body)
        case ast.While(test=ast.Constant(value=value)) if value:
            return not any(isinstance(each, ast.Break) for each in ast.walk(statement))
        case ast.Try(body=body, handlers=handlers, orelse=other, finalbody=final):
            is_left = _ends([*body, *other]) and all(_ends(each.body) for each in handlers)
            return _ends(final) or is_left
        case ast.Match(cases=cases):
            return _is_exhaustive(cases) and all(_ends(each.body) for each in cases)
        case _:  # open: any other statement
            return False


def _is_exhaustive(cases: Sequence[ast.match_case]) -> bool:
    last = cases[-1]
    return last.guard is None and isinstance(last.pattern, ast.MatchAs) and not last.pattern.pattern
