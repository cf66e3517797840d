"""The skills of Heron, in EzSkiROS: what its tasks are, as behavior trees that are checked."""

from __future__ import annotations

from pathlib import Path

from ezskiros.hosts.skiros2 import host

FOLDER = Path(__file__).parent
EXPORT = FOLDER / "skills.json"
"""The skills as rules know them, written by `ezskiros export`."""

host(__name__, context=EXPORT.name)
