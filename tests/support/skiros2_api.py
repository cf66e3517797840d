"""Stand-ins for SkiROS2's Python API: they record what a description stores, as plain data."""
# ruff: noqa: ARG002, N802

from __future__ import annotations

import enum
import importlib
import importlib.abc
import importlib.machinery
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from types import ModuleType
from typing import Any, ClassVar

from ezskiros.hosts.skiros2_form import (
    IMPLICIT_ROBOT,
    Form,
    FormCondition,
    FormParameter,
    any_of,
    options_of,
)

ParamTypes = enum.Enum("ParamTypes", "Required Optional Inferred")
ParamOptions = enum.Enum("ParamOptions", "Consume Output Unspecify Lock RespectType")
State = enum.Enum("State", "Success Failure Running Idle Uninitialized")


class Element:
    """An individual of which the class is known."""

    def __init__(self, etype: str = "Unknown", elabel: str = "", eid: str = "") -> None:
        self.type, self.label, self.id = etype, elabel, eid


class Or:
    """An `or`, to which conditions are added; it is what it is when the description ends."""

    def __init__(self, is_true: bool) -> None:
        self._is_true = is_true
        self._parts: list[object] = []

    def addCondition(self, condition: object) -> None:
        self._parts.append(condition)

    def form(self) -> FormCondition:
        return any_of(map(_form, self._parts), is_true=self._is_true)


def _form(condition: object) -> FormCondition:
    found = condition.form() if isinstance(condition, Or) else condition
    assert isinstance(found, FormCondition)
    return found


def _full(name: str) -> str:
    """SkiROS2 takes names without a prefix for its own."""
    prefix, _, rest = name.rpartition(":")
    return f"{prefix or 'skiros'}:{rest}"


class SkillDescription:
    """Records what `createDescription` says."""

    def __init__(self) -> None:
        self._params: dict[str, FormParameter] = {}
        self._pre_conditions: list[object] = []
        self._hold_conditions: list[object] = []
        self._post_conditions: list[object] = []
        self.createDescription()

    def createDescription(self) -> None:
        """Says nothing by itself."""

    def addParam(
        self,
        key: str,
        value: Any,
        param_type: enum.Enum,
        options: Iterable[Any] = (),
        description: str = "",
    ) -> None:
        if isinstance(value, Element):
            kind, default = _full(value.type), None
        elif isinstance(value, type):
            kind, default = value.__name__, None
        elif isinstance(value, list):
            kind, default = f"list of {type(value[0]).__name__}", str(value)
        else:
            kind, default = type(value).__name__, value
        self._params[key] = FormParameter(key, param_type.name, kind, default)
        if isinstance(value, Element):
            names = [getattr(each, "name", each) for each in options]
            for place, condition in options_of(key, kind, names):
                getattr(self, f"_{place}_conditions").append(condition)

    def addPreCondition(self, condition: object) -> None:
        self._pre_conditions.append(condition)

    def addHoldCondition(self, condition: object) -> None:
        self._hold_conditions.append(condition)

    def addPostCondition(self, condition: object) -> None:
        self._post_conditions.append(condition)

    def getOrCond(self, desired_state: bool) -> Or:
        return Or(desired_state)

    def getRelationCond(self, clabel, olabel, subj, obj, desired_state):  # type: ignore[no-untyped-def]
        return FormCondition("getRelationCond", (_full(olabel), subj, obj, desired_state))

    def getAbstractRelationCond(self, clabel, olabel, subj, obj, desired_state):  # type: ignore[no-untyped-def]
        return FormCondition("getAbstractRelationCond", (_full(olabel), subj, obj, desired_state))

    def getPropCond(self, clabel, olabel, subj, operator, value, desired_state):  # type: ignore[no-untyped-def]
        return FormCondition("getPropCond", (_full(olabel), subj, operator, value, desired_state))

    def getHasPropCond(self, clabel, olabel, subj, desired_state):  # type: ignore[no-untyped-def]
        return FormCondition("getHasPropCond", (_full(olabel), subj, desired_state))

    def getOnTypeCond(self, clabel, subj, value):  # type: ignore[no-untyped-def]
        return FormCondition("getOnTypeCond", (subj, _full(value)))

    def getIsSpecifiedCond(self, clabel, subj, desired_state):  # type: ignore[no-untyped-def]
        return FormCondition("getIsSpecifiedCond", (subj, desired_state))

    def getGenerateCond(self, clabel, subj, desired_state):  # type: ignore[no-untyped-def]
        return FormCondition("getGenerateCond", (subj, desired_state))

    def form(self) -> Form:
        """All that was recorded."""
        parameters = {**self._params}
        parameters.setdefault("Robot", IMPLICIT_ROBOT)
        lists = (self._pre_conditions, self._hold_conditions, self._post_conditions)
        pre, hold, post = (tuple(map(_form, each)) for each in lists)
        return Form(type(self).__name__, tuple(parameters.values()), pre, hold, post)


def _class_of(maker: str) -> Callable[..., object]:
    """A class of conditions: called, it gives what the method gives."""
    return lambda *arguments, **named: getattr(SkillDescription, maker)(None, *arguments, **named)


_OWN: dict[str, object] = {
    "ParamTypes": ParamTypes,
    "ParamOptions": ParamOptions,
    "State": State,
    "Element": Element,
    "SkillDescription": SkillDescription,
    "ConditionRelation": _class_of("getRelationCond"),
    "AbstractConditionRelation": _class_of("getAbstractRelationCond"),
    "ConditionProperty": _class_of("getPropCond"),
    "ConditionHasProperty": _class_of("getHasPropCond"),
    "ConditionOnType": _class_of("getOnTypeCond"),
    "ConditionIsSpecified": _class_of("getIsSpecifiedCond"),
    "ConditionGenerate": _class_of("getGenerateCond"),
    "ConditionOr": Or,
}


class Other:
    """A stand-in for all other classes of SkiROS2, which stores its arguments."""

    def __init__(self, *given: Any) -> None:
        self.given = given


class _Module(ModuleType):
    """A module of SkiROS2: it has what descriptions need, and a class for any other name."""

    __path__: ClassVar[list[str]] = []  # type: ignore[misc]

    def __getattr__(self, name: str) -> Any:
        if name == "__all__":
            return [*_OWN, "PrimitiveBase", "SkillBase"]
        if name.startswith("__"):
            raise AttributeError(name)
        if name.islower():
            return importlib.import_module(f"{self.__name__}.{name}")
        found = _OWN.get(name) or type(name, (Other,), {})
        setattr(self, name, found)
        return found


class _Finder(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    def find_spec(
        self, name: str, path: object, target: object = None
    ) -> importlib.machinery.ModuleSpec | None:
        if not name.startswith("skiros2"):
            return None
        return importlib.machinery.ModuleSpec(name, self, is_package=True)

    def create_module(self, spec: importlib.machinery.ModuleSpec) -> ModuleType:
        return _Module(spec.name)

    def exec_module(self, module: ModuleType) -> None:
        pass


@contextmanager
def installed() -> Iterator[None]:
    """Within, `import skiros2_skill` and its like find the stand-ins."""
    finder = _Finder()
    sys.meta_path.insert(0, finder)
    try:
        yield
    finally:
        sys.meta_path.remove(finder)
        for name in [name for name, module in sys.modules.items() if isinstance(module, _Module)]:
            del sys.modules[name]
