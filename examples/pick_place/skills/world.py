"""The ontology of the hall."""

from pathlib import Path

from ezskiros.ontology import load

world = load(Path(__file__).parents[1] / "ontology")
cora, rparts, scalable, skiros = world.cora, world.rparts, world.scalable, world.skiros
sumo = world.sumo
