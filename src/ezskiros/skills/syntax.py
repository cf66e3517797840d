"""The places of the parts of a function in its source: parameters, types, defaults and
docstrings.
"""

from __future__ import annotations

import ast
import inspect
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from types import FunctionType

from dslkit.source import SourceFile, Span
from dslkit.source.call_site import line_span, node_span, source_file


@dataclass
class FunctionSource:
    """A function in source form. Without a source, all spans are `whole`."""

    whole: Span
    names: dict[str, Span] = field(default_factory=dict)
    annotations: dict[str, Span] = field(default_factory=dict)
    defaults: dict[str, Span] = field(default_factory=dict)
    docs: dict[str, str] = field(default_factory=dict)

    def name_of(self, parameter: str) -> Span:
        """The place of a parameter's name."""
        return self.names.get(parameter, self.whole)


def definition(function: FunctionType) -> FunctionSource:
    """The parts of a function."""
    code = function.__code__
    file = source_file(code.co_filename)
    if file is None:
        return FunctionSource(Span(SourceFile(code.co_filename, ""), 0, 0))
    line, arguments = _written(file).functions.get(code.co_firstlineno, (None, None))
    whole = line_span(file, line or code.co_firstlineno)
    found = FunctionSource(whole, docs=docs_of(inspect.getdoc(function) or ""))
    if arguments is not None:
        _fill(found, file, arguments)
    return found


def class_span(found: type) -> Span:
    """The place of a class name; the beginning of its module if the name is not found."""
    path = file_of(found)
    file = source_file(path)
    if file is None:
        return Span(SourceFile(path, ""), 0, 0)
    return _written(file).classes.get(found.__name__, Span(file, 0, 0))


def class_body(found: type) -> Span:
    """The span of a whole class; of its module if the class is not found."""
    path = file_of(found)
    file = source_file(path) or SourceFile(path, "")
    for node in ast.walk(_tree_of(file)):
        if isinstance(node, ast.ClassDef) and node.name == found.__name__:
            return node_span(file, node)
    return Span(file, 0, len(file.text))


def file_of(found: type) -> str:
    """The file that defines a class. Another module may have the name of its module by now."""
    for each in vars(found).values():
        if isinstance(each, FunctionType) and each.__module__ == found.__module__:
            return each.__code__.co_filename
    return getattr(sys.modules.get(found.__module__), "__file__", None) or "<no source>"


def classes_of(file: SourceFile) -> list[tuple[str, Span]]:
    """The names of the classes that a file defines, in order, without nested classes."""
    return _written(file).outer_classes


@dataclass
class _Written:
    """The definitions of a file. The rest of its syntax tree is large and not kept."""

    classes: dict[str, Span] = field(default_factory=dict)
    """The place of the first definition of each class."""
    outer_classes: list[tuple[str, Span]] = field(default_factory=list)
    attributes: dict[str, frozenset[str]] = field(default_factory=dict)
    """All attribute names in each class, by class name."""
    parameters_set: dict[str, frozenset[str]] = field(default_factory=dict)
    """The parameters that each class sets, by class name."""
    parameters_used: dict[str, list[tuple[str, Span]]] = field(default_factory=dict)
    """The parameters that methods read or set, with their places, by class name."""
    functions: dict[int, tuple[int, ast.arguments]] = field(default_factory=dict)
    """The line of `def` and the parameters, by the first line with decorators."""


@lru_cache(maxsize=4096)
def _written(file: SourceFile) -> _Written:
    found = _Written()
    tree = _tree_of(file)
    outer = set(tree.body)
    work: list[ast.AST] = [tree]
    while work:
        node = work.pop()
        if isinstance(node, ast.ClassDef):
            start = node_span(file, node).start + len("class ")
            span = Span(file, start, start + len(node.name))
            found.classes.setdefault(node.name, span)
            dotted = [each for each in ast.walk(node) if isinstance(each, ast.Attribute)]
            found.attributes[node.name] = frozenset(each.attr for each in dotted)
            found.parameters_set[node.name] = frozenset(_parameters_set(node))
            used = list(_parameters_used(file, node))
            found.parameters_used.setdefault(node.name, used)
            if node in outer:
                found.outer_classes.append((node.name, span))
        elif isinstance(node, ast.FunctionDef):
            first = min([node.lineno, *(each.lineno for each in node.decorator_list)])
            found.functions[first] = (node.lineno, node.args)
        for part in ("body", "orelse", "finalbody", "handlers"):
            inside = getattr(node, part, ())
            work += reversed(inside) if isinstance(inside, list) else ()
    return found


def _classes_behind(owner: type) -> Iterator[tuple[_Written, str]]:
    """A users' class and its base classes: the definitions of their files, and their names
    there.
    """
    for each in owner.__mro__:
        is_ours = each.__module__.partition(".")[0] in ("builtins", "ezskiros")
        file = None if is_ours else source_file(file_of(each))
        if file is not None:
            yield _written(file), each.__name__


def attributes_in(owner: type) -> frozenset[str]:
    """All attribute names in a users' class or in its bases."""
    found = (each.attributes.get(name, ()) for each, name in _classes_behind(owner))
    return frozenset[str]().union(*found)


def set_in(owner: type) -> frozenset[str]:
    """The parameters that a users' class or one of its bases sets, such as `self.params.Force =
    3.5`. For an individual, this includes `self.wmi.add_element(self.params.Pose)`, which adds it
    to the world in SkiROS2.
    """
    found = (each.parameters_set.get(name, ()) for each, name in _classes_behind(owner))
    return frozenset[str]().union(*found)


def used_in(owner: type) -> list[tuple[str, Span]]:
    """The parameters that the methods of a users' class and of its bases use, such as
    `self.params.Force`, with their places. The parameters in `expandBT` are left out.
    """
    found = (each.parameters_used.get(name, []) for each, name in _classes_behind(owner))
    return [use for uses in found for use in uses]


def _parameters_used(file: SourceFile, owner: ast.ClassDef) -> Iterator[tuple[str, Span]]:
    for method in owner.body:
        if isinstance(method, ast.FunctionDef) and method.name != "expandBT":
            for each in ast.walk(method):
                match each:
                    case ast.Attribute(
                        value=ast.Attribute(value=ast.Name(id="self"), attr="params"), attr=name
                    ):
                        yield name, node_span(file, each)
                    case _:  # open: any other node
                        pass


def _parameters_set(owner: ast.ClassDef) -> Iterator[str]:
    for each in ast.walk(owner):
        if isinstance(each, ast.Attribute) and isinstance(each.ctx, ast.Store):
            yield from filter(None, [_parameter(each)])
        elif isinstance(each, ast.FunctionDef):
            yield from _individuals_added(each)


def _individuals_added(method: ast.FunctionDef) -> Iterator[str]:
    """The parameters whose individuals a method adds to the world model, under any variable name:
    `pose = self.params.Pose`.
    """
    called: dict[str, str | None] = {}
    added: list[ast.expr] = []
    for each in ast.walk(method):
        match each:
            case ast.Assign(targets=[ast.Name(id=name)], value=value):
                called[name] = _parameter(value)
            case ast.Call(
                func=ast.Attribute(
                    value=ast.Attribute(attr="wmi" | "_wmi"), attr="add_element" | "add_elements"
                ),
                args=[given, *_],
            ):
                added += given.elts if isinstance(given, ast.List) else [given]
            case _:  # open: any other node
                pass
    for individual in added:
        parameter = (
            called.get(individual.id)
            if isinstance(individual, ast.Name)
            else _parameter(individual)
        )
        if parameter is not None:
            yield parameter


def _parameter(node: ast.expr) -> str | None:
    """The name of the parameter in an expression such as `self.params.Force`."""
    match node:
        case ast.Attribute(value=ast.Attribute(attr="params"), attr=name):
            return name
        case _:  # open: any other expression
            return None


def names_in(span: Span) -> dict[str, Span]:
    """The names in an expression, each with its last place."""
    found = {}
    for node in ast.walk(_expression(span)):
        if isinstance(node, ast.Name):
            found[node.id] = _inside(span, node)
    return found


def compared_value(span: Span) -> Span | None:
    """The right side of a comparison; None for other expressions."""
    for node in ast.walk(_expression(span)):
        if isinstance(node, ast.Compare):
            return _inside(span, node.comparators[-1])
    return None


def added_value(span: Span) -> Span:
    """The place of the added value in a `+=` statement; the whole span for other statements."""
    try:
        body = ast.parse(span.text).body
    except (SyntaxError, ValueError):
        return span
    if len(body) != 1 or not isinstance(body[0], ast.AugAssign):
        return span
    inner = node_span(SourceFile("", span.text), body[0].value)
    return Span(span.file, span.start + inner.start, span.start + inner.end)


def _expression(span: Span) -> ast.AST:
    """The syntax tree of an expression, as if the expression began its file; an empty tree for
    invalid text.
    """
    try:
        return ast.parse(f"({span.text})", mode="eval")
    except (SyntaxError, ValueError):
        return ast.Module([], [])


def _inside(span: Span, node: ast.AST) -> Span:
    """The place of a node of `_expression`."""
    inner = node_span(SourceFile("", f"({span.text})"), node)
    return Span(span.file, span.start + inner.start - 1, span.start + inner.end - 1)


def _tree_of(file: SourceFile) -> ast.Module:
    """The syntax tree of a file; an empty tree if the text is not valid Python."""
    try:
        return ast.parse(file.text)
    except (SyntaxError, ValueError):
        return ast.Module([], [])


def _fill(found: FunctionSource, file: SourceFile, written: ast.arguments) -> None:
    plain = [*written.posonlyargs, *written.args]
    packed = [each for each in (written.vararg, written.kwarg) if each]
    for each in (*plain, *written.kwonlyargs, *packed):
        name = node_span(file, each)
        found.names[each.arg] = Span(file, name.start, name.start + len(each.arg))
        if each.annotation:
            found.annotations[each.arg] = node_span(file, each.annotation)
    last = plain[len(plain) - len(written.defaults) :]
    pairs = [*zip(last, written.defaults, strict=True)]
    pairs += [
        (each, default)
        for each, default in zip(written.kwonlyargs, written.kw_defaults, strict=True)
        if default
    ]
    for each, default in pairs:
        found.defaults[each.arg] = node_span(file, default)


def docs_of(text: str) -> dict[str, str]:
    """The documentation of parameters under `Args:` in a docstring, by parameter name."""
    _, _, section = re.split(
        r"(?m)^(Args|Arguments|Parameters):\s*$", text + "\nArgs:\n", maxsplit=1
    )
    found: dict[str, str] = {}
    name = ""
    for line in section.splitlines():
        if match := re.match(r"\s+(\w+)\s*(?:\([^)]*\))?:\s*(.*)", line):
            name, found[match[1]] = match[1], match[2].strip()
        elif line.strip() and line[:1].isspace() and name:
            found[name] = f"{found[name]} {line.strip()}"
        elif line.strip():
            break
    return found


def argument_places(call: Span) -> dict[str, tuple[Span, Span]]:
    """The places of the names and values of a call's keyword arguments."""
    found = {}
    expression = _expression(call)
    node = expression.body if isinstance(expression, ast.Expression) else None
    for each in node.keywords if isinstance(node, ast.Call) else ():
        value = _inside(call, each.value)
        if each.arg is not None:
            start = call.start + node_span(SourceFile("", f"({call.text})"), each).start - 1
            found[each.arg] = (Span(call.file, start, start + len(each.arg)), value)
    return found
