"""`ezskiros run --context`: runs behavior trees that rules request instead of the task."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from ezskiros.cli.output import output

if TYPE_CHECKING:  # loaded only when needed
    from ezskiros.engine.interruption import InterruptibleTask
    from ezskiros.export import Export


@contextmanager
def recoveries(export: Export, task: InterruptibleTask) -> Iterator[None]:
    """While the context is active, rules can request trees over ROS. If they cannot, the reason is
    reported.
    """
    from ezskiros.context.recovery_ros import serve
    from ezskiros.context.ros import NoRosError
    from ezskiros.engine.recovery_goals import RecoveryGoals, TaskHost

    try:
        stop = serve(RecoveryGoals(export.digest, TaskHost(task)))
    except NoRosError as problem:
        output.complain(f"rules cannot request trees: {problem}")
        yield
        return
    try:
        yield
    finally:
        stop()
