"""The ontology of the office, on that of the pick-and-place example."""

from pathlib import Path

from ezskiros.ontology import load

_EXAMPLES = Path(__file__).parents[2]
world = load(_EXAMPLES / "whiteboard" / "ontology", _EXAMPLES / "pick_place" / "ontology")
cora, office, rparts, skiros = world.cora, world.office, world.rparts, world.skiros
