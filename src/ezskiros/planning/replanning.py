"""Replanning: skills that lead to the post-conditions of a task from the current world model
(thesis, section 5.2).

A tree that found a route blocked records this in the world model, and the search respects the
pre-conditions of skills, so the same route is not taken again. Steps that rules would stop are not
taken either.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future
from types import MappingProxyType

from dslkit.diagnostics import Diagnostic
from ezskiros.engine.interruption import NoPlanError, PlannedCalls, Replan
from ezskiros.engine.prohibitions import Prohibition
from ezskiros.engine.values import WorldIndividual
from ezskiros.engine.world import World
from ezskiros.learning.lessons import Cost
from ezskiros.planning.actions import NotPlannableError, actions, literal
from ezskiros.planning.goals import Goal
from ezskiros.planning.pddl import PlanStep
from ezskiros.planning.search import Search
from ezskiros.planning.solve import NoPlannerError
from ezskiros.session import NOWHERE
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.interface import SkillInterface
from ezskiros.trees.library import Library

SECONDS = 5.0
"""The longest time to find out whether a plan exists, and the longest time to find it, in seconds.
The robot does not move during the search.
"""


def replanner(library: Library, world: World) -> Replan:
    """Searches in a thread, on a copy of the world, while the task continues to be ticked."""

    def replan(task: SkillCall, without: Sequence[Prohibition]) -> Future[PlannedCalls]:
        start = world.copy()
        return _in_background(lambda: planned_calls(library, task, world, start, without))

    return replan


def planned_calls(
    library: Library,
    task: SkillCall,
    world: World,
    start: World,
    without: Sequence[Prohibition] = (),
    *,
    costs: Sequence[Cost] = (),
    seconds: float = SECONDS,
) -> PlannedCalls:
    """The skills that lead to the post-conditions of a task, to be run in `world`. `start` is a
    copy of the current world, and `costs` are the known losses of time to rules. Steps that rules
    always stop are not used. Raises `NoPlanError`.
    """
    skill = library.skill(task.skill)
    assert skill is not None, "it runs"
    wanted = list(_goals(skill, task.arguments))
    known, left_out = actions(library, world.ontology.model)
    try:
        model = world.ontology.model
        search = Search(start.copy, model, known, wanted, seconds, costs, without)
        steps, said = search.run()
    except (NoPlannerError, RuntimeError) as problem:
        raise NoPlanError(str(problem)) from None
    if steps is None:
        raise NoPlanError("; ".join(map(_reported, (*said, *left_out))))
    return [_call(step, task.arguments, world) for step in steps]


def _reported(found: Diagnostic) -> str:
    """A finding in one line, with its reasons."""
    return f"{found.title} ({'; '.join(found.notes)})" if found.notes else found.title


def _goals(skill: SkillInterface, values: Mapping[str, object]) -> Iterator[Goal]:
    individuals = {
        name: each.iri for name, each in values.items() if isinstance(each, WorldIndividual)
    }
    if not skill.post:
        raise NoPlanError(f"`{skill.name}` has no post-condition, so its goal is unknown")
    for each in skill.post:
        try:
            wanted = literal(each.statement)
        except NotPlannableError:
            raise NoPlanError(
                f"a post-condition of `{skill.name}` cannot be the goal of a plan"
            ) from None
        unknown = [name for name in wanted.arguments if name not in individuals]
        if unknown:
            raise NoPlanError(f"`{skill.name}` has no value yet for `{unknown[0]}`")
        yield Goal(wanted.bound(individuals), each.span)


def _call(step: PlanStep, values: Mapping[str, object], world: World) -> SkillCall:
    """A step as a call. A parameter that is not an individual gets the value of the task's
    parameter with the same name and type.
    """
    skill = step.action.skill
    found: dict[str, object] = {
        name: WorldIndividual(iri, world) for name, iri in step.individuals.items()
    }
    for each in skill.parameters:
        if each.is_individual or each.is_output:
            continue
        if each.name in values and each.takes(values[each.name]):
            found[each.name] = values[each.name]
        elif each.default is None:
            raise NoPlanError(f"`{skill.name}` needs a value for `{each.name}`")
    return SkillCall(step.action.description, None, MappingProxyType(found), NOWHERE)


def _in_background(search: Callable[[], PlannedCalls]) -> Future[PlannedCalls]:
    """Run a search in a thread that does not delay the end of the program."""
    future: Future[PlannedCalls] = Future()

    def work() -> None:
        try:
            future.set_result(search())
        except NoPlanError as problem:
            future.set_exception(problem)
        except Exception as problem:  # the robot does not move: the task has to end in order
            future.set_exception(NoPlanError(f"the search failed: {problem!r}"))

    threading.Thread(target=work, name="replan", daemon=True).start()
    return future
