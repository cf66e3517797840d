"""The behavior trees of an implementation, as data."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, cast

from dslkit.source import Span
from ezskiros.ontology.symbols import Described
from ezskiros.skills.growing import times
from ezskiros.skills.implementation import SkillImplementation
from ezskiros.skills.interface import Parameter, SkillInterface
from ezskiros.skills.markers import ParameterKind
from ezskiros.skills.nodes import Node
from ezskiros.skills.values import SymbolicValue, decided, plain


class IndividualReference(Described):
    """A parameter of the compound that stands for an individual: `params.GraspPose`.

    A parameter that may have no value can be tested: `if params.Start:`.
    """

    def __init__(self, parameter: Parameter) -> None:
        self.parameter = parameter

    def __bool__(self) -> bool:
        may_be_nothing = self.parameter.kind is ParameterKind.OPTIONAL or self.parameter.is_output
        return decided(self) if may_be_nothing else True

    def __call__(self, *_arguments: object, **_named: object) -> None:
        """Raise `TypeError`: an individual cannot be used before the robot runs."""
        raise TypeError(f"`{self!r}` is an individual and cannot be called")

    def described(self) -> str:
        """The description, for messages."""
        return f"the parameter `{self.parameter.name}`, a {self.parameter.type!r}"

    def __repr__(self) -> str:
        return f"params.{self.parameter.name}"


class ValueReference(SymbolicValue):
    """A parameter of the compound for a value: `params.Speed`."""

    def __init__(self, parameter: Parameter) -> None:
        super().__init__(parameter.name, parameter.type)
        self.parameter = parameter


class KnownIndividual(IndividualReference):
    """A parameter of the compound for an individual, if it is known whether it has a value."""

    def __init__(self, parameter: Parameter, is_there: bool) -> None:
        super().__init__(parameter)
        self._is_there = is_there

    def __bool__(self) -> bool:
        return self._is_there


class KnownReference(ValueReference):
    """A parameter of the compound with a known value, which branches and operators use."""

    def __init__(self, parameter: Parameter, value: object) -> None:
        super().__init__(parameter)
        self.value = value

    def __plain__(self) -> object:
        return self.value

    def __bool__(self) -> bool:
        return bool(self.value)

    def __iter__(self) -> Any:
        return iter(self.value)  # type: ignore[call-overload]

    def __str__(self) -> str:
        return str(self.value)

    def __contains__(self, part: object) -> bool:
        return operator.contains(self.value, plain(part))  # type: ignore[arg-type]

    def _times(self, other: object) -> Any:
        if isinstance(other, (list, tuple)):
            return times(other, cast("int", self.value))
        return operator.mul(cast("Any", self.value), plain(other))

    __mul__ = __rmul__ = _times

    def __getattr__(self, name: str) -> Any:
        return getattr(self.value, name)

    def __hash__(self) -> int:
        return hash(self.value)


def _operate(name: str) -> None:
    """Add an operator to references, with its reflected version if there is one."""
    of_values: Callable[..., object] = getattr(operator, name)

    def operated(*operands: object) -> object:
        return of_values(*map(plain, operands))

    def reflected(own: object, other: object) -> object:
        return of_values(plain(other), plain(own))

    setattr(KnownReference, f"__{name}__", operated)
    if hasattr(int, f"__r{name}__"):
        setattr(KnownReference, f"__r{name}__", reflected)


for _name in (
    *("add", "sub", "truediv", "floordiv", "mod", "pow", "neg", "pos", "abs"),
    *("lt", "le", "gt", "ge", "eq", "ne", "getitem"),
):
    _operate(_name)


Reference = IndividualReference | ValueReference


def reference(parameter: Parameter, known: Mapping[str, object]) -> Reference:
    """The reference to a parameter in `expandBT`, given the known values; None for a known
    parameter without a value.
    """
    is_known, value = parameter.name in known, known.get(parameter.name)
    if parameter.is_individual:
        return (
            KnownIndividual(parameter, value is not None)
            if is_known
            else IndividualReference(parameter)
        )
    return KnownReference(parameter, value) if is_known else ValueReference(parameter)


@dataclass(frozen=True)
class Tree:
    """One tree of a compound skill. There are several trees if `expandBT` branches."""

    owner: type[SkillImplementation]
    skill: SkillInterface
    root: Node
    span: Span
    """The place of the implementation's name."""
    branch: tuple[tuple[Span, bool], ...] = ()
    """The conditions on the path to the tree, in order, with their results."""
    given: frozenset[str] = frozenset()
    """The parameters that have a value by these conditions."""

    @property
    def implementation(self) -> str:
        """The name of the implementation."""
        return self.owner.__name__
