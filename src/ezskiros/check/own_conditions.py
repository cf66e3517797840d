"""Check of the pre-conditions of an implementation against the ontology and the conditions of its
skill.
"""

from __future__ import annotations

from collections.abc import Iterator

from dslkit.diagnostics import Diagnostic
from ezskiros.check.consistency import check_consistency
from ezskiros.check.errors import MayNotFit
from ezskiros.check.relations import check_relations
from ezskiros.skills.implementation import SkillImplementation
from ezskiros.trees.library import Library


def check_own_conditions(
    implementation: type[SkillImplementation], library: Library
) -> Iterator[Diagnostic]:
    """Report mistakes that the skill has with these pre-conditions, but not without them."""
    skill, ontology = library.skill(implementation.description), library.ontology()
    refined = library.as_done_by(implementation)
    if skill is None or refined is None or refined is skill or ontology is None:
        return
    for check in (check_relations, check_consistency):
        reported = {(each.code, each.primary.span) for each in check(skill, ontology)}
        for found in check(refined, ontology):
            # Such a condition may exclude some individuals of the class: this is its purpose.
            is_choice = found.code == MayNotFit.code
            if not is_choice and (found.code, found.primary.span) not in reported:
                yield found
