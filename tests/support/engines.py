"""The same rules in each of the two engines."""

from __future__ import annotations

from pathlib import Path

import pytest

import rossmarie
from rossmarie import Monitor

ENGINES = ("native", "python")


def load(rules: str, engine: str, folder: Path) -> Monitor:
    """A monitor of some rules, as `rossmarie.load` gives it with or without a C compiler."""
    path = folder / "rules.ross"
    path.write_text(rules)
    if engine == "native":
        monitor = rossmarie.load(path)
    else:
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("CC", "no-such-compiler")
            with pytest.warns(RuntimeWarning, match="no-such-compiler"):
                monitor = rossmarie.load(path)
    assert monitor.kind == engine
    return monitor
