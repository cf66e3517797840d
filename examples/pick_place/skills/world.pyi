# Written by `ezskiros stubs`. Change the ontology instead.
# ruff: noqa
# fmt: off
# mypy: disable-error-code="assignment, misc, override"
# pyright: reportIncompatibleMethodOverride=false, reportIncompatibleVariableOverride=false
"""The ontology, for type checkers."""

from builtins import bool as _bool, float as _float, int as _int, str as _str
from typing import Generic as _Generic, Literal as _Literal, NoReturn as _Nothing
from typing import TypeAlias as _TypeAlias, TypeVar as _TypeVar

from ezskiros.ontology.model import Individual as _Individual
from ezskiros.ontology.symbols import Condition as _Condition

_T = _TypeVar("_T")
_N = _TypeVar("_N")

class _Value(_Condition, _Generic[_T]):
    """A data property. Alone, it is the condition that a value exists."""
    def __eq__(self, value: _T, /) -> _Condition: ...
    def __ne__(self, value: _T, /) -> _Condition: ...
    def __lt__(self, value: _Nothing, /) -> _Condition: ...
    def __le__(self, value: _Nothing, /) -> _Condition: ...
    def __gt__(self, value: _Nothing, /) -> _Condition: ...
    def __ge__(self, value: _Nothing, /) -> _Condition: ...

class _Ordered(_Value[_T], _Generic[_T, _N]):
    """A data property with numbers."""
    def __lt__(self, value: _N, /) -> _Condition: ...
    def __le__(self, value: _N, /) -> _Condition: ...
    def __gt__(self, value: _N, /) -> _Condition: ...
    def __ge__(self, value: _N, /) -> _Condition: ...

class _Number(_Ordered[_float, _float]): ...
class _Whole(_Ordered[_int, _int]): ...
class _Text(_Value[_str]): ...
class _Truth(_Value[_bool]): ...
class _Anything(_Ordered[_float | _str | _bool, _float]): ...

class _Ambiguous:
    """Several namespaces have this name: write `namespace.name(Subject, ...)`."""

class _Thing:
    """An individual of the world model."""
    ContainerState: _Value[_Literal["Empty", "Full"]]
    Weight: _Number
    """In kg."""
    def spatiallyRelated(self, other: _Thing, /) -> _Condition: ...

class cora:
    class Robot(_sumo.Device, _sumo.Agent, _sumo.Artifact):
        """A device that acts in the world to accomplish tasks."""

class rparts:
    class ArmDevice(_sumo.Device): ...
    class EndEffector(_sumo.Device): ...
    class GripperEffector(_rparts.EndEffector):
        """An end effector that holds things."""

class scalable:
    class Workstation(_skiros.Location): ...

class skiros:
    class ApproachPose(_skiros.TransformationPose): ...
    class Container(_skiros.Location): ...
    class GraspingPose(_skiros.TransformationPose): ...
    class Location(_sumo.Object):
        """A place for things."""
    class Product(_sumo.Object):
        """An object that a robot handles."""
        def hasA(self, other: _skiros.TransformationPose, /) -> _Condition: ...
    class TransformationPose(_sumo.Object):
        """A pose relative to another thing."""
    @staticmethod
    def ContainerState(subject: _Thing, /) -> _Value[_Literal["Empty", "Full"]]: ...
    @staticmethod
    def Weight(subject: _Thing, /) -> _Number:
        """In kg."""
    @staticmethod
    def at(subject: _sumo.Object, other: _sumo.Object, /) -> _Condition:
        """A thing is at one place at a time."""
    @staticmethod
    def contain(subject: _sumo.Object, other: _sumo.Object, /) -> _Condition:
        """A thing is contained in one other thing at a time."""
    @staticmethod
    def hasA(subject: _skiros.Product, other: _skiros.TransformationPose, /) -> _Condition: ...
    @staticmethod
    def spatiallyRelated(subject: _Thing, other: _Thing, /) -> _Condition: ...

class sumo:
    class Agent(_sumo.Object):
        """Something that acts on its own."""
    class Artifact(_sumo.Object): ...
    class Device(_sumo.Artifact):
        """An artifact that serves a purpose."""
    class Object(_Thing):
        """Something that has a place in space."""
        def at(self, other: _sumo.Object, /) -> _Condition:
            """A thing is at one place at a time."""
        def contain(self, other: _sumo.Object, /) -> _Condition:
            """A thing is contained in one other thing at a time."""

_cora: _TypeAlias = cora
_rparts: _TypeAlias = rparts
_scalable: _TypeAlias = scalable
_skiros: _TypeAlias = skiros
_sumo: _TypeAlias = sumo

class world:
    """All namespaces of the ontology."""
    cora: _TypeAlias = _cora
    rparts: _TypeAlias = _rparts
    scalable: _TypeAlias = _scalable
    skiros: _TypeAlias = _skiros
    sumo: _TypeAlias = _sumo
