"""Checks of method bodies that a check does not run: undefined names and attributes, and arithmetic
that always fails.

Nothing is reported if the method catches the exception, or first tests for the name (`hasattr`,
`sys.platform`). Nothing is reported either if code may define the name invisibly (`setattr`,
`exec`, a base class without its source).
"""

from __future__ import annotations

import ast
import builtins
import difflib
import operator
from abc import ABCMeta
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import lru_cache
from importlib.util import find_spec
from inspect import unwrap
from types import CodeType, FunctionType, ModuleType
from typing import Any, TypeGuard

from dslkit.diagnostics import Diagnostic, DidYouMean
from dslkit.source import SourceFile, Span
from dslkit.source.call_site import node_span, source_file
from ezskiros.check import body_errors as errors
from ezskiros.skills.implementation import ImplementationClass, SkillImplementation
from ezskiros.skills.methods import WrittenMethod, written
from ezskiros.skills.own_conditions import METHOD
from ezskiros.skills.syntax import file_of

_FROM_HOSTS = frozenset(("params", "world", "now", "progress", "wmi", "_wmi", "node", "_node"))
"""Attributes of instances that the engine or SkiROS2 sets."""
_CATCHING = frozenset(
    (
        "ArithmeticError", "AttributeError", "BaseException", "Exception", "NameError",
        "TypeError", "ZeroDivisionError",
    )
)  # fmt: skip
_ASKING = frozenset(
    ("hasattr", "platform", "version_info", "TYPE_CHECKING", "os.name", "find_spec", "locals")
)
"""Names in a condition that show that some machines do not reach the branch."""
_HIDING = frozenset(
    (
        "setattr",
        "vars",
        "exec",
        "eval",
        "__dict__",
        "__getattr__",
        "__getattribute__",
        "__setattr__",
    )
)
"""Names in a class that can create attributes of any name."""
_OPERATORS: Mapping[type[ast.operator], Callable[[object, object], object]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
}
_KINDS = (type, ABCMeta, ImplementationClass)
"""The metaclasses that are known to add no attributes."""


def check_bodies(implementation: type[SkillImplementation]) -> Iterator[Diagnostic]:
    """Find code that raises whenever it runs, in the methods that a check does not run."""
    attributes = _attributes(implementation)
    for method in _methods(implementation):
        found = written(method)
        if found is not None:
            body = _Body(method, found)
            for node in _uncaught(found.node.body):
                yield from body.undefined(node)
                yield from body.not_in_module(node)
                yield from body.not_of_self(node, attributes)
                yield from body.impossible(node)


def _methods(implementation: type) -> Iterator[FunctionType]:
    """The methods that users wrote and that no other method overrides, in source order. Decorators
    from elsewhere are left out, and so are `expandBT` and `conditions`, because a check runs them.
    """
    seen = {"expandBT", METHOD}
    for owner in _user_classes(implementation):
        for name, method in vars(owner).items():
            if name not in seen and isinstance(method, FunctionType):
                inner = unwrap(method)
                is_own = inner.__globals__.get("__name__") == owner.__module__
                if is_own and inner.__qualname__ == f"{owner.__qualname__}.{name}":
                    yield inner
        seen |= vars(owner).keys()


def _user_classes(implementation: type) -> Iterator[type]:
    ours = {*SkillImplementation.__mro__}
    for each in implementation.__mro__:
        is_base = SkillImplementation in each.__bases__  # `SkillBase` of a description
        if each not in ours and not is_base:
            yield each


def _uncaught(body: Iterable[ast.AST]) -> Iterator[ast.AST]:
    """The nodes below some nodes. Nodes whose exceptions a `try` catches, nodes that a condition
    guards, and annotations are left out.
    """
    work = [*body][::-1]
    while work:
        node = work.pop()
        yield node
        below = list(ast.iter_child_nodes(node))
        if isinstance(node, ast.Try) and any(map(_catches, node.handlers)):
            below = [*node.handlers, *node.orelse, *node.finalbody]
        elif isinstance(node, (ast.If, ast.IfExp, ast.While, ast.BoolOp)) and _is_guarded(node):
            below = []
        elif isinstance(node, ast.AnnAssign):
            below = [node.target, *filter(None, [node.value])]
        elif isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            below = [*node.decorator_list, *node.body]
        work += below[::-1]


def _catches(handler: ast.ExceptHandler) -> bool:
    if handler.type is None:
        return True
    return any(isinstance(x, ast.Name) and x.id in _CATCHING for x in ast.walk(handler.type))


def _is_guarded(node: ast.If | ast.IfExp | ast.While | ast.BoolOp) -> bool:
    """Say whether a condition tests for features of the machine."""
    test = node if isinstance(node, ast.BoolOp) else node.test
    for each in ast.walk(test):
        match each:
            case ast.Attribute(value=ast.Name(id=owner), attr=name):
                if name in _ASKING or f"{owner}.{name}" in _ASKING:
                    return True
            case ast.Name(id=name) | ast.Attribute(attr=name):
                if name in _ASKING:
                    return True
            case _:  # open: any other node
                pass
    return False


class _Body:
    """The body of a method, node by node."""

    def __init__(self, method: FunctionType, found: WrittenMethod) -> None:
        self._method, self._written = method, found
        self._globals = method.__globals__
        self._local = _local_names(method.__code__, found.node)
        arguments = found.node.args.args
        self._self = arguments[0].arg if arguments else None

    def undefined(self, node: ast.AST) -> Iterator[Diagnostic]:
        """A name that neither the method nor its module nor Python defines."""
        if not self._is_global(node) or node.id in self._globals or hasattr(builtins, node.id):
            return
        if node.id not in _set_globally(self._written.file):
            near = difflib.get_close_matches(node.id, [*self._local, *self._globals], n=1)
            help = DidYouMean(near=near[0]) if near else None
            found = errors.UndefinedName(spelled=node.id, method=self._method.__name__)
            yield found.at(self._span(node), help=help)

    def not_in_module(self, node: ast.AST) -> Iterator[Diagnostic]:
        """An attribute that a module does not have: `math.sqroot`."""
        if _is_asked(node):
            module = self._module(node.value)
            if module is not None and not _may_have(module, node.attr):
                yield self._no_attribute(node, vars(module))

    def not_of_self(self, node: ast.AST, attributes: frozenset[str] | None) -> Iterator[Diagnostic]:
        """An attribute of `self` that no class defines and no method sets."""
        if attributes is None or not _is_asked(node) or node.attr in attributes:
            return
        is_of_self = isinstance(node.value, ast.Name) and node.value.id == self._self
        if is_of_self and not node.attr.startswith("__"):
            yield self._no_attribute(node, attributes)

    def impossible(self, node: ast.AST) -> Iterator[Diagnostic]:
        """Arithmetic of constants that fails."""
        if isinstance(node, ast.BinOp):
            reason = _failure(node)
            if reason is not None:
                yield errors.AlwaysFails(reason=reason).at(self._span(node))

    def _no_attribute(self, node: ast.Attribute, known: Iterable[str]) -> Diagnostic:
        owner = self._span(node.value).text
        near = difflib.get_close_matches(node.attr, [x for x in known if x[:1] != "_"], n=1)
        help = DidYouMean(near=f"{owner}.{near[0]}") if near else None
        found = errors.NoAttribute(owner=owner, spelled=node.attr, method=self._method.__name__)
        return found.at(self._span(node), help=help)

    def _is_global(self, node: ast.AST) -> TypeGuard[ast.Name]:
        if not isinstance(node, ast.Name):
            return False
        return isinstance(node.ctx, ast.Load) and node.id not in self._local

    def _module(self, node: ast.expr) -> ModuleType | None:
        """The module that an expression stands for; None for stand-ins, which have attributes of
        any name.
        """
        found: object = None
        if self._is_global(node):
            found = self._globals.get(node.id)
        elif isinstance(node, ast.Attribute):
            above = self._module(node.value)
            found = vars(above).get(node.attr) if above else None
        return found if type(found) is ModuleType else None

    def _span(self, node: ast.expr) -> Span:
        return node_span(self._written.file, node)


def _is_asked(node: ast.AST) -> TypeGuard[ast.Attribute]:
    return isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Load)


def _local_names(code: CodeType, node: ast.FunctionDef) -> frozenset[str]:
    """The names that a function and its inner functions define."""
    codes = [code]
    for each in codes:
        codes += (one for one in each.co_consts if isinstance(one, CodeType))
    names = {
        name for one in codes for name in (*one.co_varnames, *one.co_cellvars, *one.co_freevars)
    }
    stored = (each for each in ast.walk(node) if isinstance(each, ast.Name))
    return frozenset(names | {each.id for each in stored if not isinstance(each.ctx, ast.Load)})


@lru_cache(maxsize=64)
def _set_globally(file: SourceFile) -> frozenset[str]:
    """The global names that functions of a file may define later: `global count`."""
    declared = (each for each in ast.walk(ast.parse(file.text)) if isinstance(each, ast.Global))
    return frozenset(name for each in declared for name in each.names)


def _may_have(module: ModuleType, name: str) -> bool:
    if name in vars(module) or "__getattr__" in vars(module) or hasattr(ModuleType, name):
        return True
    try:
        return hasattr(module, "__path__") and find_spec(f"{module.__name__}.{name}") is not None
    except (ImportError, ValueError):
        return True


def _failure(node: ast.BinOp) -> str | None:
    """The words of the exception that an operation of constants raises."""
    left, right = _constant(node.left), _constant(node.right)
    operation = _OPERATORS.get(type(node.op))
    if left is None or right is None or operation is None:
        return None
    if isinstance(node.op, ast.Mod) and isinstance(left, (str, bytes)):
        return None  # a text that is formatted
    try:
        operation(left, right)
    except (ArithmeticError, TypeError) as problem:
        return str(problem)
    return None


def _constant(node: ast.expr) -> Any:
    """The value of a constant number or text; None for any other expression."""
    if isinstance(node, ast.Constant) and type(node.value) in (int, float, str, bytes):
        return node.value
    return None


# --- attributes of self -----------------------------------------------------------------------


def _attributes(implementation: type) -> frozenset[str] | None:
    """The attributes that `self` has from a class or an assignment; None if it may have others."""
    found = {*dir(implementation), *_FROM_HOSTS}
    for owner in _user_classes(implementation):
        file = source_file(file_of(owner))
        own = _set_in(file).get(owner.__name__) if file and type(owner) in _KINDS else None
        if own is None or own & _HIDING:
            return None
        found |= own
    return frozenset(found)


@lru_cache(maxsize=64)
def _set_in(file: SourceFile) -> Mapping[str, frozenset[str]]:
    """The names of attributes of `self` that each class may set, and the names of `_HIDING` in it,
    by class name.
    """
    classes = (each for each in ast.walk(ast.parse(file.text)) if isinstance(each, ast.ClassDef))
    return {
        owner.name: frozenset(name for node in ast.walk(owner) for name in _may_set(node))
        for owner in classes
    }


def _may_set(node: ast.AST) -> Iterator[str]:
    match node:
        case ast.Attribute(attr=name, ctx=ast.Store()) | ast.AnnAssign(target=ast.Name(id=name)):
            yield name
        case ast.Call(
            func=ast.Name(id="hasattr" | "getattr"), args=[_, ast.Constant(value=str(name)), *_]
        ):
            yield name
        case ast.Name(id=name) | ast.Attribute(attr=name) | ast.FunctionDef(name=name):
            if name in _HIDING:
                yield name
        case _:  # open: any other node
            pass
