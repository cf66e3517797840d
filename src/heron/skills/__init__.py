"""The skills of Heron, in EzSkiROS: its tasks are checked behavior trees."""

from __future__ import annotations

from pathlib import Path

from ezskiros.hosts.skiros2 import host

FOLDER = Path(__file__).parent
EXPORT = FOLDER / "skills.json"
"""The skills file for rules, written by `ezskiros export`."""

host(__name__, context=EXPORT.name)
