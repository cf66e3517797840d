"""Data flow against all executions of small trees: a value is told to be missing exactly where some
execution reads it before it was written.
"""

from __future__ import annotations

from collections.abc import Iterator

from hypothesis import given, settings
from hypothesis import strategies as st

from support.depth import examples
from support.trees import findings, tree

Shape = str | tuple[str, tuple["Shape", ...]]
"""A skill, or what stands over some."""
TEXT = {"write": "Measure()", "read": "Grip()"}
SEVERAL = ("serialstar", "selectorstar", "serial", "selector", "nofail")
ONE = ("inverter", "retry")

shapes = st.recursive(
    st.sampled_from(["write", "read"]),
    lambda inner: st.one_of(
        st.tuples(st.sampled_from(SEVERAL), st.lists(inner, min_size=1, max_size=3).map(tuple)),
        st.tuples(st.sampled_from(ONE), inner.map(lambda each: (each,))),
    ),
    max_leaves=6,
)


def text(shape: Shape) -> str:
    """As it is written."""
    if isinstance(shape, str):
        return TEXT[shape]
    name, inner = shape
    more = ", 2" if name == "retry" else ""
    return f"self.{name}({', '.join(map(text, inner))}{more})"


class MissingError(Exception):
    """A value is read that was not written."""


def runs(shape: Shape, is_written: bool) -> Iterator[tuple[bool, bool]]:
    """All executions: whether each succeeds, and whether the value is written after it."""
    if isinstance(shape, str):
        if shape == "read" and not is_written:
            raise MissingError
        yield True, is_written or shape == "write"
        yield False, is_written
        return
    name, inner = shape
    if name == "inverter":
        yield from ((not succeeds, after) for succeeds, after in runs(inner[0], is_written))
    elif name == "retry":
        for succeeds, after in runs(inner[0], is_written):
            yield succeeds, after
            if not succeeds:
                yield from runs(inner[0], after)
    else:
        yield from several(name, inner, is_written)


def several(name: str, inner: tuple[Shape, ...], is_written: bool) -> Iterator[tuple[bool, bool]]:
    goes_on_with = not name.startswith("selector")
    first, *others = inner
    for succeeds, after in set(runs(first, is_written)):
        if succeeds is goes_on_with and others:
            yield from several(name, tuple(others), after)
        else:
            yield succeeds or name == "nofail", after


def reads_too_early(shape: Shape) -> bool:
    """Say whether some execution reads a value too early."""
    try:
        list(runs(shape, is_written=False))
    except MissingError:
        return True
    return False


@settings(max_examples=examples(6))
@given(shapes)
def test_a_value_is_missing_where_an_execution_misses_it(shape: Shape) -> None:
    codes = {code for code, _ in findings(tree(text(shape), ""))}
    assert bool(codes & {"EZS530", "EZS531"}) == reads_too_early(shape)
