"""The positions of the individuals of a scene, with the properties of SkiROS2 and of GeoSPARQL.

A polygon is the value of `geo:asWKT`. A box has the position, the orientation and the size of
SkiROS2's ontology. An individual with only a position is a point. Frames are values of
`skiros:BaseFrameId`.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import pyoxigraph

from dslkit.diagnostics import Diagnostic
from dslkit.source import Span
from ezskiros.locations import errors
from ezskiros.locations.location import FARTHEST, Location, NoPolygonError, Point
from ezskiros.ontology.iris import AS_WKT, OWL, RDF, RDFS, RESERVED
from ezskiros.ontology.model import Model
from ezskiros.ontology.places import EntityDeclarations
from ezskiros.ontology.read import Document
from ezskiros.ontology.scene_text import place_in, spelled_in

_SKIROS = "http://rvmi.aau.dk/ontologies/skiros.owl#"
_LOCATION = _SKIROS + "Location"
_FRAME = _SKIROS + "BaseFrameId"
_POSITION = tuple(f"{_SKIROS}Position{axis}" for axis in "XY")
_ORIENTATION = tuple(f"{_SKIROS}Orientation{axis}" for axis in "XYZW")
_SIZE = tuple(f"{_SKIROS}Size{axis}" for axis in "XYZ")
_UPRIGHT = (0.0, 0.0, 0.0, 1.0)

_Values = Mapping[str, Sequence[str]]
"""The texts of the values of an individual, by the IRIs of properties."""


@dataclass(frozen=True)
class FoundLocations:
    """The locations of a scene in the order of the file, and the findings."""

    locations: Sequence[Location]
    diagnostics: Sequence[Diagnostic]


def find_locations(document: Document, model: Model) -> FoundLocations:
    """The individuals of a scene with a position, and those that should have one: individuals of
    the class `skiros:Location`, and individuals with an incomplete position. The latter have no
    corners.
    """
    finder = _Finder(document, model)
    return FoundLocations([*finder.find()], finder.wrong)


class _WrongError(Exception):
    """A mistake about an individual: the diagnostic."""

    def __init__(self, found: Diagnostic) -> None:
        super().__init__(found.title)
        self.found = found


@dataclass
class _Individual:
    """An individual of a scene with its values."""

    iri: str
    types: Sequence[str]
    values: _Values


class _Finder:
    def __init__(self, document: Document, model: Model) -> None:
        self._document, self._model = document, model
        self._declarations = EntityDeclarations([document])
        self.wrong: list[Diagnostic] = []

    def find(self) -> Iterator[Location]:
        for individual in _individuals(self._document):
            is_location = any(self._model.is_a(each, _LOCATION) for each in individual.types)
            corners: tuple[Point, ...] = ()
            try:
                corners = self._corners(individual)
                if corners and not self._one(individual, _FRAME):
                    stated = AS_WKT if AS_WKT in individual.values else _POSITION[0]
                    raise self._half(individual, stated, _FRAME)
            except _WrongError as problem:
                self.wrong.append(problem.found)
                is_location, corners = True, ()
            if corners or is_location:
                yield self._location(individual, corners)

    def _location(self, individual: _Individual, corners: tuple[Point, ...]) -> Location:
        label = next(iter(individual.values.get(RDFS + "label", ())), "")
        frame = next(iter(individual.values.get(_FRAME, ())), "") if corners else ""
        types = tuple(sorted(each for each in individual.types if not each.startswith(RESERVED)))
        span = self._declarations.place(individual.iri) or Span(self._document.file, 0, 0)
        return Location(individual.iri, label, types, frame, corners, span)

    def _corners(self, individual: _Individual) -> tuple[Point, ...]:
        """The corners of an individual; none if the scene has no position for it."""
        text = self._one(individual, AS_WKT)
        if text is not None:
            # The import of Shapely takes as long as the check of a file, and few scenes have
            # polygons.
            from ezskiros.locations.polygon import corners_of

            try:
                return corners_of(text)
            except NoPolygonError as problem:
                wrong = errors.WrongPolygon(
                    individual=self._spelled(individual.iri), reason=str(problem)
                )
                raise _WrongError(wrong.at(self._place(individual.iri, AS_WKT))) from None
        position = self._numbers(individual, _POSITION)
        if position is None:
            return ()
        x, y = position
        size = self._numbers(individual, _SIZE[:2])
        return ((x, y),) if size is None else self._box(individual, (x, y), size)

    def _box(
        self, individual: _Individual, position: Point, size: Sequence[float]
    ) -> tuple[Point, ...]:
        from ezskiros.locations.box import footprint

        height = self._number(individual, _SIZE[2])
        edges = (*size, 0.0 if height is None else height)
        for edge, iri in zip(edges, _SIZE, strict=True):
            if edge < 0 or (edge == 0 and iri != _SIZE[2]):
                raise self._odd(individual, iri, f"is {edge:g}; a size must be more than 0 m")
        found = self._numbers(individual, _ORIENTATION) or _UPRIGHT
        x, y, z, w = found
        if not math.hypot(x, y, z, w) > 0.5:
            raise self._odd(individual, _ORIENTATION[3], "is not part of a quaternion of length 1")
        try:
            return footprint(position, (x, y, z, w), edges)
        except NoPolygonError as problem:
            raise self._odd(
                individual, _SIZE[0], f"makes a box whose footprint {problem}"
            ) from None

    # --- values -----------------------------------------------------------------------------------

    def _numbers(self, individual: _Individual, iris: Sequence[str]) -> Sequence[float] | None:
        """The values of properties that belong together; None if all are missing."""
        found = [self._number(individual, iri) for iri in iris]
        known = [each for each in found if each is not None]
        if not known:
            return None
        if len(known) < len(found):
            missing = iris[found.index(None)]
            there = next(iri for iri, each in zip(iris, found, strict=True) if each is not None)
            raise self._half(individual, there, missing)
        return known

    def _number(self, individual: _Individual, iri: str) -> float | None:
        text = self._one(individual, iri)
        if text is None:
            return None
        try:
            number = float(text)
        except ValueError:
            number = math.nan
        if not abs(number) <= FARTHEST:
            raise self._odd(individual, iri, f"is {text}, not a number up to {FARTHEST:.0f}")
        return number

    def _one(self, individual: _Individual, iri: str) -> str | None:
        found = individual.values.get(iri, ())
        if len(found) > 1:
            raise self._odd(individual, iri, "has several values")
        return found[0] if found else None

    # --- findings and words ---------------------------------------------------------------------

    def _half(self, individual: _Individual, found: str, missing: str) -> _WrongError:
        return _WrongError(
            errors.HalfKnown(
                individual=self._spelled(individual.iri),
                found=self._spelled(found),
                missing=self._spelled(missing),
            ).at(self._place(individual.iri, found))
        )

    def _odd(self, individual: _Individual, iri: str, reason: str) -> _WrongError:
        wrong = errors.WrongPlace(
            individual=self._spelled(individual.iri), property=self._spelled(iri), reason=reason
        )
        return _WrongError(wrong.at(self._place(individual.iri, iri)))

    def _spelled(self, iri: str) -> str:
        return spelled_in(self._document, iri, self._model)

    def _place(self, individual: str, *parts: str) -> Span:
        return place_in(self._document, self._model, individual, *parts)


def _individuals(document: Document) -> Iterator[_Individual]:
    """The individuals that a scene describes, in the order of the file, without its classes."""
    types: dict[str, list[str]] = defaultdict(list)
    values: dict[str, dict[str, list[str]]] = {}
    for triple in document.triples:
        if not isinstance(triple.subject, pyoxigraph.NamedNode):
            continue
        iri, said = triple.subject.value, triple.predicate.value
        of_individual = values.setdefault(iri, defaultdict(list))
        if isinstance(triple.object, pyoxigraph.Literal):
            of_individual[said].append(triple.object.value)
        elif isinstance(triple.object, pyoxigraph.NamedNode) and said == RDF + "type":
            types[iri].append(triple.object.value)
    for iri, found in values.items():
        if not {OWL + "Class", RDFS + "Class"} & set(types[iri]):
            yield _Individual(iri, types[iri], found)
