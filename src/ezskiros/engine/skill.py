"""A running skill, from its start to its result.

At the start, the parameters get their values, including inferred ones, and the pre-conditions must
hold. The hold-conditions must hold at every tick, and the post-conditions at the end. A compound
ticks the tree that `expandBT` has built; a primitive is executed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from ezskiros.engine import user_code
from ezskiros.engine.depth import MOST_DEPTH, TooDeepError
from ezskiros.engine.events import Code, Event, Happened, Reason
from ezskiros.engine.execution_context import ExecutionContext
from ezskiros.engine.grounding import (
    Grounding,
    SharedValues,
    broken,
    missing,
    missing_output,
)
from ezskiros.engine.plans import ChildStart
from ezskiros.engine.simulation import simulate
from ezskiros.engine.values import Values
from ezskiros.engine.waiting import reason_to_wait
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.implementation import SkillImplementation
from ezskiros.skills.nodes import Node
from ezskiros.trees.tree import Tree

Build = Callable[[Node, SharedValues, ExecutionContext, "SkillChild"], Behaviour]
"""Makes the behavior that ticks the tree of a compound. Raises `TooDeepError`."""


class SkillChild(Behaviour):
    """A child that is a skill. `names` are the values that it shares with its siblings; `build`
    turns a compound skill's tree into behaviors.
    """

    def __init__(
        self,
        call: SkillCall,
        names: SharedValues,
        execution: ExecutionContext,
        label: str,
        build: Build,
        above: SkillChild | None = None,
        depth: int = 0,
    ) -> None:
        super().__init__(label)
        self.depth, self.above = depth, above
        self._call, self._names, self._execution, self._build = call, names, execution, build
        self._values: dict[str, Any] = {}
        self._instance: SkillImplementation | None = None
        self._instances: dict[type[SkillImplementation] | None, SkillImplementation] = {}
        self._params: Values | None = None
        self._expanded: Tree | None = None
        self._tree: Behaviour | None = None
        self._path: tuple[str, ...] | None = None
        self._text = self._waits_for = ""

    @property
    def path(self) -> tuple[str, ...]:
        """The names of the skills from the root."""
        if self._path is None:
            self._path = (*(self.above.path if self.above else ()), self.name)
        return self._path

    @property
    def call(self) -> SkillCall:
        """The call of the skill in the parent tree."""
        return self._call

    @property
    def values(self) -> Mapping[str, Any]:
        """The current values of its parameters; none before its start."""
        return self._values

    @property
    def shared(self) -> Mapping[str, Any]:
        """The values that it shares with its siblings, by name."""
        return self._names.values

    @property
    def execution(self) -> ExecutionContext:
        """The execution context of the skill."""
        return self._execution

    @property
    def tree(self) -> Behaviour | None:
        """The behavior that a started compound ticks."""
        return self._tree

    @property
    def is_waiting(self) -> bool:
        """True while a guard prevents the start. The status is RUNNING."""
        return bool(self._waits_for)

    # --- ticks: like those of py_trees, but without its log messages ------------------------------

    def tick(self) -> Iterator[Behaviour]:
        """Tick once."""
        if self.status is not Status.RUNNING or self._waits_for:
            if self._has_to_wait():
                self.status = Status.RUNNING
                yield self
                return
            problem = self._start()
            if problem is not None:
                self.status = self._fail(problem)
                yield self
                return
            self.status = Status.RUNNING
        self.status = self.update()
        yield self

    def update(self) -> Status:
        """Tick a started skill once."""
        if self._holds:
            reported = "hold-condition is broken"
            world = self._execution.world
            problem = broken(self._holds, reported, Code.HOLD, self._values, world)
            if problem is not None:
                self._preempted()
                return self._fail(problem)
        if self._tree is not None:
            return self._tick_tree(self._tree)
        if self._instance is None:
            simulate(self._plan, self._values, self._execution.world)
            return self._succeed(Code.END, "simulated")
        return self._execute(self._instance)

    def terminate(self, new_status: Status) -> None:
        """Stop the running skill, children first."""
        if new_status is not Status.INVALID or self.status is not Status.RUNNING:
            return
        if self._waits_for:
            self._waits_for = ""
            self._tell(Happened.PREEMPTED, Code.PREEMPTION, "stopped before it started")
            return
        problem = self._preempted()
        code, text = int(Code.PREEMPTION), "stopped"
        if problem is not None:
            code, text = problem.code, problem.text
        elif self._instance is not None:
            code, text = self._instance.progress
        self._tell(Happened.PREEMPTED, code, text)

    def _tick_tree(self, tree: Behaviour) -> Status:
        for _ in tree.tick():
            pass
        if tree.status is Status.RUNNING:
            return Status.RUNNING
        if tree.status is Status.SUCCESS:
            return self._succeed(Code.END, "End")
        problem = self._execution.last_failure or Reason(Code.END, "")
        return self._end(problem)

    def _execute(self, instance: SkillImplementation) -> Status:
        found = user_code.execute(instance)
        if self._params is not None and self._params.is_changed():
            self._share()
        if found is Status.RUNNING:
            code, text = instance.progress
            if text != self._text:
                self._text = text
                self._tell(Happened.RUNNING, code, text)
            return found
        if isinstance(found, Reason):
            return self._end(found)
        code, text = instance.progress
        if found is Status.SUCCESS:
            return self._succeed(code, text)
        return self._end(Reason(code, str(text)))

    # --- start ------------------------------------------------------------------------------------

    def _has_to_wait(self) -> bool:
        """Query the guard of the skill. A new reason to wait is reported."""
        if self._execution.guard is None:
            return False
        before, plans = self._waits_for, self._plans()
        self._waits_for = reason_to_wait(self._execution.guard, plans)
        if self._waits_for not in ("", before):
            self._plan = plans[0]
            self._tell(Happened.RUNNING, 0, f"waits: {self._waits_for}")
        return self.is_waiting

    def _start(self) -> Reason | None:
        """Start the skill. Returns the reason why it cannot start, or None."""
        problem = self._choose()
        if problem is not None:
            return problem
        plan, values = self._plan, self._values
        if plan.inferred or plan.skill.pre:
            self._share()
        if plan.locked:
            problem = self._execution.locks.lock(self, plan.locked, values)
            if problem is not None:
                return problem
        now = self._execution.clock()
        self._execution.running.start(self, plan.skill, now, lambda: self._values)
        problem = self._begin()
        if problem is None:
            self._tell(Happened.STARTED, 0, "Start")
        return problem

    def _choose(self) -> Reason | None:
        """Choose the first plan whose pre-conditions hold. Returns the reason if there is none."""
        problems: list[tuple[str, Reason]] = []
        self._text = ""
        for plan in self._plans():
            self._plan = plan
            self._holds = self._held()
            self._values = values = self._started_with(plan)
            problem = missing(plan, values)
            if problem is not None:
                return problem
            problem = self._ground(plan, values)
            if problem is None:
                return None
            problems.append((plan.label, problem))
        return _none_can(problems)

    def _plans(self) -> Sequence[ChildStart]:
        """The possible plans of the start, in the order in which they are tried."""
        return self._execution.plans.of(self._call)

    def _ground(self, plan: ChildStart, values: dict[str, Any]) -> Reason | None:
        """Infer parameters. Returns the reason if the pre-conditions then do not hold."""
        if not plan.inferred and not plan.skill.pre:
            return None
        grounding = Grounding(plan, self._names, values, self._execution)
        problem = grounding.ground()
        if grounding.chosen:
            self._tell_choice(*grounding.chosen)
        return problem

    def _started_with(self, plan: ChildStart) -> dict[str, Any]:
        return plan.started_with(self._names.values)

    def _begin(self) -> Reason | None:
        """Bind the implementation and start it."""
        plan = self._plan
        if plan.implementation is None and not self._execution.simulate:
            return Reason(Code.START, f"`{plan.skill.name}` has no implementation")
        self._instance = self._instances.get(plan.implementation)
        if plan.is_compound:
            problem = self._expand()
            if problem is not None:
                return problem
        else:
            self._tree = None
            if self._execution.simulate:
                return None
        if self._instance is None:
            problem = self._make()
            if problem is not None:
                return problem
        if self._instance is None:
            return None
        self._params = self._instance.params = Values(plan.skill, self._values)
        self._instance.progress = (0, "Start")
        return user_code.is_willing(self._instance, "onStart", Code.START)

    def _make(self) -> Reason | None:
        """Instantiate the user's class; for a compound only if it has a life-cycle method."""
        kind = self._plan.implementation
        if kind is None or (self._plan.is_compound and not _has_life(kind)):
            return None
        try:
            made = kind()
        except (Exception, SystemExit) as problem:
            return user_code.raised(problem, "__init__", Code.START)
        made.world, made.now = self._execution.world_model, self._execution.clock
        problem_reported = user_code.initialized(made)
        if problem_reported is None:
            self._instance = self._instances[kind] = made
        return problem_reported

    def _expand(self) -> Reason | None:
        plan, execution = self._plan, self._execution
        assert plan.implementation is not None
        found = execution.expansions.tree(plan.implementation, plan.skill, self._values)
        if isinstance(found, Reason):
            return found
        if found is not self._expanded or self._tree is None:
            self._expanded = found
            self._tree_names = SharedValues(self._values)
            try:
                self._tree = self._build(found.root, self._tree_names, execution, self)
            except TooDeepError:
                text = f"the tree has more than {MOST_DEPTH} levels: does a skill call itself?"
                return Reason(Code.START, text)
        self._tree_names.values = self._values
        self._tree_names.inferred.clear()
        return None

    # --- end --------------------------------------------------------------------------------------

    def _succeed(self, code: int, text: str) -> Status:
        """End a skill whose work has succeeded, if its post-conditions hold."""
        plan, values = self._plan, self._values
        problem = None
        if self._instance is not None:
            problem = user_code.is_willing(self._instance, "onEnd", Code.EXECUTION)
        if problem is None and plan.outputs:
            problem = missing_output(plan, values)
        if problem is None and plan.skill.post:
            reported = "post-condition does not hold"
            problem = broken(plan.skill.post, reported, Code.POST, values, self._execution.world)
        if problem is not None:
            self._share()
            return self._fail(problem)
        for name in plan.emptied:
            values[name] = None
        self._share()
        for own, shared in plan.found_out:
            self._names.values[shared] = values[own]
        self._release()
        self._execution.running.end(self)
        self._tell(Happened.SUCCEEDED, code, text)
        return Status.SUCCESS

    def _end(self, problem: Reason) -> Status:
        """End a skill that has failed. Its `onEnd` is called in any case."""
        if self._instance is not None:
            user_code.is_willing(self._instance, "onEnd", Code.EXECUTION)
        self._share()
        return self._fail(problem)

    def _fail(self, problem: Reason) -> Status:
        self._release()
        self._execution.running.end(self)
        self._execution.last_failure = problem
        self._tell(Happened.FAILED, problem.code, problem.text)
        return Status.FAILURE

    def _release(self) -> None:
        if self._plan.locked:
            self._execution.locks.release(self)

    def _preempted(self) -> Reason | None:
        if self._tree is not None:
            self._tree.stop(Status.INVALID)
        self._release()
        problem = user_code.preempt(self._instance) if self._instance is not None else None
        self._execution.running.end(self)
        return problem

    # --- values and reports -----------------------------------------------------------------------

    def _held(self) -> Any:
        """The conditions that are checked at every tick. SkiROS2 checks them only for compounds."""
        is_asked = not self._execution.compatible or self._plan.is_compound
        return self._plan.skill.hold if is_asked else ()

    def _share(self) -> None:
        """Pass on the outputs, under the shared names."""
        for own, shared in self._plan.shared:
            self._names.values[shared] = self._values[own]

    def _tell_choice(self, taken: Any, solutions: Any) -> None:
        spelled = self._execution.world.spelled
        texts = [
            ", ".join(f"{name}={spelled(iri)}" for name, iri in each.items()) for each in solutions
        ]
        others = (text for text, each in zip(texts, solutions, strict=True) if each is not taken)
        chosen = texts[list(solutions).index(taken)]
        self._tell(Happened.CHOSEN, 0, f"{chosen}; it could be {'; '.join(others)}")

    def _tell(self, happened: Happened, code: int, text: str) -> None:
        plan = self._plan
        values = self._values if happened is Happened.STARTED else {}
        name, label = plan.skill.name, plan.label
        self._execution.tell(Event(happened, self.path, name, label, code, str(text), values))


def _none_can(problems: Sequence[tuple[str, Reason]]) -> Reason:
    """The reason why no implementation can start, or the reason of each implementation."""
    first = problems[0][1]
    if len(problems) == 1:
        return first
    reported = "; ".join(f"`{label}`: {problem.text}" for label, problem in problems)
    return Reason(first.code, f"no implementation can start: {reported}")


def _has_life(kind: type[SkillImplementation]) -> bool:
    """Say whether a compound defines a method that is called at its start or end."""
    methods = ("onStart", "onPreempt", "onEnd")
    return any(getattr(kind, each) is not getattr(SkillImplementation, each) for each in methods)
