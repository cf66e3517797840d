"""The scene that a robot starts in: the things of its world, by the classes that rules name.

EzSkiROS itself reads it, in the ontology that the file of skills was made from. So a thing is and
has here what it is and has while a skill runs with it.
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
class Scene:
    """A scene as the world that it makes, with the IRIs of classes by the names that rules use."""

    document: Document
    world: World
    iris: Mapping[str, str]
    snapshots: Snapshots

    def things(self, *classes: str) -> tuple[str, ...]:
        """The things of one of some classes, or of one derived from it, by their IRIs."""
        found = (thing for name in classes for thing in self.world.things(self.iris[name]))
        return tuple(dict.fromkeys(found))

    def is_a(self, thing: str, classes: Iterable[str]) -> bool:
        """Say whether a thing is of one of some classes."""
        return any(self.world.is_a(thing, self.iris[name]) for name in classes)

    def classes(self, things: Iterable[str]) -> tuple[str, ...]:
        """The classes that some things are said to be of, by their names, sorted."""
        ontology = self.world.ontology
        iris = {iri for thing in things for iri in self.world.classes(thing)}
        return tuple(sorted(name_in(ontology, iri) for iri in iris))

    def numbers(self, thing: str) -> Mapping[str, float]:
        """The numbers that a thing has, as the message about running skills tells them: one that
        it has several of, or that is none, is not a number.
        """
        found = self.snapshots.properties(self.world, thing)
        return {each.property: each.number for each in found}

    def spelled(self, thing: str) -> str:
        """`office:Whiteboard-5`, by the prefixes of the scene."""
        return spelled_in(self.document, thing, self.world.ontology.model)

    def place(self, thing: str) -> Span:
        """The place where a thing is described; the start of the scene for one of the ontology."""
        return place_in(self.document, self.world.ontology.model, thing)


@dataclass(frozen=True)
class LoadedScene:
    """The scene, None if nothing can be asked about it; and what is wrong with it."""

    scene: Scene | None
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
    return LoadedScene(Scene(found.document, found.world(), known.iris, snapshots), wrong)
