"""Skills in a SkiROS2 library: checked when SkiROS2 loads the library, and run by SkiROS2."""

from __future__ import annotations

from ezskiros.hosts.skiros2_api import is_running


def host(package: str, *, context: str | None = None) -> None:
    """Let SkiROS2 load the skills of a library. `package` is the name of the library, which is
    being imported.

    If `context` is given, the skill manager publishes the running skills. `context` is a skills
    file (`ezskiros export`), relative to the folder of the library.

    Skills with errors are refused, and all findings are in SkiROS2's log. If another program
    imports the library, this function does nothing, so that the library can be checked and run
    without SkiROS2.
    """
    if is_running():
        from ezskiros.hosts.skiros2_loading import (
            load,
        )  # a slow import that other programs do not need

        load(package, context)
