"""The ontology of the robot. Do not change this file."""

from pathlib import Path

from ezskiros.ontology import load

world = load(Path(__file__).parent / "ontology")
cora, rparts, skiros = world.cora, world.rparts, world.skiros
