"""The missing pre-conditions of compound skills, with those that other skills then need."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ezskiros.contracts.children import names_of_tree
from ezskiros.contracts.contracts import check_contracts
from ezskiros.contracts.findings import Missing
from ezskiros.contracts.judge import Judge
from ezskiros.ontology.statements import Statement
from ezskiros.skills.interface import Clause, SkillInterface
from ezskiros.trees.library import Library
from ezskiros.trees.tree import Tree


def missing_pre_conditions(trees: Sequence[Tree], library: Library) -> list[Missing]:
    """All of them, in the order in which they are found; what would exclude what a skill asks for
    already is none.
    """
    added: dict[str, Sequence[Clause]] = {}
    found: dict[tuple[str, Statement], Missing] = {}
    seen: set[tuple[str, Statement]] = set()
    while True:
        missing = check_contracts(trees, library, added).missing
        new = [each for each in missing if (each.skill.name, each.statement) not in seen]
        if not new:
            return list(found.values())
        for each in new:
            seen.add((each.skill.name, each.statement))
            skill = each.skill
            more = (*added.get(skill.name, ()), Clause(each.statement, skill.span))
            if _is_possible(replace(skill, pre=(*skill.pre, *more)), library):
                added[skill.name] = more
                found[skill.name, each.statement] = each


def _is_possible(skill: SkillInterface, library: Library) -> bool:
    ontology = library.ontology()
    assert ontology is not None  # something has been found in a tree
    judge = Judge(ontology.model, names_of_tree(skill, (), lambda _: skill))
    return not judge.is_impossible(each.statement for each in (*skill.pre, *skill.hold))
