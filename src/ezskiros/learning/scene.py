"""The locations of a scene, by which runs are distinguished."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from dslkit.diagnostics import Diagnostic, Severity
from dslkit.source import SourceFile, Span, is_file
from ezskiros.check.scene_errors import NoOntologyForScene
from ezskiros.check.scenes import check_scene
from ezskiros.export.vocabulary import name_in
from ezskiros.locations import Location, find_locations
from ezskiros.ontology import Ontology
from ezskiros.ontology.load import load_named
from ezskiros.ontology.read import read
from ezskiros.skills.load_errors import NoFile


@dataclass(frozen=True)
class Map:
    """Locations by IRI, and the ontology with names for them."""

    locations: Mapping[str, Location] = field(default_factory=dict)
    ontology: Ontology | None = None

    def short(self, iri: str) -> str:
        """The name of an individual, with its prefix if the ontology knows one."""
        return self.ontology.model.short(iri) if self.ontology is not None else iri

    def name(self, owl_class: str) -> str:
        """The name of a class in rules."""
        return name_in(self.ontology, owl_class) if self.ontology is not None else owl_class

    def classes(self, iri: str) -> Sequence[str]:
        """The classes of a location, as the scene names them; empty if the individual is not a
        location.
        """
        return self.locations[iri].types if iri in self.locations else ()

    def is_placed(self, iri: str) -> bool:
        """Say whether the scene contains the position of a location."""
        return iri in self.locations and bool(self.locations[iri].corners)


def read_map(path: Path) -> tuple[Map | None, Sequence[Diagnostic]]:
    """The locations of a scene, None after an error, and the findings. The ontology is the one that
    `load()` loads. Raises `OSError` if the scene cannot be read.
    """
    nowhere = Span(SourceFile(str(path), ""), 0, 0)
    if not is_file(path):
        return None, [NoFile(path=str(path)).at(nowhere)]
    ontology, found = load_named()
    if ontology is None:
        return None, [NoOntologyForScene().at(nowhere)]
    found = [*found, *check_scene(path, ontology)]
    document, _ = read(path)
    if document is None or any(each.severity is Severity.ERROR for each in found):
        return None, found
    located = find_locations(document, ontology.model).locations
    return Map({each.iri: each for each in located}, ontology), found
