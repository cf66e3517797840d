"""What the name of a skill stands for in a behavior tree.

`Pick(Object=...)` is a child that any implementation of Pick will do for, `Pick.pick_fast(...)` one
that this implementation has to do. `Pick.SkillBase` is what implementations are derived from.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

from ezskiros import session
from ezskiros.skills import tree_errors as errors
from ezskiros.skills.nodes import SkillCall, made

if TYPE_CHECKING:  # descriptions are of the class that is written here
    from ezskiros.skills.description import SkillDescription


class SkillClass(type):
    """The type of all descriptions."""

    def __call__(cls, *positional: object, **arguments: object) -> Any:
        """A child of a behavior tree."""
        return _child(cls, None, positional, arguments)

    def __getattr__(cls, name: str) -> ImplementationName:
        """The implementation of this name; whether there is one is known when all are loaded."""
        if name.startswith("_"):
            raise AttributeError(f"{cls.__name__!r} has no attribute {name!r}")
        return ImplementationName(cls, name)


@dataclass(frozen=True)
class ImplementationName:
    """An implementation that a child of a behavior tree asks for."""

    skill: SkillClass
    spelled: str

    def __call__(self, *positional: object, **arguments: object) -> Any:
        """A child of a behavior tree."""
        return _child(self.skill, self.spelled, positional, arguments)

    def __mro_entries__(self, _bases: tuple[object, ...]) -> tuple[type, ...]:
        """The class that is meant where one is derived from a misspelt `SkillBase`."""
        found = errors.NoSkillBase(skill=self.skill.__name__, spelled=self.spelled)
        session.report(found.at(session.here()))
        base: type = self.skill.SkillBase  # type: ignore[assignment]
        return (base,)


def _child(
    skill: SkillClass,
    implementation: str | None,
    positional: tuple[object, ...],
    arguments: dict[str, object],
) -> Any:
    span = session.here()
    if positional:
        session.report(errors.NamelessArgument(skill=skill.__name__).at(span))
    called = cast("type[SkillDescription]", skill)
    return made(SkillCall(called, implementation, arguments, span))
