"""A child of a compound skill: SkiROS2's `SkillWrapper` with arbitrary keys.

SkiROS2 renames keys one after the other, and drops a new name that is the old name of another
parameter. So it cannot swap two names, nor give one individual to two parameters. Here the keys of
a child are all renamed at once.

If a parameter has a default, SkiROS2 never takes a value from the blackboard, and writes the
default there. Here a passed value is taken, and a default stays with the child.

In SkiROS2, a child without a named implementation gets the label of its first implementation, so
SkiROS2 never tries another one. Here such a child has no label until it starts.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from copy import deepcopy
from functools import lru_cache
from types import SimpleNamespace
from typing import Any

from ezskiros.hosts.skiros2_api import api
from ezskiros.hosts.skiros2_tree import HostedCall

_BETWEEN = "\0"
"""The prefix of the keys of conditions during renaming."""


class HostedChild:
    """The EzSkiROS part of a `SkillWrapper`. `keys` maps the keys of the child to blackboard keys.
    `users` has the started instances of the user's classes, by class.
    """

    _params: Any
    _instance: Any = SimpleNamespace(onEnd=lambda: True)
    """A placeholder: SkiROS2 ends a child that could not start, and would otherwise never tick
    again.
    """
    _children: list[Any]
    _state: Any

    def __init__(self, call: HostedCall, label: str, instanciator: Any) -> None:
        self.keys: dict[str, str] = {}
        self.users: dict[type, Any] = {}
        self._call = call
        super().__init__(f"skiros:{call.type}", label, instanciator)  # type: ignore[call-arg]
        self.keys = dict(call.keys)
        self._found_out = dict(call.found_out)
        self._defaults: dict[str, Any] = {}
        self._rename()

    def _rename(self) -> None:
        """Rename the keys of parameters and conditions from those of the child to the shared ones.

        SkiROS2 makes this the description of the child when the child gets its implementation.
        """
        named = self._params.getParamMap()
        for key, value in self._call.values.items():
            named[key].makeDefault(value)
        for key in self._call.passed:
            parameter = named[key]
            if parameter.hasSpecifiedDefault() and not parameter.dataTypeIs(api().Element):
                self._defaults[key] = parameter.defaults
                parameter._default = []  # noqa: SLF001 - SkiROS2 has no method that takes it away
                parameter.setDefault()
        renamed: dict[str, Any] = {}
        for key, parameter in named.items():
            renamed.setdefault(self.keys.get(key, key), parameter)
        self._params.reset(renamed)
        for condition in self._all_conditions():
            _rename(condition, self.keys)

    def _all_conditions(self) -> Iterable[Any]:
        for kind in ("pre", "hold", "post"):
            yield from getattr(self, f"_{kind}_conditions")

    def rename(self, condition: Any) -> None:
        """Rename the keys of a condition of the implementation to the shared ones."""
        _rename(condition, self.keys)

    # --- called by SkiROS2 ------------------------------------------------------------------------

    @property
    def label(self) -> str:
        """The implementation of the child; empty if any implementation may be chosen."""
        is_idle = self._state in (api().State.Uninitialized, api().State.Idle)
        return "" if self._call.is_choice and is_idle else super().label  # type: ignore[misc]

    def setInstance(self, instance: Any) -> None:  # noqa: N802 - as in SkiROS2
        """Set the implementation. The children of a previous implementation are dropped."""
        if instance is not self._instance:
            self._children = []
        super().setInstance(instance)  # type: ignore[misc]

    def onStart(self) -> Any:  # noqa: N802 - as in SkiROS2
        """Start the implementation, which may be shared with other nodes."""
        self._instance.child = self
        for shared in self._found_out.values():
            self._params.getParamMap().pop(shared, None)
        return super().onStart()  # type: ignore[misc]

    def specifyParams(self, *arguments: Any, **options: Any) -> None:  # noqa: N802
        """Take values from the blackboard. A parameter without a value there gets its default."""
        super().specifyParams(*arguments, **options)  # type: ignore[misc]
        named = self._params.getParamMap()
        for key, default in self._defaults.items():
            parameter = named[self.keys[key]]
            if not parameter.isSpecified():
                parameter.setValues(default)

    def checkPostCond(self, verbose: bool = False) -> Any:  # noqa: N802
        """Called when the child has succeeded. Without a finding, other children get its
        outputs.
        """
        broken = super().checkPostCond(verbose)  # type: ignore[misc]
        if not broken:
            named = self._params.getParamMap()
            for own, shared in self._found_out.items():
                named[shared] = deepcopy(named[self.keys[own]])
        return broken

    def remap(self, initial_key: str, target_key: str, record: bool = True) -> None:  # noqa: ARG002
        """Rename a blackboard key, because a skill above renames it."""
        for known in (self.keys, self._found_out):
            known.update({own: target_key for own, key in known.items() if key == initial_key})
        named = self._params.getParamMap()
        if initial_key in named:
            named[target_key] = named.pop(initial_key)
        for condition in self._all_conditions():
            _rename(condition, {initial_key: target_key})
        for child in self._children:
            child.remap(initial_key, target_key)

    def getParamsNoRemaps(self) -> Any:  # noqa: N802
        """The parameters by the keys of the child."""
        found = api().ParamHandler()
        named = self._params.getParamMap()
        own = {key: deepcopy(named[shared]) for key, shared in self.keys.items() if shared in named}
        others = {key: deepcopy(each) for key, each in named.items() if key not in self._shared()}
        found.reset({**others, **own})
        return found

    def _copyInstanceParams(self) -> None:  # noqa: N802
        """Take over the outputs of the implementation."""
        for key, found in self._instance.params.getParamMap().items():
            shared = self.keys.get(key, key)
            if self._params.hasParam(shared):
                self._params.specify(shared, found.getValues())

    def _shared(self) -> set[str]:
        return set(self.keys.values())


def _rename(condition: Any, keys: Mapping[str, str]) -> None:
    """Rename all keys of a condition at once, because new names may be old names of other keys."""
    changed = {key: new for key, new in keys.items() if key != new}
    for key in changed:
        condition.remap(key, _BETWEEN + key)
    for key, new in changed.items():
        condition.remap(_BETWEEN + key, new)


@lru_cache(maxsize=1)
def _child_class() -> Any:
    return type("Child", (HostedChild, api().SkillWrapper), {})


def child(call: HostedCall, label: str, instanciator: Any) -> Any:
    """A child for a SkiROS2 tree. Raises `LookupError` if SkiROS2 would run another skill."""
    module = type(instanciator.get_description(f"skiros:{call.type}")).__module__
    if module != call.module:
        raise LookupError(
            f"SkiROS2 takes the skill `{call.type}` of `{module}`, which comes first, not that of "
            f"`{call.module}`: give one of them another name"
        )
    return _child_class()(call, label, instanciator)
