"""Generated C with a fault: what a generator or an engine that errs might have."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

Part = Literal["monitor", "reactor"]

_OF_REACTORS = ("_reactor.c", "/commands.h", "/plans.h", "/reactor.h", "/retraces.h")


def sources(files: Mapping[str, str], part: Part) -> dict[str, str]:
    """The generated file of a monitor or a reactor, and the parts of the engine in it."""
    code = {
        name: text for name, text in files.items() if name.endswith(("_monitor.c", "_reactor.c"))
    }
    code |= {name: text for name, text in files.items() if name.startswith("engine/")}
    return {
        name: text
        for name, text in code.items()
        if name.endswith(_OF_REACTORS) == (part == "reactor")
    }


def damaged(files: Mapping[str, str], part: Part, old: str, new: str) -> dict[str, str]:
    """All files, with a text of one of them replaced wherever it stands in it."""
    found = [name for name, text in sources(files, part).items() if old in text]
    assert len(found) == 1, (old, found)
    return {**files, found[0]: files[found[0]].replace(old, new)}
