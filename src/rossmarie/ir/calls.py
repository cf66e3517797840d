"""The combinations of running skills, as far as the queries of a machine distinguish them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from rossmarie.ir.path import Doing, Path
from rossmarie.ir.skills import RunningSkill, SkillArgument, SkillContext, answer


@dataclass(frozen=True)
class SkillCall:
    """A skill that runs, or that can start next (`is_ahead`), and the classes of its arguments, as
    pairs of a parameter and a class. An argument without a value has no class; an argument with
    several classes occurs once for each. `text` is the call in the notation of tests; None if the
    call has none.
    """

    skill: str
    types: tuple[tuple[str, str], ...]
    text: str | None
    is_ahead: bool = False

    @property
    def running(self) -> RunningSkill:
        """The call as a message contains it."""
        arguments = (SkillArgument(parameter, type=kind) for parameter, kind in self.types)
        return RunningSkill(self.skill, tuple(arguments), self.is_ahead)

    def answers(self, step: Doing) -> bool:
        """Say whether the answer to a query is yes while this call runs."""
        return answer(step, SkillContext.of(step.export, [self.running])) == 1.0


def query_at(path: Path) -> Doing | None:
    """The query about running skills in a path; None if there is none."""
    match path:
        case (Doing() as step,):
            return step
        case _:  # open: any other path
            return None


def covering(calls: Iterable[SkillCall], wanted: dict[Doing, bool]) -> tuple[SkillCall, ...] | None:
    """A few calls that together give queries these answers; None if no calls do."""
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
