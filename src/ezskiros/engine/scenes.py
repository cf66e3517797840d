"""Conversion of scenes to a world model."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from dslkit.diagnostics import Diagnostic
from ezskiros.check.scenes import check_scene
from ezskiros.engine.world import World
from ezskiros.ontology import Ontology
from ezskiros.ontology.read import read


def load_world(ontology: Ontology, scene: Path | None) -> tuple[World, Sequence[Diagnostic]]:
    """A world with the facts of a scene, and the findings on the scene. Raises `OSError`."""
    world = World(ontology)
    if scene is None:
        return world, []
    document, wrong = read(scene)
    if document is None:
        return world, wrong
    world.load(document)
    return world, check_scene(scene, ontology)
