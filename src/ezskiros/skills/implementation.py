"""The class behind `Pick.SkillBase`, the base class of implementations."""

from __future__ import annotations

import difflib
import enum
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar

from dslkit.diagnostics import DidYouMean, Remark
from ezskiros import session
from ezskiros.ontology.things import UNKNOWN, Unknown, described
from ezskiros.skills import tree_errors as errors
from ezskiros.skills.calls import SkillClass
from ezskiros.skills.growing import Nowhere, drop, is_growing, made
from ezskiros.skills.maker_calls import maker
from ezskiros.skills.nodes import Decoration, Decorator, Flow, Node, Processor
from ezskiros.skills.values import SymbolicValue, has_decided, plain


class State(enum.Enum):
    """The state of a skill; the numbers are those of SkiROS2."""

    SUCCESS = 1
    FAILURE = 2
    RUNNING = 3


class ImplementationClass(type):
    """The type of all implementations."""

    def __call__(cls, *arguments: object, **named: object) -> Any:
        """An instance that runs; in a behavior tree skills are named instead, and that is
        reported.
        """
        if not is_growing():
            return super().__call__(*arguments, **named)
        skill = getattr(cls, "description", SkillImplementation).__name__
        found = errors.ImplementationNamed(implementation=cls.__name__, skill=skill)
        session.report(found.at(session.here()))
        return UNKNOWN


class SkillImplementation(metaclass=ImplementationClass):
    """An implementation of a skill's description.

        class pick(Pick.SkillBase):
            def expandBT(self, params):
                self.serialstar(
                    ApproachMovement.go_to_linear(Target=params.GraspPose),
                    ActuateGripper(Open=False),
                )

    A compound has the method `expandBT`, which writes its behavior tree (thesis, Paper IV, listing
    7). The children of a processor are skills, processors and decorators, nested at will; what they
    do with the results of their children is what SkiROS2's processors of these names do.
    """

    description: ClassVar[SkillClass]
    """The skill that is implemented."""
    available_for_planning: ClassVar[bool] = True
    """True if a task planner may use it: `available_for_planning = False` is for skills that are
    only named by trees and by people.
    """
    params: Any
    """The values of its parameters, while it runs: `self.params.Speed`. Those that it finds out are
    set: `self.params.Force = 3.5`."""
    world: Any
    """The world model, while it runs in the engine: `self.world.relate(tray, skiros.contain, nut)`.
    """
    now: Any
    """The time in seconds, by the clock of the engine while it runs there: `self.now()`."""
    pre_conditions: Any
    """The method `conditions(self, Door)`, if there is one, adds pre-conditions that only this
    implementation has: `self.pre_conditions += Door.Open == False`."""
    progress: tuple[int, str] = (0, "")
    """The progress, in its own numbers, and a text about it."""

    if not TYPE_CHECKING:  # for type checkers only what is written is there

        def __getattr__(self, name: str) -> Any:
            """In a behavior tree what is not there is reported, with what may be meant."""
            if not is_growing() or name.startswith("__"):
                kind = type(self).__name__
                raise AttributeError(f"{kind!r} object has no attribute {name!r}")
            found = errors.UnknownProcessor(implementation=type(self).__name__, spelled=name)
            session.report(found.at(session.here(), help=_help_for(name)))
            return Nowhere()

    # --- primitives -------------------------------------------------------------------------------

    def onInit(self) -> bool | None:  # noqa: N802 - as in SkiROS2
        """Called once, before the first `onStart`; the skill cannot start if it returns `False`."""
        return True

    def onStart(self) -> bool:  # noqa: N802
        """Called before the first `execute`; whether the skill can start."""
        return True

    def onPreempt(self) -> State:  # noqa: N802
        """Called when the skill is stopped while it runs."""
        return self.fail("stopped", -406)

    def onEnd(self) -> bool:  # noqa: N802
        """Called after the last `execute`, or after `onPreempt`; whether all is well."""
        return True

    def success(self, text: str = "") -> State:
        """Say that it is done: for `execute` to return."""
        return self._reported(State.SUCCESS, self.progress[0] + 1, text)

    def step(self, text: str = "") -> State:
        """Report progress. `execute` returns this result, and is called again at the next tick."""
        return self._reported(State.RUNNING, self.progress[0] + 1, text)

    def fail(self, text: str, code: int = -405) -> State:
        """Say that it has failed: for `execute` to return; `code` is made negative."""
        return self._reported(State.FAILURE, -abs(code), text)

    def _reported(self, state: State, code: int, text: str) -> State:
        self.progress = (code, text)
        return state

    # --- compounds --------------------------------------------------------------------------------

    @maker
    def serial(self, *children: Node) -> Node:
        """One after the other until one fails; from the first again on each tick."""
        return _processor(Flow.SERIAL, children)

    @maker
    def serialstar(self, *children: Node) -> Node:
        """Run children one after the other until one fails; finished children are not
        ticked again.
        """
        return _processor(Flow.SERIAL_STAR, children)

    @maker
    def selector(self, *children: Node) -> Node:
        """One after the other until one succeeds; from the first again on each tick."""
        return _processor(Flow.SELECTOR, children)

    @maker
    def selectorstar(self, *children: Node) -> Node:
        """Run children one after the other until one succeeds; failed children are not ticked
        again.
        """
        return _processor(Flow.SELECTOR_STAR, children)

    @maker
    def parallelff(self, *children: Node) -> Node:
        """All at once until all succeed; the first that fails stops the others."""
        return _processor(Flow.PARALLEL_FF, children)

    @maker
    def parallelfs(self, *children: Node) -> Node:
        """Run all children at once until the first has a result, which is the result of all."""
        return _processor(Flow.PARALLEL_FS, children)

    @maker
    def nofail(self, *children: Node) -> Node:
        """One after the other; a failure counts as success."""
        return _processor(Flow.NO_FAIL, children)

    @maker
    def inverter(self, child: Node) -> Node:
        """Success is failure, and failure success."""
        return _decorator(Decoration.INVERTER, child, None)

    @maker
    def retry(self, child: Node, count: int) -> Node:
        """Again when it fails, `count` times at most in all; it may be `params.Count`."""
        return _decorator(Decoration.RETRY, child, count)

    @maker
    def timeout(self, child: Node, seconds: float) -> Node:
        """A failure when it has no result after these seconds; they may be `params.Seconds`."""
        return _decorator(Decoration.TIMEOUT, child, seconds)


MAKERS = tuple(each.value.lower() for each in (*Flow, *Decoration))
"""The methods that make processors and decorators."""
_ELSEWHERE = {
    "sequence": "serialstar",
    "sequential": "serialstar",
    "fallback": "selectorstar",
    "parallel": "parallelff",
}
"""Names that others have for some of them."""


def _help_for(name: str) -> Remark:
    """Tell what to write instead of something that `self` does not have in `expandBT`."""
    if name == "params":
        return errors.UnknownProcessor.Params()
    if name == "skill":
        return errors.UnknownProcessor.Skill()
    if name in _ELSEWHERE:
        return errors.UnknownProcessor.OtherName(processor=_ELSEWHERE[name])
    near = difflib.get_close_matches(name, MAKERS, n=1)
    if near:
        return DidYouMean(near=f"self.{near[0]}")
    return errors.UnknownProcessor.Known(known=", ".join(MAKERS))


def _processor(flow: Flow, children: tuple[Any, ...]) -> Node:
    span = session.here()
    below = tuple(child for child in children if _is_node(child))
    if not children and not has_decided():  # a loop that depends on a value may have none
        session.report(errors.NoChildren(processor=flow.value).at(span))
    return made(Processor(flow, below, span), below)


def _decorator(decoration: Decoration, child: Node, limit: Any) -> Node:
    span = session.here()
    limit = plain(limit)
    is_swapped = isinstance(limit, Node) and not isinstance(child, Node)
    if is_swapped:
        child = limit
    if decoration in _LIMITS and not _can_limit(limit, _LIMITS[decoration]):
        found = errors.WrongLimit(
            decorator=decoration.value.lower(),
            numbers="whole number" if decoration is Decoration.RETRY else "number",
            found="a child" if is_swapped else described(limit),
        )
        session.report(found.at(span))
        limit = 1
    if not _is_node(child):
        return child
    return made(Decorator(decoration, child, limit, span), (child,))


_LIMITS: Mapping[Decoration, tuple[type, ...]] = {
    Decoration.RETRY: (int,),
    Decoration.TIMEOUT: (int, float),
}
"""The types of the tries of a retry, and of the seconds of a timeout."""


def _can_limit(limit: object, kinds: tuple[type, ...]) -> bool:
    """Say whether a limit is a number above 0 that ends, or can be one when the skill runs."""
    if isinstance(limit, SymbolicValue):
        return limit.__may_be__(kinds)
    return type(limit) in kinds and 0 < limit < math.inf  # type: ignore[operator]


def _is_node(child: object) -> bool:
    """Say whether something can be part of a tree; if not, report it."""
    if isinstance(child, Node):
        return True
    if not isinstance(child, Unknown):
        found = errors.NoNode(found=described(child))
        session.report(found.at(session.here(), help=_help_for_child(child)))
    if isinstance(child, (list, tuple)):
        drop(child)
    return False


def _help_for_child(child: object) -> Remark | None:
    """Tell what to write instead of something that is no child, where that is plain."""
    if isinstance(child, str) and child.isidentifier():
        return errors.NoNode.Quoted(skill=child)
    if isinstance(child, SkillClass):
        return errors.NoNode.SkillClass(skill=child.__name__)
    if isinstance(child, (list, tuple)):
        return errors.NoNode.List()
    if callable(child):
        return errors.NoNode.Call()
    return None
