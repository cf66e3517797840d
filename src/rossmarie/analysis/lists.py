"""Results over lists of messages, as terms of the solver. The encoding ignores the elements.

If the terms must cover every possible value (`rounded`), a result is any value that the list may
give. In a proposed trace of events, every list that arrives is empty, and S53 gives the results.
The interpreter decides whether such a trace is confirmed.
"""

from __future__ import annotations

from typing import Protocol

import z3

from rossmarie import ir
from rossmarie.analysis.terms import NumberTerm, PropositionTerm


class Encoding(Protocol):
    """One evaluation of a machine as terms."""

    machine: ir.Machine
    facts: list[z3.BoolRef]
    rounded: bool

    def is_fresh(self, used: int) -> z3.BoolRef:
        """Say whether an input has arrived and has not expired."""

    def is_stale(self, index: int, node: ir.PropositionNode) -> z3.BoolRef:
        """Say whether an unknown leaf is unknown because of an input with a timeout."""


_BEYOND_ALL = z3.RealVal(10) ** 400
"""A stand-in for infinity: greater than all doubles."""


def list_of(machine: ir.Machine, array: int | None) -> int | None:
    """The list that an array belongs to; None if the array is not a column of a list."""
    assert array is not None, "verified: only elements are folded"
    return machine.arrays[array].list


def folded(encoding: Encoding, its_list: int, node: ir.Fold) -> NumberTerm:
    """The least or greatest value over the elements."""
    fresh = encoding.is_fresh(encoding.machine.lists[its_list].input)
    if encoding.rounded:
        return NumberTerm(z3.And(fresh, z3.FreshBool("fold.known")), z3.FreshReal("fold"))
    is_minimum = node.folding is ir.Folding.MINIMUM
    return NumberTerm(fresh, _BEYOND_ALL if is_minimum else -_BEYOND_ALL)


def counted(encoding: Encoding, its_list: int) -> NumberTerm:
    """The number of elements for which a proposition is true."""
    declared = encoding.machine.lists[its_list]
    fresh = encoding.is_fresh(declared.input)
    if not encoding.rounded:
        return NumberTerm(fresh, z3.RealVal(0))
    number = z3.FreshInt("count")
    encoding.facts += [number >= 0, number <= declared.most]
    return NumberTerm(z3.And(fresh, z3.FreshBool("count.known")), z3.ToReal(number))


def quantified(
    encoding: Encoding, its_list: int, index: int, node: ir.Quantified
) -> PropositionTerm:
    """A proposition that is true for at least one element, or for every element."""
    fresh = encoding.is_fresh(encoding.machine.lists[its_list].input)
    if encoding.rounded:
        known, is_so = z3.FreshBool("list.known"), z3.FreshBool("list.is_so")
    else:
        known, is_so = fresh, z3.BoolVal(node.quantifier is ir.Quantifier.ALL)
    known = z3.And(fresh, known)
    stale = z3.And(z3.Not(known), encoding.is_stale(index, node))
    return PropositionTerm(z3.And(known, is_so), z3.And(known, z3.Not(is_so)), stale)
