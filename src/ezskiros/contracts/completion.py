"""The missing pre-conditions of compound skills, including those that other skills need as a
consequence.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ezskiros.contracts.children import names_of_tree
from ezskiros.contracts.contracts import check_contracts
from ezskiros.contracts.findings import MissingCondition
from ezskiros.contracts.judge import Judge
from ezskiros.ontology.statements import Statement
from ezskiros.skills.interface import Clause, SkillInterface
from ezskiros.trees.library import Library
from ezskiros.trees.tree import Tree


def missing_pre_conditions(trees: Sequence[Tree], library: Library) -> list[MissingCondition]:
    """All missing pre-conditions, in the order of discovery. A pre-condition that contradicts the
    other conditions of the skill is left out.
    """
    added: dict[str, Sequence[Clause]] = {}
    found: dict[tuple[str, Statement], MissingCondition] = {}
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
    assert ontology is not None  # a new finding in a tree
    judge = Judge(ontology.model, names_of_tree(skill, (), lambda _: skill))
    return not judge.is_impossible(each.statement for each in (*skill.pre, *skill.hold))
