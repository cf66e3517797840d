"""The scene in which a robot starts: the individuals of its world, by the classes that rules name.

EzSkiROS itself reads the scene, with the ontology of the skills file. So each individual has the
same classes and properties here as during the run of a skill.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from crosscheck.errors import NoOntologyForScene
from crosscheck.ontology import ontology_of
from crosscheck.robot import Robot
from dslkit.diagnostics import Diagnostic
from dslkit.source import Span
from ezskiros.context.snapshot import Snapshots
from ezskiros.engine.world import World
from ezskiros.export.vocabulary import name_in
from ezskiros.ontology.read import Document
from ezskiros.ontology.scene_text import place_in, spelled_in
from ezskiros.planning.scene import read_scene


@dataclass(frozen=True)
class SceneModel:
    """A scene as a world model, with the IRIs of classes by the names in the rules."""

    document: Document
    world: World
    iris: Mapping[str, str]
    snapshots: Snapshots

    def individuals(self, *classes: str) -> tuple[str, ...]:
        """The IRIs of the individuals of some classes or of derived classes."""
        found = (
            individual for name in classes for individual in self.world.individuals(self.iris[name])
        )
        return tuple(dict.fromkeys(found))

    def is_a(self, individual: str, classes: Iterable[str]) -> bool:
        """Say whether an individual is of one of some classes."""
        return any(self.world.is_a(individual, self.iris[name]) for name in classes)

    def classes(self, individuals: Iterable[str]) -> tuple[str, ...]:
        """The names of the classes of some individuals, sorted."""
        ontology = self.world.ontology
        iris = {iri for individual in individuals for iri in self.world.classes(individual)}
        return tuple(sorted(name_in(ontology, iri) for iri in iris))

    def numbers(self, individual: str) -> Mapping[str, float]:
        """The numbers of an individual, as the message about running skills reports them. A
        property with several values, or with a value that is not a number, is NaN.
        """
        found = self.snapshots.properties(self.world, individual)
        return {each.property: each.number for each in found}

    def spelled(self, individual: str) -> str:
        """The IRI with the prefix of the scene, such as `office:Whiteboard-5`."""
        return spelled_in(self.document, individual, self.world.ontology.model)

    def place(self, individual: str) -> Span:
        """The place where an individual is described; the start of the scene for an individual of
        the ontology.
        """
        return place_in(self.document, self.world.ontology.model, individual)


@dataclass(frozen=True)
class LoadedScene:
    """The scene, or None if it cannot be used; and its findings."""

    scene: SceneModel | None
    diagnostics: Sequence[Diagnostic]


def load_scene(path: Path, robot: Robot) -> LoadedScene:
    """Read a scene for a robot. Raises `OSError` if it cannot be read."""
    known = ontology_of(robot)
    if known.missing is not None:
        missing = NoOntologyForScene(missing=known.missing)
        return LoadedScene(None, [missing.at(robot.span_of(None))])
    found, wrong = read_scene(path, known.ontology)
    if found is None:
        return LoadedScene(None, wrong)
    snapshots = Snapshots(robot.skills.digest)
    return LoadedScene(SceneModel(found.document, found.world(), known.iris, snapshots), wrong)
