"""The ontology that the skills of a robot were made from, by the sources in the file of skills."""

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
"""The ending of the sources of skills that are no ontology."""


@dataclass(frozen=True)
class Classes:
    """The ontology of a robot. `missing` is a file that cannot be read, or a class of the skills
    that it does not have; None if it has all.
    """

    ontology: Ontology
    missing: str | None

    @cached_property
    def iris(self) -> Mapping[str, str]:
        """The IRIs of classes, by the names that rules use."""
        return {name: iri for iri, name in self.ontology.spelled.items()}


def ontology_of(robot: Robot) -> Classes:
    """Read the ontology. Nothing is quoted from a file that cannot be read: a file of skills may
    name any.
    """
    documents = []
    for path in _files(robot):
        document, _ = read(path)
        if document is None:
            return Classes(Ontology(()), str(path))
        documents.append(document)
    found = Classes(Ontology([*documents, core_relations()]), None)
    missing = next((name for name in robot.skills.classes if name not in found.iris), None)
    return Classes(found.ontology, missing)


def _files(robot: Robot) -> Iterator[Path]:
    assert robot.program.skills is not None, "a robot has skills"
    for source in robot.skills.sources:
        if not source.path.endswith(_MODULE):
            yield robot.program.skills.folder / source.path
