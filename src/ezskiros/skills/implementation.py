"""The class behind `Pick.SkillBase`, the base class of implementations."""

from __future__ import annotations

import difflib
import enum
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar

from dslkit.diagnostics import DidYouMean, Remark
from ezskiros import session
from ezskiros.ontology.symbols import UNKNOWN, UnknownValue, described
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
        """A running instance. In a behavior tree, this call is a mistake: trees name skills
        instead.
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

    A compound has the method `expandBT`, which builds its behavior tree (thesis, Paper IV, listing
    7). The children of a processor are skills, processors and decorators, with any nesting.
    Processors treat the results of their children like the SkiROS2 processors of the same names.
    """

    description: ClassVar[SkillClass]
    """The implemented skill."""
    available_for_planning: ClassVar[bool] = True
    """True if a task planner may use the implementation. Set `available_for_planning = False` for
    skills that only trees and people use.
    """
    params: Any
    """The values of the parameters during the run: `self.params.Speed`. Set outputs:
    `self.params.Force = 3.5`.
    """
    world: Any
    """The world model during a run in the engine: `self.world.relate(tray, skiros.contain,
    nut)`.
    """
    now: Any
    """The time in seconds, by the clock of the engine during the run: `self.now()`."""
    pre_conditions: Any
    """The optional method `conditions(self, Door)` adds pre-conditions of only this implementation:
    `self.pre_conditions += Door.Open == False`.
    """
    progress: tuple[int, str] = (0, "")
    """The progress, as a number of the implementation's choice, and a text."""

    if not TYPE_CHECKING:  # type checkers see only the declared attributes

        def __getattr__(self, name: str) -> Any:
            """Report an unknown attribute in a behavior tree, with a similar one."""
            if not is_growing() or name.startswith("__"):
                kind = type(self).__name__
                raise AttributeError(f"{kind!r} object has no attribute {name!r}")
            found = errors.UnknownProcessor(implementation=type(self).__name__, spelled=name)
            session.report(found.at(session.here(), help=_help_for(name)))
            return Nowhere()

    # --- primitives -------------------------------------------------------------------------------

    def onInit(self) -> bool | None:  # noqa: N802 - as in SkiROS2
        """Called once, before the first `onStart`. If it returns `False`, the skill cannot
        start.
        """
        return True

    def onStart(self) -> bool:  # noqa: N802
        """Called before the first `execute`. Return True if the skill can start."""
        return True

    def onPreempt(self) -> State:  # noqa: N802
        """Called when the running skill is preempted."""
        return self.fail("stopped", -406)

    def onEnd(self) -> bool:  # noqa: N802
        """Called after the last `execute`, or after `onPreempt`. Return True on success."""
        return True

    def success(self, text: str = "") -> State:
        """Report success. Return this result from `execute`."""
        return self._reported(State.SUCCESS, self.progress[0] + 1, text)

    def step(self, text: str = "") -> State:
        """Report progress. `execute` returns this result, and is called again at the next tick."""
        return self._reported(State.RUNNING, self.progress[0] + 1, text)

    def fail(self, text: str, code: int = -405) -> State:
        """Report failure. Return this result from `execute`. `code` is made negative."""
        return self._reported(State.FAILURE, -abs(code), text)

    def _reported(self, state: State, code: int, text: str) -> State:
        self.progress = (code, text)
        return state

    # --- compounds --------------------------------------------------------------------------------

    @maker
    def serial(self, *children: Node) -> Node:
        """Run children one after the other until one fails; restart with the first on each tick."""
        return _processor(Flow.SERIAL, children)

    @maker
    def serialstar(self, *children: Node) -> Node:
        """Run children one after the other until one fails; finished children are not
        ticked again.
        """
        return _processor(Flow.SERIAL_STAR, children)

    @maker
    def selector(self, *children: Node) -> Node:
        """Run children one after the other until one succeeds; restart with the first on each
        tick.
        """
        return _processor(Flow.SELECTOR, children)

    @maker
    def selectorstar(self, *children: Node) -> Node:
        """Run children one after the other until one succeeds; failed children are not ticked
        again.
        """
        return _processor(Flow.SELECTOR_STAR, children)

    @maker
    def parallelff(self, *children: Node) -> Node:
        """Run all children at once until all succeed. The first failing child stops the others."""
        return _processor(Flow.PARALLEL_FF, children)

    @maker
    def parallelfs(self, *children: Node) -> Node:
        """Run all children at once until the first has a result, which is the result of all."""
        return _processor(Flow.PARALLEL_FS, children)

    @maker
    def nofail(self, *children: Node) -> Node:
        """Run children one after the other. A failure counts as success."""
        return _processor(Flow.NO_FAIL, children)

    @maker
    def inverter(self, child: Node) -> Node:
        """Exchange success and failure of a child."""
        return _decorator(Decoration.INVERTER, child, None)

    @maker
    def retry(self, child: Node, count: int) -> Node:
        """Restart a failed child, for at most `count` tries in all. `count` may be
        `params.Count`.
        """
        return _decorator(Decoration.RETRY, child, count)

    @maker
    def timeout(self, child: Node, seconds: float) -> Node:
        """Fail if a child has no result after some seconds, which may be `params.Seconds`."""
        return _decorator(Decoration.TIMEOUT, child, seconds)


MAKERS = tuple(each.value.lower() for each in (*Flow, *Decoration))
"""The methods that make processors and decorators."""
_ELSEWHERE = {
    "sequence": "serialstar",
    "sequential": "serialstar",
    "fallback": "selectorstar",
    "parallel": "parallelff",
}
"""Names of the same processors in other libraries."""


def _help_for(name: str) -> Remark:
    """The help for an unknown attribute of `self` in `expandBT`."""
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
    if not children and not has_decided():  # a loop that depends on a value may have no child
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
"""The types of the limits of decorators: the tries of a retry, and the seconds of a timeout."""


def _can_limit(limit: object, kinds: tuple[type, ...]) -> bool:
    """Say whether a limit is a finite number above 0, or can become one when the skill runs."""
    if isinstance(limit, SymbolicValue):
        return limit.__may_be__(kinds)
    return type(limit) in kinds and 0 < limit < math.inf  # type: ignore[operator]


def _is_node(child: object) -> bool:
    """Say whether an object can be part of a tree. If not, report it."""
    if isinstance(child, Node):
        return True
    if not isinstance(child, UnknownValue):
        found = errors.NoNode(found=described(child))
        session.report(found.at(session.here(), help=_help_for_child(child)))
    if isinstance(child, (list, tuple)):
        drop(child)
    return False


def _help_for_child(child: object) -> Remark | None:
    """The help for an object that is not a child, if the intention is clear."""
    if isinstance(child, str) and child.isidentifier():
        return errors.NoNode.Quoted(skill=child)
    if isinstance(child, SkillClass):
        return errors.NoNode.SkillClass(skill=child.__name__)
    if isinstance(child, (list, tuple)):
        return errors.NoNode.List()
    if callable(child):
        return errors.NoNode.Call()
    return None
