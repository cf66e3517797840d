"""The ontology from which the skills of a robot were made, from the sources in the skills file."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from crosscheck.robot import Robot
from ezskiros.ontology import Ontology
from ezskiros.ontology.load import core_relations
from ezskiros.ontology.read import read

_MODULE = ".py"
"""The ending of source files that are Python modules, not ontologies."""


@dataclass(frozen=True)
class RobotOntology:
    """The ontology of a robot. `missing` is an unreadable file, or a class of the skills that is
    not in the ontology; None if nothing is missing.
    """

    ontology: Ontology
    missing: str | None

    @cached_property
    def iris(self) -> Mapping[str, str]:
        """The IRIs of classes, by the names in the rules."""
        return {name: iri for iri, name in self.ontology.spelled.items()}


def ontology_of(robot: Robot) -> RobotOntology:
    """Read the ontology. No text of an unreadable file is quoted, because a skills file can name
    any file.
    """
    documents = []
    for path in _files(robot):
        document, _ = read(path)
        if document is None:
            return RobotOntology(Ontology(()), str(path))
        documents.append(document)
    found = RobotOntology(Ontology([*documents, core_relations()]), None)
    missing = next((name for name in robot.skills.classes if name not in found.iris), None)
    return RobotOntology(found.ontology, missing)


def _files(robot: Robot) -> Iterator[Path]:
    assert robot.program.skills is not None, "a robot has skills"
    for source in robot.skills.sources:
        if not source.path.endswith(_MODULE):
            yield robot.program.skills.folder / source.path
