"""Check that the parameters used by methods of implementations exist in the skill."""

from __future__ import annotations

from collections.abc import Iterator

from dslkit.diagnostics import Diagnostic
from ezskiros.skills.implementation import SkillImplementation
from ezskiros.skills.interface import SkillInterface
from ezskiros.skills.no_such_parameter import no_such_parameter
from ezskiros.skills.syntax import used_in


def check_parameters(
    implementation: type[SkillImplementation], skill: SkillInterface
) -> Iterator[Diagnostic]:
    """Report parameters in `self.params.Name` that the skill does not have. The run of `expandBT`
    finds those in `expandBT`.
    """
    for name, place in used_in(implementation):
        if not name.startswith("__") and not skill.parameter(name) and name not in skill.unclear:
            yield no_such_parameter(skill, name, place)
