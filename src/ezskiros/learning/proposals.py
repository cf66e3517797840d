"""Proposals for users, each with its evidence: rules that look ahead, and pre-conditions.

There is a proposal only if places make a difference: a rule became active with some individuals, in
several runs, and never with others.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from dslkit.diagnostics import listed
from dslkit.diagnostics.visible import visible
from ezskiros.learning.lessons import Lessons, Trip
from ezskiros.learning.report import places_text
from ezskiros.learning.scene import Map

_LEAST_RUNS = 2
"""The least number of runs in which a rule became active: one may be a coincidence."""


@dataclass(frozen=True)
class Difference:
    """A parameter that distinguishes runs. With all individuals of `tripped` a rule became active,
    with none of `free`. Both are IRIs of locations.
    """

    trip: Trip
    parameter: str
    tripped: Sequence[str]
    free: Sequence[str]


def differences(lessons: Lessons) -> Iterator[Difference]:
    """The parameters that make a difference to a rule."""
    for trip in lessons.trips:
        if trip.share.runs < _LEAST_RUNS:
            continue
        for name in sorted({name for places in trip.at for name, _ in places}):
            tripped, free = _individuals(trip, name)
            if tripped and free:
                yield Difference(trip, name, tripped, free)


def _individuals(trip: Trip, parameter: str) -> tuple[Sequence[str], Sequence[str]]:
    """The individuals of a parameter with which a rule became active, and the others. Both are
    empty if the rule became active only sometimes with one individual, or without any.
    """
    runs: dict[str, list[int]] = {}
    for places, share in trip.at.items():
        runs.setdefault(dict(places).get(parameter, ""), []).append(share.runs)
    tripped = sorted(iri for iri, found in runs.items() if any(found))
    free = sorted(iri for iri, found in runs.items() if not any(found))
    is_clear = all(all(runs[iri]) for iri in tripped) and "" not in tripped
    return (tripped, [each for each in free if each]) if is_clear else ((), ())


def proposals(lessons: Lessons, known: Map) -> Iterator[str]:
    """The proposals as texts: comments with the evidence, and code to paste."""
    for found in differences(lessons):
        yield "\n".join(visible(each) for each in _rule(found, known))
        yield "\n".join(visible(each) for each in _pre_condition(found, known))


def _rule(found: Difference, known: Map) -> Iterator[str]:
    """A rule that acts before the robot is at the place."""
    owl_class = _class_of(found, known)
    individuals = listed([known.short(each) for each in found.tripped])
    yield from _evidence(found, known, "//")
    if owl_class is None:
        yield f"// Declare a new CLASS in the ontology, and give it to {individuals} in the scene."
    lost = [known.short(iri) for iri in found.tripped if not known.is_placed(iri)]
    if lost:
        yield f"// Add the location of {listed(lost)} to the scene."
    yield "// Fill in POSE, MOTION, SPEED and ACTION; `rossmarie check` reports a late rule."
    name = owl_class or "CLASS"
    yield f"rule ahead_of_{found.trip.rule}: if distance(POSE, {name}) < stopping(MOTION, SPEED)"
    yield "    then { ACTION; }"
    yield f"    keeps MOTION below SPEED in {name};"


def _pre_condition(found: Difference, known: Map) -> Iterator[str]:
    """A pre-condition with which plans and tasks avoid the places."""
    yield from _evidence(found, known, "#")
    free = listed([known.short(each) for each in found.free])
    tripped = listed([known.short(each) for each in found.tripped])
    yield f"# Add this to the description of {found.trip.skill}. PROPERTY is a new data property:"
    yield f"# True for {free}, False for {tripped}."
    yield f"self.pre_conditions += {found.parameter}.PROPERTY == True"


def _evidence(found: Difference, known: Map, sign: str) -> Iterator[str]:
    trip = found.trip
    yield f"{sign} `{trip.rule}` became active during {trip.skill} in {trip.share}:"
    for places, share in trip.at.items():
        yield f"{sign}   {share} with {places_text(places, known.short) or 'no place'}"
    yield f"{sign} First cause: {' '.join(trip.evidence.split())}"


def _class_of(found: Difference, known: Map) -> str | None:
    """The name, in rules, of a class with exactly the individuals that make the difference; None if
    there is none.
    """
    classes = [frozenset(known.classes(iri)) for iri in found.tripped]
    others = frozenset().union(*(known.classes(iri) for iri in found.free))
    shared = frozenset.intersection(*classes) - others
    return known.name(min(shared)) if shared else None
