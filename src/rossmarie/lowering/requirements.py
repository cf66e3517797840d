"""Requirements of rules. They are lowered after everything that monitors need, so that no monitor
computes them.
"""

from __future__ import annotations

import dataclasses

from rossmarie import ir
from rossmarie.check.model import CheckedKeeps, CheckedMotion, CheckedProgram
from rossmarie.lowering.lower import Lowered, lowered
from rossmarie.lowering.nodes import Shown
from rossmarie.lowering.wording import words


def lower_requirements(program: CheckedProgram) -> tuple[ir.Requirement, ...]:
    """The requirements of all rules, in the order of the rules."""
    if not any(program.keeps):
        return ()
    found = lowered(program)
    kept = [(rule, keeps) for rule, keeps in enumerate(program.keeps) if keeps is not None]
    propositions = [_not_in_time(rule, keeps, program, found) for rule, keeps in kept]
    machine = dataclasses.replace(
        found.machine,
        inputs=tuple(found.inputs.inputs),
        channels=tuple(found.inputs.channels),
        slots=tuple(found.inputs.slots),
        texts=tuple(found.inputs.texts),
        signals=tuple(found.nodes.signals),
        propositions=tuple(found.nodes.propositions),
    )
    return tuple(
        ir.Requirement(
            rule=machine.rules[rule].name,
            text=words(keeps.written.span),
            span=keeps.written.span,
            speed=keeps.speed,
            places=keeps.region.about,
            braking=_braking(keeps.motion),
            machine=machine,
            proposition=proposition,
        )
        for (rule, keeps), proposition in zip(kept, propositions, strict=True)
    )


def _not_in_time(rule: int, keeps: CheckedKeeps, program: CheckedProgram, found: Lowered) -> int:
    """The proposition that it is too late while the condition of the rule is false. The condition
    counts as false if no skill of the rule's scope runs, or if a skill of one of its exemptions
    runs.
    """
    span, name = keeps.written.span, found.machine.rules[rule].name
    late = found.propositions.too_late(keeps, Shown(f"too late: {words(span)}", span))
    stated = words(program.rules[rule].condition.span)
    inactive = found.nodes.negation(found.contracts[rule].condition, Shown(f"not {stated}", span))
    shown = Shown(f"too late, and {name} is not active", span)
    return found.nodes.conjunction((late, inactive), shown)


def _braking(motion: CheckedMotion) -> ir.Braking:
    return ir.Braking(
        motion=motion.declaration.name.text,
        position=words(motion.position.span),
        speed=words(motion.speed.span),
        brake=motion.brake,
        acceleration=motion.acceleration,
        fastest=motion.fastest,
        timeout_s=motion.timeout_s,
        latency_s=motion.latency_s,
        is_of_one_message=motion.is_of_one_message,
    )
