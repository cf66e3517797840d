"""Classes of the ontology as Python classes, and symbols: individuals with a known class and
unknown identity.

A symbol records the conditions about it. Its attributes are the relations and data properties of
the ontology: `Gripper.at(StartPose)`, `Gripper.ContainerState == "Empty"`. The results are
conditions, which have no truth value before the robot runs.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from contextvars import ContextVar
from typing import Any, Protocol, cast

from dslkit.source import Span
from ezskiros import session
from ezskiros.ontology import condition_errors as errors
from ezskiros.ontology.statements import (
    AnyOf,
    HasProperty,
    Relation,
    Statement,
    Value,
    ValueComparison,
    negated,
)


class Vocabulary(Protocol):
    """The part of the ontology that classes and symbols need."""

    def attribute(self, individual: Thing, name: str) -> Any:
        """The value of an attribute of a symbol."""
        ...


class Described(ABC):
    """An object that can describe itself in a message."""

    @abstractmethod
    def described(self) -> str:
        """A description, such as `the parameter Speed`."""


class OntologyClass(type):
    """The type of all classes of an ontology.

    Its attributes belong to classes only, because instances have the names of the ontology.
    """

    __iri__: str
    __vocabulary__: Vocabulary

    @property
    def iri(cls) -> str:
        """The IRI of the class."""
        return cls.__iri__

    @property
    def vocabulary(cls) -> Vocabulary:
        """The ontology of the class."""
        return cls.__vocabulary__

    def __repr__(cls) -> str:
        return cls.__qualname__


class SameClass(OntologyClass):
    """The type of a class that is equivalent to its base class: members of the base class are
    members of it.
    """

    def __subclasscheck__(cls, other: type) -> bool:
        return issubclass(other, cls.__mro__[1])

    def __instancecheck__(cls, individual: object) -> bool:
        return isinstance(individual, cls.__mro__[1])


class Thing(metaclass=OntologyClass):
    """The class of all individuals, `owl:Thing`. Instances are symbols, made by `symbol`."""

    __name: str

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return type(self).vocabulary.attribute(self, name)

    def __setattr__(self, name: str, value: object) -> None:
        found = errors.Assigned(subject=repr(self), spelled=name, found=described(value))
        session.report(found.at(session.here()))

    def __repr__(self) -> str:
        return self.__name

    def __bool__(self) -> bool:
        session.report(errors.IndividualAsCondition(parameter=self.__name).at(session.here()))
        return True


def ontology_class(
    name: str,
    bases: tuple[type, ...],
    texts: dict[str, str | None],
    iri: str,
    vocabulary: Vocabulary,
) -> OntologyClass:
    """Make a class of an ontology."""
    return OntologyClass(name, bases, {**texts, "__iri__": iri, "__vocabulary__": vocabulary})


def symbol(owl_class: OntologyClass, name: str) -> Thing:
    """The symbol for the individual of the parameter `name`."""
    found = cast("Thing", object.__new__(cast("type[object]", owl_class)))
    object.__setattr__(found, "_Thing__name", name)
    return found


class UnknownValue:
    """A stand-in for a faulty value that has been reported, so that the check can continue."""

    def __getattr__(self, name: str) -> UnknownValue:
        if name.startswith("__"):
            raise AttributeError(name)
        return self

    def __call__(self, *_arguments: object, **_named: object) -> UnknownValue:
        """Return itself, so that the check can continue."""
        return self

    def _same(self, _other: object = None) -> UnknownValue:
        return self

    def _equal(self, other: object) -> UnknownValue | bool:
        # `typing` tests whether its argument is one of its own classes.
        return False if isinstance(other, type) else self

    def __iter__(self) -> Iterator[UnknownValue]:
        return iter(())

    __invert__ = __or__ = __ror__ = __lt__ = __le__ = __gt__ = __ge__ = __getitem__ = _same
    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = __neg__ = _same
    __truediv__ = __rtruediv__ = _same
    __eq__ = _equal  # type: ignore[assignment]
    __ne__ = _same  # type: ignore[assignment]
    __hash__ = object.__hash__


UNKNOWN = UnknownValue()


class Condition:
    """A statement about the world, to be added to the conditions of a skill.

    `~condition` is the negation; `first | second` holds if one of the two holds.
    """

    def __init__(self, statement: Statement, span: Span) -> None:
        self.statement = statement
        self.span = span

    def __invert__(self) -> Condition | UnknownValue:
        span = session.here()
        opposite = negated(self.statement)
        if opposite is None:
            session.report(errors.NoOpposite().at(span))
            return UNKNOWN
        return Condition(opposite, span)

    def __or__(self, other: object) -> Condition | UnknownValue:
        span = session.here()
        if isinstance(other, UnknownValue):
            return other
        if not isinstance(other, Condition):
            session.report(errors.NoCondition(found=described(other)).at(span))
            return UNKNOWN
        return Condition(AnyOf((*_parts(self.statement), *_parts(other.statement))), span)

    def _compared_as_a_whole(self, _other: object) -> Condition | UnknownValue:
        session.report(errors.NeedsBrackets().at(session.here()))
        return UNKNOWN

    __lt__ = __le__ = __gt__ = __ge__ = _compared_as_a_whole

    def __bool__(self) -> bool:
        session.report(errors.NoTruthValue().at(self.span))
        _asked.set(session.here())
        return True


_asked: ContextVar[Span | None] = ContextVar("asked", default=None)
"""The place where Python last evaluated the truth value of a condition."""


def is_asked_here() -> bool:
    """Say whether Python has evaluated the truth value of a condition in the current expression of
    the user's code, so that the result is only a part of the expression.
    """
    asked = _asked.get()
    return asked is not None and session.here().contains(asked)


def _parts(statement: Statement) -> tuple[Statement, ...]:
    """The alternatives of a statement."""
    return statement.parts if isinstance(statement, AnyOf) and statement.is_true else (statement,)


class RelationOf:
    """A relation of an individual, to be called with the related individual."""

    def __init__(self, subject: Thing, iri: str, name: str) -> None:
        self._subject, self._iri, self._name = subject, iri, name

    def __call__(self, *objects: object) -> Condition | UnknownValue:
        """The condition that the individual has this relation to another one."""
        span = session.here()
        if len(objects) != 1:
            found_count = errors.OneObject(
                relation=self._name, subject=repr(self._subject), count=len(objects)
            )
            session.report(found_count.at(span))
            return UNKNOWN
        (found,) = objects
        if isinstance(found, UnknownValue):
            return found
        if not isinstance(found, Thing):
            session.report(
                errors.NoIndividual(relation=self._name, found=described(found)).at(span)
            )
            return UNKNOWN
        return Condition(Relation(repr(self._subject), self._iri, repr(found)), span)

    def report_not_called(self, span: Span) -> None:
        """Report a relation without its arguments."""
        found = errors.NotCalled(relation=self._name, subject=repr(self._subject))
        session.report(found.at(span))

    def _by_itself(self, _other: object = None) -> UnknownValue:
        self.report_not_called(session.here())
        return UNKNOWN

    def __bool__(self) -> bool:
        self.report_not_called(session.here())
        return True

    __invert__ = __or__ = __ror__ = __lt__ = __le__ = __gt__ = __ge__ = _by_itself
    __eq__ = __ne__ = _by_itself  # type: ignore[assignment]
    __hash__ = None  # type: ignore[assignment]


class ValueOf(Condition):
    """A data property of an individual. As a condition, it requires that a value exists."""

    def __init__(self, subject: Thing, iri: str, name: str, span: Span) -> None:
        super().__init__(HasProperty(repr(subject), iri), span)
        self._subject, self._iri, self._property = subject, iri, name

    def __call__(self, *_objects: object) -> UnknownValue:
        """Report a call, which data properties do not allow."""
        found = errors.NoRelation(property=self._property, subject=repr(self._subject))
        session.report(found.at(session.here()))
        return UNKNOWN

    def _compared(self, operator: str, value: object) -> Condition | UnknownValue:
        span = session.here()
        if isinstance(value, UnknownValue):
            return value
        if not isinstance(value, (str, int, float, bool)) or depends_on_symbol(value):
            session.report(errors.NoValue(property=self._property, found=described(value)).at(span))
            return UNKNOWN
        return Condition(self._statement(operator, value), span)

    def _statement(self, operator: str, value: Value) -> ValueComparison:
        is_true = operator != "!="
        return ValueComparison(
            repr(self._subject), self._iri, operator if is_true else "=", value, is_true
        )

    def __eq__(self, value: object) -> Condition | UnknownValue:  # type: ignore[override]
        return self._compared("=", value)

    def __ne__(self, value: object) -> Condition | UnknownValue:  # type: ignore[override]
        return self._compared("!=", value)

    def __lt__(self, value: object) -> Condition | UnknownValue:
        return self._compared("<", value)

    def __le__(self, value: object) -> Condition | UnknownValue:
        return self._compared("<=", value)

    def __gt__(self, value: object) -> Condition | UnknownValue:
        return self._compared(">", value)

    def __ge__(self, value: object) -> Condition | UnknownValue:
        return self._compared(">=", value)

    __hash__ = None  # type: ignore[assignment]


SYMBOL_IN_TEXT = "\ufdd0"
"""The mark in texts that were made from symbols. It is a Unicode noncharacter, so users' texts do
not have it.
"""


def depends_on_symbol(value: object) -> bool:
    """Say whether a value is a string that is unknown before the skill runs."""
    return isinstance(value, str) and SYMBOL_IN_TEXT in value


def described(value: object) -> str:
    """Describe an object, for a message."""
    if depends_on_symbol(value):
        return "a string that is unknown before the skill runs"
    if isinstance(value, Thing):
        return f"the parameter `{value!r}`"
    if isinstance(value, OntologyClass):
        return f"the class {value!r}"
    if isinstance(value, RelationOf):
        return "a relation without its arguments"
    if isinstance(value, ValueOf):
        return "a data property of an individual"
    if isinstance(value, Condition):
        return "another condition"
    if isinstance(value, Described):
        return value.described()
    if isinstance(value, type):
        return f"the class {value.__name__}"
    if value is None or isinstance(value, (str, int, float)):
        return f"{value!r}"
    return f"something of type {type(value).__name__}"
