"""Skills in a SkiROS2 library: checked when SkiROS2 loads the library, and run by SkiROS2."""

from __future__ import annotations

from ezskiros.hosts.skiros2_api import is_running


def host(package: str, *, context: str | None = None) -> None:
    """Let SkiROS2 load the skills of a library; `package` is its name, and it is being imported.

    With a `context`, a file of skills (`ezskiros export`) that is looked for from the folder of the
    library, the skill manager publishes which skills run.

    Skills with errors are refused, and all that is wrong is reported in SkiROS2's log. Does nothing
    where it is not SkiROS2 that imports the library, so that it can be checked and run without.
    """
    if is_running():
        from ezskiros.hosts.skiros2_loading import load  # takes time that others need not spend

        load(package, context)
