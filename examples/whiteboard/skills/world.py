"""The ontology of the office, with the ontology of the pick-and-place example."""

from pathlib import Path

from ezskiros.ontology import load

world = load(Path(__file__).parents[1] / "ontology")
cora, office, rparts, skiros = world.cora, world.office, world.rparts, world.skiros
