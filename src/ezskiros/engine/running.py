"""A skill that runs: from its call to its result.

When it starts, its parameters get their values, those that are inferred from the world; then its
pre-conditions have to hold, its hold-conditions at every tick, its post-conditions at the end. A
compound ticks the tree that `expandBT` has built, a primitive is executed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from ezskiros.engine.inference import infer
from ezskiros.engine.processors import decorator, processor
from ezskiros.engine.values import Values, WorldThing
from ezskiros.engine.world import World
from ezskiros.skills.implementation import SkillImplementation, State
from ezskiros.skills.interface import Clause, SkillInterface
from ezskiros.skills.markers import Kind
from ezskiros.skills.nodes import Decorator, Node, Processor, SkillCall
from ezskiros.trees.expand import expand
from ezskiros.trees.library import Library
from ezskiros.trees.names import shared_names

_STATUS = {
    State.SUCCESS: Status.SUCCESS,
    State.FAILURE: Status.FAILURE,
    State.RUNNING: Status.RUNNING,
}


@dataclass(frozen=True)
class Event:
    """Something that happened to a skill. `code` and `text` are its progress."""

    path: tuple[str, ...]
    state: str
    code: int
    text: str


@dataclass
class Setting:
    """What all skills of a task share."""

    library: Library
    world: World
    tell: Callable[[Event], None]
    simulate: bool = False
    """Whether primitives do nothing but what their post-conditions say."""
    restarts: bool = False
    """Whether parallels start children again that have succeeded, as in SkiROS2."""
    ambiguous: list[str] = field(default_factory=list)


class RunningSkill(Behaviour):
    """A child that is a skill; `names` are the values that it shares with its siblings."""

    def __init__(
        self, call: SkillCall, names: dict[str, Any], setting: Setting, path: tuple[str, ...]
    ) -> None:
        self._call, self._names, self._setting = call, names, setting
        self._skill: SkillInterface = setting.library.skill(call.skill)
        self._path = (*path, self._label())
        super().__init__(self._path[-1])
        self._tree: Behaviour | None = None
        self._instance: SkillImplementation | None = None
        self._values: dict[str, Any] = {}
        self._problem: str | None = None

    def _label(self) -> str:
        wanted = self._call.implementation
        return f"{self._skill.name}.{wanted}" if wanted else self._skill.name

    # --- the life of a skill ----------------------------------------------------------------------

    def initialise(self) -> None:
        """Start."""
        self._tree = self._instance = None
        self._problem = self._start()

    def update(self) -> Status:
        """One tick."""
        if self._problem is not None:
            return self._end(Status.FAILURE, -404, self._problem)
        if broken := self._broken(self._skill.hold):
            return self._end(Status.FAILURE, -405, f"hold-condition is broken: {broken}")
        status, code, text = self._ticked()
        if status is Status.RUNNING:
            self._tell("Running", code, text)
            return status
        if status is Status.SUCCESS:
            self._share()
            if self._setting.simulate and self._tree is None:
                self._apply_post_conditions()
            if broken := self._broken(self._skill.post):
                return self._end(Status.FAILURE, -405, f"post-condition does not hold: {broken}")
        return self._end(status, code, text)

    def terminate(self, new_status: Status) -> None:
        """The end, or a stop while it runs."""
        if new_status is Status.INVALID and self.status is Status.RUNNING:
            if self._tree is not None:
                self._tree.stop(Status.INVALID)
            if self._instance is not None:
                self._instance.onPreempt()
                self._instance.onEnd()
            self._tell("Preempted", -406, "")

    # --- start ------------------------------------------------------------------------------------

    def _start(self) -> str | None:
        """Why it cannot start, None if it has started."""
        self._values = self._given()
        problem = self._missing() or self._inferred()
        if problem:
            return problem
        if broken := self._broken(self._skill.pre):
            return f"pre-condition does not hold: {broken}"
        return self._begun()

    def _given(self) -> dict[str, Any]:
        """What the parameters get from the call, from the names, and by default."""
        found = {each.name: each.default for each in self._skill.parameters}
        found |= dict(self._call.arguments)
        for shared in shared_names(self._call, self._skill):
            found[shared.parameter.name] = self._names.get(shared.shared)
        return found

    def _missing(self) -> str | None:
        for parameter in self._skill.parameters:
            is_needed = parameter.kind is Kind.REQUIRED and not parameter.is_output
            if is_needed and self._values[parameter.name] is None:
                return f"`{parameter.name}` has no value"
        return None

    def _inferred(self) -> str | None:
        free = [
            each
            for each in self._skill.parameters
            if each.kind is Kind.INFERRED and self._values[each.name] is None
        ]
        if not free:
            return None
        world = self._setting.world
        found = infer(self._skill, free, self._things(), world)
        if found.without_candidates:
            names = ", ".join(f"{each.name} ({each.type!r})" for each in found.without_candidates)
            return f"the world has nothing for {names}"
        if not found.solutions:
            names = ", ".join(each.name for each in free)
            return f"nothing in the world satisfies the pre-conditions for {names}"
        for name, iri in found.solutions[0].items():
            self._values[name] = WorldThing(iri, world)
        if len(found.solutions) > 1:
            self._tell_choice(found.solutions)
        return None

    def _tell_choice(self, solutions: Iterable[Any]) -> None:
        spelled = self._setting.world.spelled
        texts = [
            ", ".join(f"{name}={spelled(iri)}" for name, iri in each.items()) for each in solutions
        ]
        self._tell("Chosen", 0, f"{texts[0]}; it could be {'; '.join(texts[1:])}")

    def _begun(self) -> str | None:
        known = self._setting.library.implementations(self._call.skill)
        wanted = self._call.implementation
        kind = known.get(wanted) if wanted else next(iter(known.values()), None)
        if kind is None:
            if self._setting.simulate:
                return None
            return f"nothing implements {self._label()}"
        if hasattr(kind, "expandBT"):
            return self._expand(kind)
        if self._setting.simulate:
            return None
        self._instance = kind()
        self._instance.params = Values(self._skill, self._values)
        return None if self._instance.onStart() else "onStart failed"

    def _expand(self, kind: type[SkillImplementation]) -> str | None:
        tree = next(expand(kind, self._skill), None)
        if tree is None:
            return f"{kind.__name__} builds no behavior tree"
        self._tree = behavior(tree.root, self._values, self._setting, self._path)
        return None

    # --- ticks ------------------------------------------------------------------------------------

    def _ticked(self) -> tuple[Status, int, str]:
        if self._tree is not None:
            for _ in self._tree.tick():
                pass
            return self._tree.status, 0, ""
        if self._instance is None:
            return Status.SUCCESS, 1, "simulated"
        state = self._instance.execute()  # type: ignore[attr-defined]
        return _STATUS[state], *self._instance.progress

    def _end(self, status: Status, code: int, text: str) -> Status:
        if self._instance is not None and not self._instance.onEnd():
            status, code, text = Status.FAILURE, -405, "onEnd failed"
        self._tell(status.name.capitalize(), code, text)
        return status

    def _share(self) -> None:
        """What it has found out, under the names that it shares."""
        for shared in shared_names(self._call, self._skill):
            self._names[shared.shared] = self._values[shared.parameter.name]

    def _apply_post_conditions(self) -> None:
        for clause in self._skill.post:
            self._setting.world.make(clause.statement, self._things())

    def _things(self) -> dict[str, str]:
        values = self._values.items()
        return {name: each.iri for name, each in values if isinstance(each, WorldThing)}

    def _broken(self, clauses: Iterable[Clause]) -> str | None:
        """The first condition that does not hold, as it is written."""
        if not clauses:
            return None
        things = self._things()
        for clause in clauses:
            if not self._setting.world.holds(clause.statement, things):
                return f"{clause.span.text} ({clause.span})"
        return None

    def _tell(self, state: str, code: int, text: str) -> None:
        self._setting.tell(Event(self._path, state, code, text))


def behavior(
    node: Node, names: dict[str, Any], setting: Setting, path: tuple[str, ...]
) -> Behaviour:
    """What ticks a node of a tree."""
    match node:
        case SkillCall():
            return RunningSkill(node, names, setting, path)
        case Processor(flow=flow, children=children):
            below = [behavior(child, names, setting, path) for child in children]
            return processor(flow, below, restarts=setting.restarts)
        case Decorator(decoration=decoration, child=child, limit=limit):
            return decorator(decoration, behavior(child, names, setting, path), limit)
    raise AssertionError(node)
