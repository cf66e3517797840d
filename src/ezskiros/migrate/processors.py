"""Translation of SkiROS2's processors to the EzSkiROS methods of the same name."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import libcst as cst

from ezskiros.migrate import implementation_errors
from ezskiros.migrate.calls import last_name
from ezskiros.migrate.errors import LeftError

METHODS: Mapping[str, str] = {
    "Serial": "serial",
    "SerialStar": "serialstar",
    "Sequential": "serialstar",
    "Selector": "selector",
    "SelectorStar": "selectorstar",
    "ParallelFf": "parallelff",
    "ParallelFs": "parallelfs",
}
"""The processors without arguments."""
NAMES = frozenset({*METHODS, "NoFail", "RetryOnFail"})
DEFAULT = cst.Call(cst.Name("SerialStar"))
"""The processor of a compound that chooses none."""

Wrapper = Callable[[cst.Call], cst.Call]


def wrapper(processor: cst.BaseExpression) -> Wrapper:
    """Return a function that builds the call of a processor, given a call with its children.

    Raises `LeftError` for a processor that EzSkiROS does not have.
    """
    match processor:
        case cst.Call(func=func, args=[]) if (name := last_name(func)) in METHODS:
            return _calls(METHODS[name or ""])
        case cst.Call(func=func, args=[cst.Arg(value=inner, star="")]):
            if last_name(func) == "NoFail":
                return _no_fail(wrapper(inner), inner)
            if last_name(func) == "RetryOnFail" and (tries := _tries(inner)):
                return _retry(tries)
        case _:  # open: any other expression
            pass
    found = last_name(processor.func) if isinstance(processor, cst.Call) else None
    raise LeftError(implementation_errors.NoProcessor(found=found or "this expression"), processor)


def _method(name: str) -> cst.Attribute:
    return cst.Attribute(cst.Name("self"), cst.Name(name))


def _calls(name: str) -> Wrapper:
    return lambda call: call.with_changes(func=_method(name))


def _no_fail(inside: Wrapper, inner: cst.BaseExpression) -> Wrapper:
    """A `nofail`. SkiROS2's `NoFail` takes a processor; EzSkiROS's runs its children one after the
    other.
    """
    if isinstance(inner, cst.Call) and METHODS.get(last_name(inner.func) or "") == "serialstar":
        return _calls("nofail")
    return lambda call: cst.Call(_method("nofail"), [cst.Arg(inside(call))])


def _tries(value: cst.BaseExpression) -> int | None:
    """The total number of tries, from SkiROS2's number of repetitions."""
    match value:
        case cst.Integer(value=text):
            return int(text, 0) + 1
        case _:  # open: any other expression, as -1, which is forever
            return None


def _retry(tries: int) -> Wrapper:
    """A retry, such as `self.retry(child, 4)`. Several children run one after the other."""

    def wrapped(call: cst.Call) -> cst.Call:
        count = cst.Arg(cst.Integer(str(tries)))
        if len(call.args) != 1 or call.args[0].star:
            inner = call.with_changes(func=_method("serialstar"))
            return cst.Call(_method("retry"), [cst.Arg(inner), count])
        (child,) = call.args
        between = cst.Comma(whitespace_after=_without_comment(call.whitespace_before_args))
        last = count.with_changes(
            comma=child.comma, whitespace_after_arg=child.whitespace_after_arg
        )
        first = child.with_changes(comma=between, whitespace_after_arg=cst.SimpleWhitespace(""))
        return call.with_changes(func=_method("retry"), args=[first, last])

    return wrapped


def _without_comment(space: cst.BaseParenthesizableWhitespace) -> cst.BaseParenthesizableWhitespace:
    """The space between two arguments, equal to the space before the first one."""
    match space:
        case cst.ParenthesizedWhitespace(
            first_line=cst.TrailingWhitespace(comment=None), empty_lines=[]
        ):
            return space
        case _:  # open: any other space
            return cst.SimpleWhitespace(" ")
