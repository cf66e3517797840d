"""The classes that SkiROS2 loads: each combines a class from this module with a SkiROS2 class.

SkiROS2 takes classes without subclasses and identifies them by their bare names. Descriptions have
no subclasses; implementations refer to them.
"""

from __future__ import annotations

import enum
import time
import traceback
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from ezskiros.engine.world_model import WorldModel
from ezskiros.hosts import skiros2_context
from ezskiros.hosts.skiros2_api import api
from ezskiros.hosts.skiros2_children import HostedChild, child
from ezskiros.hosts.skiros2_form import Form, FormCondition, FormParameter, conditions_of, form_of
from ezskiros.hosts.skiros2_processors import processor
from ezskiros.hosts.skiros2_tree import HostedCall, HostedNode, Scope, hosted, raised
from ezskiros.hosts.skiros2_values import HostedValues, give, refresh, taken
from ezskiros.hosts.skiros2_world import HostedWorld
from ezskiros.ontology import Ontology
from ezskiros.skills.implementation import SkillImplementation, State
from ezskiros.skills.interface import Parameter, SkillInterface
from ezskiros.skills.nodes import Flow
from ezskiros.trees.build import build
from ezskiros.trees.library import Library

_BASIC = {each.__name__: each for each in (str, int, float, bool)}


@dataclass(frozen=True)
class HostedSkill:
    """A skill for SkiROS2, and the class of its SkiROS2 description."""

    skill: SkillInterface
    ontology: Ontology
    description: Any


@dataclass(frozen=True)
class HostContext:
    """The context of a running implementation."""

    implementation: type[SkillImplementation]
    hosted: HostedSkill
    library: Library
    own_conditions: tuple[FormCondition, ...]
    """The pre-conditions of the implementation, besides those of its skill."""


class RefusedSkillError(Exception):
    """SkiROS2 requested a refused skill. The text has all findings on the library of the skill."""


def hosted_skill(skill: SkillInterface, ontology: Ontology, module: str) -> HostedSkill:
    """A skill, with a SkiROS2 description that appears to be defined in `module`."""
    docs = {each.key: each.doc for each in skill.parameters}
    parts = {"form": form_of(skill, ontology.model), "docs": docs, "__doc__": skill.doc}
    bases = (Description, api().SkillDescription)
    return HostedSkill(skill, ontology, type(skill.name, bases, {**parts, "__module__": module}))


def host_of(
    implementation: type[SkillImplementation], hosted: HostedSkill, library: Library
) -> HostContext:
    """The context of an implementation that SkiROS2 may load."""
    skill, refined = hosted.skill, library.as_done_by(implementation)
    own = refined.pre[len(skill.pre) :] if refined else ()
    lowered = conditions_of(skill, own, hosted.ontology.model)
    return HostContext(implementation, hosted, library, lowered)


def implementation_class(host: HostContext) -> Any:
    """An implementation as a SkiROS2 class that appears to be defined in its module."""
    found = host.implementation
    bases: tuple[Any, ...] = (Primitive, api().PrimitiveBase)
    if hasattr(found, "expandBT"):
        bases = (Compound, api().SkillBase)
    parts = {"host": host, "__doc__": found.__doc__, "__module__": found.__module__}
    return type(found.__name__, bases, parts)


def refused_class(found: type, text: str) -> Any:
    """The class that SkiROS2 finds in the place of a refused skill."""

    def refuse(_self: object) -> None:
        raise RefusedSkillError(f"`{found.__name__}` was refused\n{text}")

    parts = {"__init__": refuse, "__module__": found.__module__}
    return type(found.__name__, (api().SkillDescription,), parts)


class Description:
    """The EzSkiROS part of a `SkillDescription`, filled from a form."""

    form: ClassVar[Form]
    docs: ClassVar[Mapping[str, str]]
    addParam: Callable[..., None]  # noqa: N815 - as in SkiROS2

    def createDescription(self) -> None:  # noqa: N802 - as in SkiROS2
        """Called by SkiROS2 when it makes a description."""
        for each in self.form.parameters:
            doc = self.docs.get(each.key, "")
            kind = api().ParamTypes[each.kind]
            self.addParam(each.key, _example(each), kind, description=doc)
        for kind_of in ("Pre", "Hold", "Post"):
            for condition in getattr(self.form, kind_of.lower()):
                getattr(self, f"add{kind_of}Condition")(_condition(self, condition))


def _condition(description: Any, found: FormCondition) -> Any:
    """A SkiROS2 condition, made with the methods of a description or an implementation."""
    make = getattr(description, found.maker)
    if found.maker == "getOrCond":
        either = make(*found.arguments)
        for part in found.parts:
            either.addCondition(_condition(description, part))
        return either
    return make(_label(found), *found.arguments)


def _example(parameter: FormParameter) -> Any:
    """The example from which SkiROS2 takes the type of a parameter, and its default."""
    if ":" in parameter.type:
        return api().Element(parameter.type)
    if isinstance(parameter.default, enum.Enum):
        return parameter.default.name
    return _BASIC.get(parameter.type, str) if parameter.default is None else parameter.default


def _label(condition: FormCondition) -> str:
    """The text that SkiROS2 prints for a condition, such as `Gripper at StartPose`."""
    words = [str(each).rpartition(":")[2] for each in condition.arguments]
    if condition.maker in ("getRelationCond", "getAbstractRelationCond", "getPropCond"):
        words[0], words[1] = words[1], words[0]
    return " ".join(words[:-1] if words[-1] == "True" else words)


class Hosted:
    """The EzSkiROS part of any implementation. Its methods call those of an instance of the user's
    class, which a node of a tree keeps.
    """

    host: ClassVar[HostContext]
    setDescription: Callable[..., None]  # noqa: N815
    _setProgress: Callable[[str, int], None]  # noqa: N815
    child: Any = None
    """The node of the tree that runs this implementation, if the node is an EzSkiROS child."""
    running: Running | None = None

    def createDescription(self) -> None:  # noqa: N802
        """Called by SkiROS2 when it loads an implementation."""
        self.setDescription(self.host.hosted.description(), type(self).__name__)
        # SkiROS2 for ROS 1 has no such switch: its planner uses all skills.
        if not self.host.implementation.available_for_planning:
            getattr(self, "setAvailableForPlanning", lambda _is_available: None)(False)

    def modifyDescription(self, skill: Any) -> None:  # noqa: N802
        """Called by SkiROS2 when it loads an implementation, and when a child gets it."""
        for each in self.host.own_conditions:
            condition = _condition(self, each)
            if isinstance(skill, HostedChild):
                skill.rename(condition)
            skill.addPreCondition(condition)

    def onStart(self) -> bool:  # noqa: N802
        """Start with the instance of the node."""
        users = {} if self.child is None else self.child.users
        user = users.get(self.host.implementation)
        is_new = user is None
        if user is None:
            user = self.host.implementation()
        self.running = Running(self.host.hosted, user, self)
        skiros2_context.start(self, self.host.hosted.skill, self.running.values)
        # SkiROS2 calls `onInit` when it loads a primitive, before there is a node of a tree.
        is_willing = not (is_new and self.running.call("onInit", failed=False) is False)
        if is_willing:
            users[self.host.implementation] = user
            is_willing = bool(self.running.call("onStart", failed=False))
        if not is_willing:
            skiros2_context.end(self)
        return is_willing

    def onPreempt(self) -> Any:  # noqa: N802
        """Preempt the running skill."""
        return self.called("onPreempt")

    def onEnd(self) -> bool:  # noqa: N802
        """End the skill, even if it could not start."""
        running, self.running = self.running, None
        has_ended = running is None or bool(running.call("onEnd", failed=False))
        skiros2_context.end(self)
        return has_ended

    def called(self, method: str) -> Any:
        """The state that a method of the user returns."""
        assert self.running is not None, "SkiROS2 starts a skill before it ticks it"
        skiros2_context.live(self)
        found = self.running.call(method, failed=State.FAILURE)
        if isinstance(found, State):
            return api().State(found.value)
        right = "a result of self.success, self.step or self.fail"
        self._setProgress(f"`{method}` returned {found!r}, not {right}", -405)
        return api().State.Failure


class Compound(Hosted):
    """The EzSkiROS part of a `SkillBase`, with the tree of `expandBT`."""

    params: Any
    _instanciator: Any

    def __init__(self) -> None:
        super().__init__()
        self._expand_on_start = True  # the tree may depend on values, which may have changed

    def expand(self, skill: Any) -> None:
        """Build the tree below the SkiROS2 node that runs this skill."""
        known = self.host.hosted.skill
        tree = build(self.host.implementation, known, _values(known, self.params))
        outer = skill.keys if isinstance(skill, HostedChild) else {}
        root = hosted(tree, Scope(known, skill.id, outer), self.host.library)
        if isinstance(root, HostedCall):
            root = HostedNode(Flow.SERIAL_STAR.value, (root,))
        made = processor(root.processor, root.limit)
        skill.setProcessor(skiros2_context.watched(made, self))
        skill(*(_node(each, self) for each in root.children))


def _node(found: HostedNode | HostedCall, compound: Any) -> Any:
    """A SkiROS2 node, made with the methods of the compound."""
    if isinstance(found, HostedNode):
        made = compound.skill(processor(found.processor, found.limit))
        return made(*(_node(each, compound) for each in found.children))
    instanciator = compound._instanciator  # noqa: SLF001 - SkiROS2 hands it to nobody
    label = found.label
    if label is None:
        # Any implementation that SkiROS2 has loaded. Otherwise the first one, or, with a choice,
        # all of them, which SkiROS2 then loads.
        label = ""
        if not instanciator.get_instances(f"skiros:{found.type}"):
            for each in found.known if found.is_choice else found.known[:1]:
                instanciator.add_instance(each)
    return child(found, label, instanciator)


def _values(skill: SkillInterface, params: Any) -> dict[str, Any]:
    """The values of the parameters of a skill, None for a missing value, and the elements of
    individuals.

    Raises `ValueError` for a text that is not a member of an enumeration.
    """
    found = {}
    for each in skill.parameters:
        value = params.getParamValue(each.key)
        if each.is_individual:
            found[each.name] = value if value is not None and value.id else None
        else:
            found[each.name] = raised(value, each)
    return found


class Primitive(Hosted):
    """The EzSkiROS part of a `PrimitiveBase`."""

    checkHoldCond: Callable[[], list[str]]  # noqa: N815
    progress_msg: str
    progress_code: int
    _hold_conditions: list[Any]

    def execute(self) -> Any:
        """Tick once if the hold-conditions hold. SkiROS2 checks them only for compounds."""
        if self._hold_conditions and self.checkHoldCond():
            broken = self.progress_msg, self.progress_code
            self.called("onPreempt")
            self._setProgress(*broken)
            return api().State.Failure
        return self.called("execute")

    def _updateRoutine(self, _since: object) -> None:  # noqa: N802
        """Do not write elements back. The user's code changes the world model itself, and the
        content of an element may be older.
        """


class Running:
    """An instance of the user's class in the SkiROS2 implementation `implementation`."""

    def __init__(self, hosted: HostedSkill, user: SkillImplementation, implementation: Any) -> None:
        self._skill, self._user, self._implementation = hosted.skill, user, implementation
        self._world = HostedWorld(implementation.wmi, hosted.ontology)
        user.world, user.now = WorldModel(self._world), time.monotonic
        user.progress = (0, "")
        # SkiROS2's own attributes, for skills that run only there.
        for name in ("wmi", "_wmi", "node", "_node"):
            if hasattr(implementation, name):
                setattr(user, name, getattr(implementation, name))

    def values(self) -> dict[str, Any]:
        """The values of the parameters; None where SkiROS2 has no valid value."""
        return {each.name: self._value(each) for each in self._skill.parameters}

    def _value(self, parameter: Parameter) -> Any:
        try:
            return taken(parameter, self._implementation.params, self._world)
        except ValueError:
            return None

    def call(self, method: str, *, failed: object) -> Any:
        """Call a method of the user. An exception is reported, and the result is `failed`."""
        user, parameters, world = self._user, self._skill.parameters, self._world
        before = user.progress
        try:
            params = self._implementation.params
            known = {each.name: taken(each, params, world) for each in parameters}
            values = user.params = HostedValues(self._skill, known)
            found = getattr(user, method)()
            for parameter, value in values.found_out.items():
                give(parameter, value, params, world)
            refresh(parameters, params, world)
        except (Exception, SystemExit) as problem:
            api().log.error(type(self._implementation).__name__, traceback.format_exc())
            user.fail(f"`{method}` raised {type(problem).__name__}: {problem}")
            found = failed
        if user.progress != before:
            code, text = user.progress
            self._implementation._setProgress(text, code)  # noqa: SLF001 - as its own methods do
        return found
