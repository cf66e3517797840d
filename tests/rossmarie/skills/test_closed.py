"""Closed sets of names, against sets made by hand."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from rossmarie.skills import Closure
from rossmarie.skills.closed import circle_among
from support.depth import examples

NAMES = "abcdef"
GRAPHS = st.dictionaries(
    st.sampled_from(NAMES), st.lists(st.sampled_from(NAMES), unique=True, max_size=3)
)


def derived(parents: dict[str, list[str]], name: str, above: str) -> bool:
    """Say whether a name is another, or is derived from it, by trying all ways."""
    reached = {name}
    for _ in NAMES:
        reached |= {parent for each in reached for parent in parents.get(each, [])}
    return above in reached


@settings(max_examples=examples(1))
@given(GRAPHS)
def test_below_and_above_are_all_that_can_be_reached(parents: dict[str, list[str]]) -> None:
    closure = Closure(parents)
    for name in NAMES:
        assert set(closure.above(name)) == {o for o in NAMES if derived(parents, name, o)}
        assert set(closure.below(name)) == {o for o in NAMES if derived(parents, o, name)}
        for other in NAMES:
            both = [o for o in NAMES if derived(parents, o, name) and derived(parents, o, other)]
            assert closure.are_related(name, other) is bool(both)


@settings(max_examples=examples(1))
@given(GRAPHS)
def test_a_circle_is_found_where_there_is_one(parents: dict[str, list[str]]) -> None:
    known = {name: [p for p in above if p in parents] for name, above in parents.items()}
    on_circle = {n for n in known if any(derived(known, parent, n) for parent in known[n])}
    found = circle_among(parents)
    assert (found in on_circle) if on_circle else found is None
