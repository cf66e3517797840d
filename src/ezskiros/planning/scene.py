"""The initial world model of a plan: a scene, and the names of its individuals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import pyoxigraph

from dslkit.diagnostics import Diagnostic
from ezskiros.check.scenes import check_scene
from ezskiros.engine.world import World
from ezskiros.ontology import Ontology
from ezskiros.ontology.iris import RDFS, THING
from ezskiros.ontology.read import Document, read


@dataclass(frozen=True)
class PlanningScene:
    """A scene from which any number of searches can start."""

    ontology: Ontology
    document: Document

    def world(self) -> World:
        """A new world model with the facts of the scene."""
        found = World(self.ontology)
        found.load(self.document)
        return found

    def names(self) -> Mapping[str, str]:
        """The individuals by name: IRIs, full or short, and labels."""
        model = self.ontology.model
        individuals = self.world().individuals(THING)
        label = pyoxigraph.NamedNode(RDFS + "label")
        found = {
            triple.object.value: triple.subject.value
            for triple in self.document.triples
            if triple.predicate == label
            and isinstance(triple.subject, pyoxigraph.NamedNode)
            and isinstance(triple.object, pyoxigraph.Literal)
            and triple.subject.value in individuals
        }
        for iri in individuals:
            found[iri] = iri
            found[model.short(iri)] = iri
            for prefix, start in self.document.prefixes.items():
                if iri.startswith(start):
                    found[f"{prefix}:{iri[len(start) :]}"] = iri
        return found


def read_scene(path: Path, ontology: Ontology) -> tuple[PlanningScene | None, Sequence[Diagnostic]]:
    """A scene, and the findings. Raises `OSError` if it cannot be read."""
    found = check_scene(path, ontology)
    document, _ = read(path)
    return (PlanningScene(ontology, document) if document else None), found
