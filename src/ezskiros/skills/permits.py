"""The permissions of a skill: `self.permits += force(Object, "20 N")`.

A hazard elsewhere can be the purpose of a skill (thesis, section 5.2). Permissions are
alternatives: an action is permitted if one permission allows it. Rules read them; SkiROS2 does not.
"""

from __future__ import annotations

import difflib
import enum
import math
from dataclasses import dataclass, field

from dslkit.diagnostics import DidYouMean, listed
from dslkit.source import Span
from ezskiros import session
from ezskiros.ontology.symbols import (
    UNKNOWN,
    Described,
    OntologyClass,
    Thing,
    UnknownValue,
    depends_on_symbol,
    described,
)
from ezskiros.skills import permit_errors as errors
from ezskiros.skills.added import Added
from ezskiros.skills.quantities import UNITS, Dimension, Quantity, read, units_of
from ezskiros.skills.syntax import added_value


class Permit(enum.Enum):
    """The kinds of permissions."""

    CONTACT = "contact"
    """The robot may touch individuals."""
    CLOSENESS = "closeness"
    """The robot may come as close to an individual as the limit."""
    SPEED = "speed"
    """It may move as fast as the limit."""
    FORCE = "force"
    """The robot may push an individual with a force up to the limit."""


DIMENSIONS: dict[Permit, tuple[Dimension, ...]] = {
    Permit.CONTACT: (),
    Permit.CLOSENESS: (Dimension.LENGTH,),
    Permit.SPEED: (Dimension.SPEED, Dimension.TURN),
    Permit.FORCE: (Dimension.FORCE,),
}
"""The dimensions of the limits."""
_EXAMPLES = {
    Permit.CONTACT: "contact(Object)",
    Permit.CLOSENESS: 'closeness(Person, "0.3 m")',
    Permit.SPEED: 'speed("0.2 m/s")',
    Permit.FORCE: 'force(Object, "20 N")',
}
_DIMENSION_WORDS = {
    Dimension.LENGTH: "lengths",
    Dimension.MASS: "masses",
    Dimension.TIME: "times",
    Dimension.FORCE: "forces",
    Dimension.ANGLE: "angles",
    Dimension.SPEED: "speeds",
    Dimension.TURN: "angular speeds",
}


@dataclass(frozen=True)
class PermittedIndividual:
    """The individuals of a permission: the individual of the parameter, or, without a parameter,
    all individuals of a class. `owl_class` is that class, or the class of the parameter's type.
    """

    parameter: str | None
    owl_class: OntologyClass


@dataclass(frozen=True)
class Permission(Described):
    """A permission of a skill, and its place in the source. If it has several individuals, it
    permits each.
    """

    kind: Permit
    individuals: tuple[PermittedIndividual, ...]
    limit: Quantity | None
    span: Span = field(compare=False)

    def described(self) -> str:
        """The description, for messages."""
        return "a permission"


class Permits(Added[Permission]):
    """The permissions of a skill: `self.permits += contact(Object)`."""

    def __iadd__(self, permission: Permission | UnknownValue) -> Permits:
        if isinstance(permission, Permission):
            self._items.append(permission)
            return self
        self.are_whole = False
        if not isinstance(permission, UnknownValue):
            span = added_value(session.here())
            session.report(errors.NoPermission(found=described(permission)).at(span))
        return self

    def replaced_by(self, value: object) -> None:
        """Take the permission of `self.permits = contact(Object)`, which has been reported."""
        self.are_whole = False
        if isinstance(value, Permission):
            self._items.append(value)


def contact(individual: object, *others: object) -> Permission | UnknownValue:
    """The robot may touch these individuals, given by parameters or classes."""
    return _permission(Permit.CONTACT, (individual, *others), None)


def closeness(individual: object, limit: object) -> Permission | UnknownValue:
    """The robot may come as close to an individual as the limit: `closeness(Person, "0.3 m")`."""
    return _permission(Permit.CLOSENESS, (individual,), limit)


def speed(limit: object) -> Permission | UnknownValue:
    """The robot may move as fast as the limit, `"0.2 m/s"`, or turn as fast, `"30 deg/s"`."""
    return _permission(Permit.SPEED, (), limit)


def force(individual: object, limit: object) -> Permission | UnknownValue:
    """The robot may push an individual with a force up to the limit: `force(Object, "20 N")`."""
    return _permission(Permit.FORCE, (individual,), limit)


def _permission(
    kind: Permit, individuals: tuple[object, ...], limit: object
) -> Permission | UnknownValue:
    span = session.here()
    permitted = [_individual(kind, each, span) for each in individuals]
    quantity = _limit(kind, limit, span) if DIMENSIONS[kind] else None
    is_limited = quantity is not None or not DIMENSIONS[kind]
    known = [each for each in permitted if each is not None]
    if len(known) < len(individuals) or not is_limited:
        return UNKNOWN
    return Permission(kind, tuple(known), quantity, span)


def _individual(kind: Permit, found: object, span: Span) -> PermittedIndividual | None:
    """The individual, or the class of individuals; None after a finding."""
    if isinstance(found, Thing):
        return PermittedIndividual(repr(found), type(found))
    if isinstance(found, OntologyClass):
        return PermittedIndividual(None, found)
    if not isinstance(found, UnknownValue):
        wrong = errors.PermittedNoIndividual(kind=kind.value, found=described(found))
        session.report(wrong.at(span))
    return None


def _limit(kind: Permit, found: object, span: Span) -> Quantity | None:
    """The limit; None after a finding."""
    if isinstance(found, UnknownValue):
        return None
    written = read(found) if isinstance(found, str) and not depends_on_symbol(found) else None
    if written is None or not written.unit:
        _report_no_quantity(kind, found, written is not None, span)
        return None
    unit = UNITS.get(written.unit)
    if unit is None:
        _report_unknown_unit(kind, written.unit, span)
        return None
    if unit.dimension not in DIMENSIONS[kind]:
        wrong = errors.WrongDimension(
            kind=kind.value,
            units=listed(units_of(*DIMENSIONS[kind])),
            unit=written.unit,
            dimension=_DIMENSION_WORDS[unit.dimension],
        )
        session.report(wrong.at(span))
        return None
    is_finite = math.isfinite(written.number)
    si = unit.si(written.number) if is_finite else math.nan
    if not math.isfinite(si) or written.has_minus:
        fault = "below 0" if written.has_minus else "not finite"
        unfit = errors.PermittedLimit(kind=kind.value, found=repr(found), fault=fault)
        session.report(unfit.at(span))
        return None
    return Quantity(written.number, written.unit, si)


def _report_no_quantity(kind: Permit, found: object, is_number: bool, span: Span) -> None:
    wrong = errors.NoQuantity(kind=kind.value, found=described(found), example=_EXAMPLES[kind])
    help: errors.NoQuantity.NoUnit | errors.NoQuantity.NotKnownBefore | None = None
    if is_number:
        help = wrong.NoUnit(units=listed(units_of(*DIMENSIONS[kind])))
    elif isinstance(found, Described) or depends_on_symbol(found):
        help = wrong.NotKnownBefore()
    session.report(wrong.at(span, help=help))


def _report_unknown_unit(kind: Permit, unit: str, span: Span) -> None:
    known = units_of(*DIMENSIONS[kind])
    by_lower = {each.lower(): each for each in known}
    near = difflib.get_close_matches(unit.lower(), by_lower, n=1)
    wrong = errors.UnknownUnit(unit=unit, kind=kind.value, units=listed(known))
    session.report(wrong.at(span, help=DidYouMean(near=by_lower[near[0]]) if near else None))
