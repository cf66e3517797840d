"""The individuals of the ontology and of scenes that a parameter can stand for."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from pathlib import Path

import pyoxigraph

from ezskiros.ontology.iris import RDF, split
from ezskiros.ontology.model import Model
from ezskiros.ontology.read import read

_OF_ROBOTS = frozenset(("Agent", "Device"))
"""Classes of SUMO with usually one individual: SkiROS2 runs the skills of one robot, which has one
of most devices.
"""


class Individuals:
    """The individuals of an ontology and of some scenes. Unreadable scenes have none."""

    def __init__(self, scenes: Sequence[Path] = ()) -> None:
        self._scenes = scenes

    def of(self, owl_class: str, model: Model) -> list[str]:
        """The individuals of a class and of its subclasses, by name."""
        declared = ((each.iri, kind) for each in model.individuals.values() for kind in each.types)
        kinds = {*declared, *self._in_scenes}
        return sorted({iri for iri, kind in kinds if model.is_a(kind, owl_class)})

    def are_several(self, owl_class: str, model: Model) -> bool:
        """Say whether a class may have more than one individual.

        If neither the ontology nor a scene has an individual of the class, the answer is yes,
        except for robots and their devices: SkiROS2 runs the skills of one robot.
        """
        known = self.of(owl_class, model)
        if known:
            return len(known) > 1
        return _OF_ROBOTS.isdisjoint(split(each)[1] for each in model.above(owl_class))

    @cached_property
    def _in_scenes(self) -> list[tuple[str, str]]:
        documents = (read(path)[0] for path in self._scenes if path.is_file())
        return [
            (each.subject.value, each.object.value)
            for document in documents
            if document is not None
            for each in document.triples
            if each.predicate.value == RDF + "type"
            and isinstance(each.subject, pyoxigraph.NamedNode)
            and isinstance(each.object, pyoxigraph.NamedNode)
        ]
