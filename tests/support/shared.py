"""Files of the folder beside the repository, which not every machine has."""

from __future__ import annotations

from pathlib import Path

SHARED = Path(__file__).parents[3] / "shared"
HUSKY_DRIVE = SHARED / "data" / "husky_outdoor.bag"
"""A recording of a real robot."""
SKIROS2_TRACES = SHARED / "data" / "skiros2_processor_traces.json"
"""The ticks of the processors of real SkiROS2."""
SKIROS2_ONTOLOGIES = SHARED / "ontologies"
"""The ontologies that SkiROS2 comes with."""
