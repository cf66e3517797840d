"""A plan as a drawing of a behavior tree, with the individuals of the scene."""

from __future__ import annotations

from collections.abc import Iterator

from ezskiros.drawing.outline import TOKENS, Line, NodeBox, Outline, Role
from ezskiros.planning.facts import spelled
from ezskiros.planning.pddl import PlanStep
from ezskiros.planning.plan import Plan
from ezskiros.skills.nodes import Flow


def drawn(plan: Plan) -> Outline:
    """The steps, one after the other, below their goals."""
    model = plan.scene.ontology.model
    wanted = (spelled(each.literal, model, model.short) for each in plan.goals)
    steps = tuple(
        NodeBox(step.action.skill.name, "", tuple(_lines(step, plan)), ()) for step in plan.steps
    )
    flow = Flow.SERIAL_STAR
    root = NodeBox(flow.value.lower(), TOKENS[flow], (), steps)
    return Outline(
        NodeBox("plan", "", tuple(Line(Role.POST, each) for each in wanted), (root,)), ()
    )


def _lines(step: PlanStep, plan: Plan) -> Iterator[Line]:
    model = plan.scene.ontology.model
    for name, iri in step.individuals.items():
        yield Line(Role.VALUE, f"{name} = {model.short(iri)}")
    for each in step.action.skill.parameters:
        if not each.is_individual and not each.is_output:
            is_open = each.default is None
            value = f": {each.type.__name__}" if is_open else f" = {each.default!r}"
            yield Line(Role.PASSED if is_open else Role.VALUE, each.name + value)
