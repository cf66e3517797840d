"""Continuation of checked code after a refused call.

The calls in a file are compiled as calls of `called`, which makes the call and returns a mock after
a refusal. This extends the map for nonlocal names in the thesis (Paper IV, section 4.2) to all
names. Only files with a refused or raising call are compiled again; the others stay unchanged.
"""

from __future__ import annotations

import ast
import gc
import importlib.abc
import importlib.machinery
import operator
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from inspect import Signature, signature
from pathlib import Path
from traceback import walk_tb
from types import CodeType, FunctionType, ModuleType

from ezskiros import session
from ezskiros.skills import guard, values
from ezskiros.skills.blame import user_place
from ezskiros.skills.mocks import mock_of
from ezskiros.skills.values import Symbol, SymbolicValue

_CALLED, _GOT, _TAKEN = "__ezskiros_called__", "__ezskiros_got__", "__ezskiros_taken__"
_AS_WRITTEN = frozenset(("super", "locals", "globals", "vars", "dir", "eval", "exec"))
"""The functions that examine the frame of their caller."""
_OF_SYMBOLS = frozenset((__file__, values.__file__))
_intercepted: set[str] = set()


def called(function: Callable[..., object], /, *arguments: object, **named: object) -> object:
    """Call a function. Return a mock if the call would have a side effect, or cannot handle a
    symbol.
    """
    current = guard.current()
    if current is None:
        return function(*arguments, **named)
    owner = getattr(function, "__self__", None)
    if any(owner is each for each in current.half_done):
        return mock_of(function, _source())
    count = len(current.stopped)
    try:
        found = function(*arguments, **named)
    except (Exception, guard.SideEffectError) as problem:
        if len(current.stopped) == count:
            symbol = next((x for x in (*arguments, *named.values()) if isinstance(x, Symbol)), None)
            if symbol is None or _is_wrong(function, arguments, named, problem):
                raise
            _try_examples(function, arguments, named, problem)
            return symbol.__derived__()
    else:
        if len(current.stopped) == count:
            return found
    current.go_on(count)
    if not isinstance(owner, (ModuleType, type(None))):
        current.half_done.append(owner)
    return mock_of(function, _source())


def _is_wrong(
    function: Callable[..., object],
    arguments: Sequence[object],
    named: Mapping[str, object],
    problem: BaseException,
) -> bool:
    """Say whether a failed call would fail for any value of a symbol: the user's code raised, or
    EzSkiROS raised, which supports symbols, or the arguments do not fit the function.
    """
    if user_place(problem) is not None or _is_ours(function) or _comes_from_ours(problem):
        return True
    known = _signature(function)
    if known is not None:
        try:
            known.bind(*arguments, **named)
        except TypeError:
            return True
    return False


def _signature(function: Callable[..., object]) -> Signature | None:
    """The signature; None for a built-in function without one, such as `range`."""
    try:
        return signature(function)
    except (TypeError, ValueError):
        return None


def _try_examples(
    function: Callable[..., object],
    arguments: Sequence[object],
    named: Mapping[str, object],
    problem: BaseException,
) -> None:
    """Call a built-in function without a signature with values of the types of the symbols. Raises
    `TypeError` if it rejects these as well.
    """
    if not isinstance(problem, TypeError) or _signature(function) is not None:
        return
    values = [*map(_example, arguments)]
    by_name = {name: _example(value) for name, value in named.items()}
    if any(isinstance(each, Symbol) for each in (*values, *by_name.values())):
        return
    try:
        function(*values, **by_name)
    except TypeError as refused:
        raise refused from None
    except Exception:  # the values are invented: only a TypeError shows that no value fits
        return


def _example(value: object) -> object:
    """A value of the type of a symbol; the symbol if its type is unknown."""
    return value.__example__() if isinstance(value, SymbolicValue) else value


def _is_ours(function: object) -> bool:
    code = getattr(getattr(function, "__func__", function), "__code__", None)
    return code is not None and code.co_filename.startswith(session.OURS)


def _comes_from_ours(problem: BaseException) -> bool:
    """Say whether an exception passed EzSkiROS code other than that of symbols."""
    frames = (frame.f_code.co_filename for frame, _ in walk_tb(problem.__traceback__))
    return any(path.startswith(session.OURS) and path not in _OF_SYMBOLS for path in frames)


def got(owner: object, name: str) -> object:
    """An attribute. It may be an accessor with a side effect."""
    return getattr(owner, name) if isinstance(owner, Symbol) else called(getattr, owner, name)


def taken(owner: object, key: object) -> object:
    """The item with a key, which may be a symbol."""
    return called(operator.getitem, owner, key)


def _source() -> str:
    """The current call in the user's code, without its arguments."""
    return session.here().text.partition("(")[0].strip()


def intercept(paths: Iterable[str]) -> bool:
    """Compile the calls in some files as calls of `called`, from now on and at each import.

    Returns False if nothing changes: the files are intercepted already, or have no source.
    """
    changed = [_intercept(path) for path in paths]
    return any(changed)


def _intercept(path: str) -> bool:
    if path in _intercepted or not Path(path).is_file():
        return False
    _intercepted.add(path)
    known = _functions(_rewritten(path))
    for each in gc.get_objects():
        if type(each) is FunctionType and each.__code__.co_filename == path:
            code = known.get(_place(each.__code__))
            if code is not None and code.co_freevars == each.__code__.co_freevars:
                each.__code__ = code
                each.__globals__.update(_NAMES)
    return True


_NAMES = {_CALLED: called, _GOT: got, _TAKEN: taken}


class _Loader(importlib.machinery.SourceFileLoader):
    """Loads files whose calls are intercepted."""

    def get_code(self, _name: str) -> CodeType:
        """The rewritten code."""
        return _rewritten(self.path)

    def exec_module(self, module: ModuleType) -> None:
        """Run the code with the functions that make its calls."""
        vars(module).update(_NAMES)
        super().exec_module(module)


class Finder(importlib.abc.MetaPathFinder):
    """Finds the files whose calls are intercepted."""

    def find_spec(
        self, name: str, path: Sequence[str] | None = None, _target: ModuleType | None = None
    ) -> importlib.machinery.ModuleSpec | None:
        """Return the spec of a module if it is one of the intercepted files."""
        if not _intercepted:
            return None
        spec = importlib.machinery.PathFinder.find_spec(name, path)
        if spec is None or spec.origin not in _intercepted:
            return None
        spec.loader = _Loader(name, spec.origin)
        return spec


def _rewritten(path: str) -> CodeType:
    """The code of a module whose calls are made by `called`."""
    tree = ast.parse(Path(path).read_bytes(), path)
    return compile(_Calls().visit(tree), path, "exec", dont_inherit=True)


def _functions(code: CodeType) -> dict[tuple[str, int], CodeType | None]:
    """The functions of a module by place; None for a place with several functions."""
    found: dict[tuple[str, int], CodeType | None] = {}
    for each in _inside(code):
        place = _place(each)
        found[place] = None if place in found else each
    return found


def _inside(code: CodeType) -> Iterator[CodeType]:
    for each in code.co_consts:
        if isinstance(each, CodeType):
            yield each
            yield from _inside(each)


def _place(code: CodeType) -> tuple[str, int]:
    return code.co_name, code.co_firstlineno


class _Calls(ast.NodeTransformer):
    """Replaces calls and attributes, and keeps their places for findings."""

    def visit_Call(self, node: ast.Call) -> ast.AST:
        self.generic_visit(node)
        if isinstance(node.func, ast.Name) and node.func.id in _AS_WRITTEN:
            return node
        return _call(_CALLED, [node.func, *node.args], node.keywords, node)

    def visit_Attribute(self, node: ast.Attribute) -> ast.AST:
        self.generic_visit(node)
        is_private = node.attr.startswith("__") and not node.attr.endswith("__")
        if is_private or not isinstance(node.ctx, ast.Load):
            return node
        name = ast.copy_location(ast.Constant(node.attr), node)
        return _call(_GOT, [node.value, name], [], node)

    def visit_Subscript(self, node: ast.Subscript) -> ast.AST:
        self.generic_visit(node)
        has_slices = any(isinstance(each, ast.Slice) for each in ast.walk(node.slice))
        if has_slices or not isinstance(node.ctx, ast.Load):
            return node
        return _call(_TAKEN, [node.value, node.slice], [], node)

    def visit_arg(self, node: ast.arg) -> ast.AST:
        """Leave types unchanged."""
        return node

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        returns, node.returns = node.returns, None
        self.generic_visit(node)
        node.returns = returns
        return node

    def visit_AnnAssign(self, node: ast.AnnAssign) -> ast.AST:
        if node.value is not None:
            node.value = self.visit(node.value)
        return node

    def visit_match_case(self, node: ast.match_case) -> ast.AST:
        """Leave patterns unchanged."""
        node.guard = self.visit(node.guard) if node.guard else None
        node.body = [self.visit(each) for each in node.body]
        return node


def _call(
    name: str, arguments: list[ast.expr], keywords: list[ast.keyword], place: ast.expr
) -> ast.Call:
    function = ast.copy_location(ast.Name(name, ast.Load()), place)
    return ast.copy_location(ast.Call(function, arguments, keywords), place)
