"""The turning points of a number after a sample (S32), as C obligations about a monitor `m` that
was `old` before the sample.
"""

from __future__ import annotations

from collections.abc import Iterator

from rossmarie.verification.definitions import Definitions
from rossmarie.verification.formulas import literal
from rossmarie.verification.invariants import oscillation
from rossmarie.verification.layout import ProofLayout
from rossmarie.verification.program import obligation
from rossmarie.verification.recent import first_recent


def followed_on(layout: ProofLayout, channel: int) -> list[int]:
    """The oscillations that get a sample from a message on a channel."""
    signals = [oscillation(layout, k).signal for k in range(len(layout.oscillations))]
    supports = map(layout.support_of_signal, signals)
    return [k for k, support in enumerate(supports) if channel in support.channels]


def forgotten(layout: ProofLayout, definitions: Definitions) -> Iterator[str]:
    """Make `expected` forget all turning points of numbers that become unknown."""
    for k in range(len(layout.oscillations)):
        x = definitions.number(oscillation(layout, k).signal)
        yield f"if (!isfinite({x})) {{"
        yield f"    expected.extreme[{k}] = NAN;"
        yield f"    expected.heading[{k}] = 0;"
        yield f"    expected.recent_count[{k}] = 0;"
        yield "}"


def followed(layout: ProofLayout, definitions: Definitions, channel: int) -> Iterator[str]:
    """The obligations about all oscillations that get a sample from a message on a channel."""
    for k in followed_on(layout, channel):
        yield from _followed(layout, definitions, k)


def _followed(layout: ProofLayout, definitions: Definitions, k: int) -> Iterator[str]:
    """The obligations about the k-th oscillation."""
    node, first = oscillation(layout, k), first_recent(layout, k)
    about = (
        f"the turning points of `{layout.machine.propositions[layout.oscillations[k]].text}` fit"
    )
    extreme, heading, turns = f"old.extreme[{k}]", f"old.heading[{k}]", f"old.recent_count[{k}]"
    following = f"old.recent_next[{k}]"
    places = range(first, first + node.count)
    after = f"({following} + 1u) % {node.count}u"
    obligations = [
        f"spec_same(m->extreme[{k}], !is_known ? NAN : is_new || up || down ? x : {extreme})",
        f"m->heading[{k}] == (!is_known ? 0 : up ? 1 : down ? -1 : {heading})",
        f"m->recent_count[{k}] == (is_known ? {turns} + (turn && {turns} < {node.count}) : 0)",
        f"m->recent_next[{k}] == (turn ? {after} : {following})",
        *(
            f"m->recent_ns[{place}] == "
            f"(turn && {first} + {following} == {place} ? t_ns : old.recent_ns[{place}])"
            for place in places
        ),
    ]
    yield _MOVES.format(
        x=definitions.number(node.signal),
        swing=literal(node.swing),
        extreme=extreme,
        heading=heading,
        obligations="\n".join(obligation(each, about) for each in obligations),
    )


_MOVES = """\
    {{
    const double x = {x};
    const bool is_known = isfinite(x), goes_up = {heading} > 0, goes_down = {heading} < 0;
    const bool is_new = isnan({extreme}) || (goes_up && x > {extreme}) ||
                        (goes_down && x < {extreme});
    const bool up = is_known && !is_new && !goes_up && x > {extreme} + {swing};
    const bool down = is_known && !is_new && !up && !goes_down && x < {extreme} - {swing};
    const bool turn = (up || down) && {heading} != 0;
{obligations}
    }}"""
