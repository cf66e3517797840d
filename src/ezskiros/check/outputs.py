"""Check of outputs, which have no value before the skill, so that only post-conditions may use
them.
"""

from __future__ import annotations

from collections.abc import Iterator

from dslkit.diagnostics import DeclaredHere, Diagnostic
from ezskiros.check.inference import names
from ezskiros.ontology import Ontology
from ezskiros.ontology.statements import Specified
from ezskiros.skills.interface import Clause, Parameter, SkillInterface
from ezskiros.skills.parameter_errors import WrongOutput


def check_outputs(skill: SkillInterface, _ontology: Ontology) -> Iterator[Diagnostic]:
    """Report pre- and hold-conditions that use outputs. They may only require that an output has no
    value yet.
    """
    outputs = {each.name: each for each in skill.parameters if each.is_output}
    if not outputs:
        return
    for kind, clauses in (("pre", skill.pre), ("hold", skill.hold)):
        for clause in clauses:
            for name in names(clause.statement):
                if name in outputs and clause.statement != Specified(name, is_true=False):
                    yield _asked_before(outputs[name], kind, clause)


def _asked_before(output: Parameter, kind: str, clause: Clause) -> Diagnostic:
    reason = f"a {kind}-condition uses it"
    found = WrongOutput(parameter=output.name, reason=reason, type=output.type.__qualname__)
    help = found.AskedBefore(parameter=output.name)
    return found.at(clause.span, DeclaredHere().at(output.span), help=help)
