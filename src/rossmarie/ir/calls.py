"""The ways in which skills may run, as far as the queries of a machine can tell them apart."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from rossmarie.ir.path import Doing, Path
from rossmarie.ir.skills import RunningSkill, SkillArgument, SkillContext, answer


@dataclass(frozen=True)
class SkillCall:
    """A skill that runs, or that can start next (`is_ahead`), and the classes of the things that
    are its arguments, as pairs of a parameter and a class: of no class where the parameter has no
    value, and once for each where a thing has several. `text` is how a test says so, None if none
    can.
    """

    skill: str
    types: tuple[tuple[str, str], ...]
    text: str | None
    is_ahead: bool = False

    @property
    def running(self) -> RunningSkill:
        """The call as a message tells of it."""
        arguments = (SkillArgument(parameter, type=kind) for parameter, kind in self.types)
        return RunningSkill(self.skill, tuple(arguments), self.is_ahead)

    def answers(self, step: Doing) -> bool:
        """Say whether a query is answered by yes while this call runs."""
        return answer(step, SkillContext.of(step.export, [self.running])) == 1.0


def query_at(path: Path) -> Doing | None:
    """The query that a path asks of the skills that run; None if it asks none."""
    match path:
        case (Doing() as step,):
            return step
        case _:  # open: any other path
            return None


def covering(calls: Iterable[SkillCall], wanted: dict[Doing, bool]) -> tuple[SkillCall, ...] | None:
    """Calls that together give queries these answers, a few of them; None if there are none."""
    possible = [(call, {step for step in wanted if call.answers(step)}) for call in calls]
    left = {step for step, is_yes in wanted.items() if is_yes}
    useful = [(call, yes) for call, yes in possible if yes <= left]
    chosen: list[SkillCall] = []
    while left:
        call, yes = max(useful, key=lambda each: len(each[1] & left), default=(None, set[Doing]()))
        if call is None or not yes & left:
            return None
        chosen.append(call)
        left -= yes
    return tuple(chosen)
