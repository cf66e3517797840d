"""Comparison of the findings about contracts of random trees with runs in small worlds."""

from __future__ import annotations

import random
from typing import Any

from hypothesis import example, given, settings
from hypothesis import strategies as st

from dslkit.source import Span
from ezskiros.contracts.contracts import check_tree
from ezskiros.contracts.findings import TreeFindings
from ezskiros.skills.implementation import SkillImplementation
from ezskiros.trees.tree import Tree
from support.contract_runs import Run, finished, start
from support.contract_trees import OWN, Drawn, drawn, holds
from support.depth import examples


def codes_at(findings: TreeFindings, span: Span) -> set[str]:
    return {each.code for each in findings.found.values() if each.primary.span == span}


def about(findings: TreeFindings, span: Span) -> set[str]:
    """The codes of findings that show a place."""
    return {
        each.code
        for each in findings.found.values()
        if span in (each.primary.span, *(label.span for label in each.labels))
    }


AT_START = {"EZS550", "EZS551", "EZS552", "EZS553", "EZS554", "EZS559", "EZS560"}


class compound(SkillImplementation):  # noqa: N801 - as implementations are called
    """Whose tree it is."""


@settings(max_examples=examples(5), report_multiple_bugs=False)
@given(st.integers(0, 2**32))
@example(43)
@example(105)
@example(622)
@example(156227934)
@example(266052121)
@example(1664858960)
@example(2841322)
@example(953780892)
@example(2671807873)
def test_findings_are_what_runs_show(seed: int) -> None:
    check(seed)


def check(seed: int) -> None:
    """One tree, drawn by chance."""
    chance = random.Random(seed)
    found = drawn(chance)
    tree = Tree(compound, found.compound, found.root, found.compound.span)
    library: Any = found.skills
    findings = check_tree(tree, library)
    if findings is not None:
        compare(found, findings, chance)


def compare(found: Drawn, findings: TreeFindings, chance: random.Random) -> None:
    codes = {each.code for each in findings.found.values()}
    for _ in range(15):
        facts = start(found, chance)
        if facts is None:
            return
        run = Run(found, facts, chance)
        has_succeeded = finished(run)
        for call, is_spared in run.false_starts:
            if not is_spared:
                assert codes_at(findings, call.span) & AT_START, call.span
        for clause in run.broken_holds:
            assert about(findings, clause.span) & {"EZS557", "EZS558"}, clause
        for call in run.started:
            assert "EZS550" not in codes_at(findings, call.span) or run.is_broken
        if has_succeeded:
            assert "EZS550" not in codes or run.is_broken
            for clause in found.compound.post:
                is_reported = codes_at(findings, clause.span)
                if not holds(clause.statement, run.world, OWN):
                    assert is_reported & {"EZS555", "EZS556"}, clause
                else:
                    assert "EZS555" not in is_reported
