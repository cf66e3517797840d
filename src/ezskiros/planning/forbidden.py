"""Removal of the steps that rules always stop."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from ezskiros.engine.prohibitions import Prohibition
from ezskiros.engine.world import World
from ezskiros.planning.actions import PlanningAction
from ezskiros.planning.facts import About, Clause, Fluent, FluentLiteral


def permitted(
    actions: Iterable[PlanningAction], without: Sequence[Prohibition]
) -> list[PlanningAction]:
    """The actions, each with the additional need that an individual is of another class than a rule
    forbids. Actions that are always stopped are left out.
    """
    found = []
    for action in actions:
        about = [*_about(action, without)]
        if all(each.individuals for each in about):
            found.append(replace(action, needs=(*action.needs, *map(_clause, about))))
    return found


def stopped_by(
    action: PlanningAction,
    individuals: Mapping[str, str],
    without: Sequence[Prohibition],
    world: World,
) -> Prohibition | None:
    """The first prohibition that applies to a step; None if no rule stops it."""
    return next(
        (
            each
            for each in _about(action, without)
            if all(world.is_a(individuals[name], owl_class) for name, owl_class in each.individuals)
        ),
        None,
    )


def _about(action: PlanningAction, without: Iterable[Prohibition]) -> Iterator[Prohibition]:
    """The prohibitions of a skill. If a plan leaves a parameter open, its class is unknown, and so
    is whether rules stop the step.
    """
    known = {each.name for each in action.individuals}
    for each in without:
        if each.skill == action.skill.name and known.issuperset(
            name for name, _ in each.individuals
        ):
            yield each


def _clause(prohibition: Prohibition) -> Clause:
    return tuple(
        FluentLiteral(Fluent(About.CLASS, owl_class), (name,), False)
        for name, owl_class in prohibition.individuals
    )
