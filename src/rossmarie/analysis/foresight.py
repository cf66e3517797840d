"""Requirements of rules: a proof that a rule is active before it is too late to brake, or a
counterexample.

The query is about one instant. According to the last messages, the condition of the rule is false.
The solver searches for a motion that cannot slow down before the locations. It assumes that the
next message comes as late as its timeout allows, and that the brakes act as late and as weakly as
declared.
"""

from __future__ import annotations

from collections.abc import Iterator

from rossmarie.analysis.errors import InTime, NotInTime
from rossmarie.analysis.finding import Finding, witness_note
from rossmarie.analysis.inquiry import Inquiry, has_value
from rossmarie.analysis.solver import Satisfiability
from rossmarie.analysis.unproved import not_proved, shown_speed
from rossmarie.ir import Requirement, TruthValue


def find_late(inquiry: Inquiry, required: Requirement) -> Iterator[Finding]:
    """A note if a requirement is proved; an error with a witness if it does not hold; an error if
    it is undecided. The inquiry is about the machine of the requirement.
    """
    below = inquiry.below(required.proposition)
    last = len(below.machine.propositions) - 1
    result = below.decide(has_value(last, TruthValue.TRUE))
    if result.outcome is Satisfiability.IMPOSSIBLE:
        proved = InTime(rule=required.rule, text=required.text)
        yield Finding(proved.at(required.span))
    elif result.witness is None:
        yield not_proved(required, "no proof was found, and no counterexample either")
    else:
        braking = required.braking
        finding = NotInTime(rule=required.rule, motion=braking.motion, speed=shown_speed(required))
        reaction = finding.Reaction(
            motion=braking.motion,
            reaction=f"{braking.reaction_s:g} s",
            timeout=f"{braking.timeout_s:g} s",
            latency=f"{braking.latency_s:g} s",
        )
        note = witness_note(below.machine, result.witness, (last,))
        yield Finding(finding.at(required.span, notes=(note, reaction)), result.witness)
