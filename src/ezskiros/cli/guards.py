"""`ezskiros run --guards`: primitives wait while rules take away resources that they use."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from dslkit.diagnostics import Diagnostic
from dslkit.writing import reason
from ezskiros.cli.output import output

if TYPE_CHECKING:  # loaded only when needed
    from ezskiros.context.guards import Guards
    from ezskiros.engine.execution_context import ExecutionContext
    from ezskiros.export import Export


def guards_for(path: Path | None, export: Export | None, *, simulate: bool) -> Guards | None:
    """The guards in a file; None without a file. The run ends if the file has no guards, or guards
    of other skills than the export.
    """
    if path is None:
        return None
    if simulate:
        output.fail("--guards needs skills that run: leave out --simulate", exit_code=2)
    from ezskiros.context.guards import of_other_skills, read_guards

    try:
        guards = read_guards(path)
    except OSError as problem:
        output.fail(f"cannot read {path}: {reason(problem)}", exit_code=2)
    if isinstance(guards, Diagnostic):
        _refuse(guards)
    other = of_other_skills(guards, export) if export is not None else None
    if other is not None:
        _refuse(other)
    return guards


def _refuse(found: Diagnostic) -> NoReturn:
    output.print_findings([found])
    output.fail("nothing was run, because skills could not wait for rules", exit_code=2)


@contextmanager
def guarded(guards: Guards, execution: ExecutionContext) -> Iterator[None]:
    """While the context is active, primitives of a task wait for rules. The run ends if the state
    of the rules cannot be received.
    """
    from ezskiros.context.guards import ActiveRules
    from ezskiros.context.guards_ros import listen
    from ezskiros.context.ros import NoRosError

    rules = ActiveRules(guards)
    try:
        stop = listen(guards, rules)
    except NoRosError as problem:
        output.fail(f"nothing was run, because no rule can be received: {problem}", exit_code=2)
    execution.guard = rules.reason_to_wait
    try:
        yield
    finally:
        stop()
