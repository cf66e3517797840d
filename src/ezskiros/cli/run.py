"""`ezskiros run`: runs a skill without ROS."""

from __future__ import annotations

import re
import signal
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, Annotated, NoReturn

import typer

from dslkit.diagnostics import Diagnostic
from dslkit.options import Force, Format
from dslkit.ownership import Comment
from dslkit.writing import reason, replacing_text
from ezskiros.cli.arguments import Folders, name_ontology, of_skills
from ezskiros.cli.checking import checked, file_count
from ezskiros.cli.context import ContextPublisher, export_for
from ezskiros.cli.guards import guarded, guards_for
from ezskiros.cli.output import output
from ezskiros.cli.recovery import recoveries

if TYPE_CHECKING:  # the engine is loaded only when needed
    from ezskiros.context.guards import Guards
    from ezskiros.context.snapshot import Snapshot
    from ezskiros.engine.events import Event
    from ezskiros.engine.execution_context import ExecutionContext
    from ezskiros.engine.inference import Solution
    from ezskiros.engine.task import TaskOutcome
    from ezskiros.engine.tracing import TraceWriter
    from ezskiros.export import Export
    from ezskiros.runner import Ready
    from ezskiros.skills.calls import SkillCall
    from ezskiros.skills.interface import SkillInterface

_GIVEN = re.compile(r"[A-Za-z_]\w*=")

Skill = Annotated[
    str,
    typer.Argument(
        metavar="SKILL", help="A skill such as Pick, or an implementation such as pick."
    ),
]
Words = Annotated[
    list[str] | None,
    typer.Argument(
        metavar="[PATHS...] [NAME=VALUE...]",
        help="Files or folders with the skills (default: this folder), and parameter values.",
    ),
]

TraceFile = Annotated[
    Path | None,
    typer.Option(metavar="FILE", help="Write the skill trace to this file, as JSON lines."),
]
Timeout = Annotated[
    float | None,
    typer.Option(metavar="SECONDS", min=0.0, help="Stop the task after this time."),
]
ContextFile = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE", help="Publish the running skills, with the names of this skills.json."
    ),
]
WorldFile = Annotated[
    Path | None,
    typer.Option(
        "--out", "-o", metavar="FILE", help="Write the final scene to this file (.turtle)."
    ),
]
GuardsFile = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE", help="Let skills wait for rules: guards.json of `crosscheck weave`."
    ),
]


def run(
    skill: Skill,
    words: Words = None,
    scene: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="The initial scene (.turtle)."),
    ] = None,
    out: WorldFile = None,
    simulate: Annotated[
        bool,
        typer.Option(
            "--simulate", help="Do not execute primitives; only apply their post-conditions."
        ),
    ] = False,
    ask: Annotated[
        bool, typer.Option("--ask", help="Ask the user if several individuals match a parameter.")
    ] = False,
    compatible: Annotated[
        bool,
        typer.Option("--compatible", help="Reproduce the behavior of SkiROS2, with its defects."),
    ] = False,
    trace: TraceFile = None,
    period: Annotated[
        float, typer.Option(metavar="SECONDS", min=0.0, help="The time between two ticks.")
    ] = 0.04,
    timeout: Timeout = None,
    context: ContextFile = None,
    guards: GuardsFile = None,
    ontology: Folders = None,
    force: Force = False,
) -> None:
    """Run a skill without ROS. Ctrl-C preempts the skill."""
    output.permit(force)
    output.try_file(out, trace)
    name_ontology(ontology)
    from ezskiros.engine.execution_context import ExecutionContext
    from ezskiros.engine.expansion import Expansions

    texts = [each for each in words or [] if _GIVEN.match(each)]
    named = [Path(each) for each in words or [] if not _GIVEN.match(each)]
    paths = of_skills(named) or [Path()]
    _check(paths)
    ready = _ready(skill, paths, scene, texts)
    if not simulate:
        _refuse_half_modules(ready)
    export = export_for(context, ready) if context is not None else None
    execution = ExecutionContext(
        ready.library,
        ready.world,
        simulate=simulate,
        compatible=compatible,
        expansions=Expansions(ready.trees),
    )
    waiting = guards_for(guards, export, simulate=simulate)
    run = _Run(ready.call, execution, period, timeout, export, waiting)
    outcome = run.to_the_end(is_asked=ask, trace=trace)
    if out is not None:
        output.save(out, ready.world.turtle(), Comment.HASH)
    _tell(skill, outcome)
    raise typer.Exit(0 if outcome.is_success else 1)


def _check(paths: list[Path]) -> None:
    """End the run if the files have errors. Users' code is trusted only after this check."""
    report = checked(paths)
    if output.exit_code(report.diagnostics):
        _give_up(report.diagnostics, file_count(report, paths))


def _give_up(found: Sequence[Diagnostic], count: int) -> NoReturn:
    output.print_diagnostics(found, Format.TEXT, file_count=count)
    output.complain("nothing was run, because there are errors")
    raise typer.Exit(2)


def _ready(skill: str, paths: list[Path], scene: Path | None, texts: list[str]) -> Ready:
    """Prepare a task to run; otherwise end the run with the reason."""
    from ezskiros.driver import UnknownSkillError
    from ezskiros.engine.arguments import WrongArgumentError
    from ezskiros.runner import FaultyError, prepare

    try:
        ready = prepare(skill, paths, scene, texts)
    except FaultyError as problem:
        _give_up(problem.diagnostics, problem.file_count)
    except (UnknownSkillError, WrongArgumentError) as problem:
        output.fail(str(problem), exit_code=2)
    except OSError as problem:
        output.fail(f"cannot read {scene}: {reason(problem)}", exit_code=2)
    if ready.warnings:
        count = len(ready.warnings)
        plural = "s" if count > 1 else ""
        output.complain(f"{count} warning{plural}: run `ezskiros check` to see the details")
    return ready


def _refuse_half_modules(ready: Ready) -> None:
    """End the run if modules were not fully executed, or executed with stand-ins. Otherwise
    primitives would use mocks, and report success without any effect.
    """
    from ezskiros.skills.load_errors import ClientStandIn, ImportSideEffect, StandIn

    codes = (ClientStandIn.code, ImportSideEffect.code, StandIn.code)
    found = [*ready.warnings, *ready.elsewhere]
    lacking = [each for each in found if each.code in codes]
    if lacking:
        output.print_findings(lacking)
        output.fail(
            "nothing was run: modules above were missing or not fully executed, so primitives "
            "would have no effect; install them, import them in the methods that use them, or add "
            "`--simulate`",
            exit_code=2,
        )


class _Run:
    """One run of a task, and its display."""

    def __init__(
        self,
        call: SkillCall,
        execution: ExecutionContext,
        period: float,
        timeout: float | None,
        export: Export | None,
        guards: Guards | None,
    ) -> None:
        from rich.console import Console

        from ezskiros.cli.progress import LiveTree
        from ezskiros.engine.interruption import InterruptibleTask
        from ezskiros.planning.replanning import replanner

        self._execution, self._period, self._timeout = execution, period, timeout
        self._export, self._guards = export, guards
        self.task = InterruptibleTask(
            call, execution, replanner(execution.library, execution.world)
        )
        self._console = Console(highlight=False)
        self._live = LiveTree(self._console) if self._console.is_terminal else None
        self._trace: TraceWriter | None = None
        self._context: ContextPublisher | None = None
        self._start, self._start_ns = execution.clock(), time.time_ns()
        self._is_interrupted = False

    def to_the_end(self, *, is_asked: bool, trace: Path | None) -> TaskOutcome:
        """Run the task until it has a result or is stopped. With an export, the context is
        published, and rules can request trees.
        """
        from ezskiros.engine.task import run
        from ezskiros.engine.tracing import TraceWriter
        from ezskiros.skills.stand_ins import without_stand_ins

        self._execution.tell = self._tell
        if is_asked:
            self._execution.choose = self._choose
        with ExitStack() as stack:
            if not self._execution.simulate:
                stack.enter_context(without_stand_ins())
            if self._guards is not None:
                stack.enter_context(guarded(self._guards, self._execution))
            if trace is not None:
                stack.enter_context(output.writing(trace))
                self._trace = TraceWriter(
                    stack.enter_context(replacing_text(trace)), self._start_ns
                )
            stack.enter_context(self._interruptible())
            if self._live is not None:
                self._live.start()
                stack.callback(self._live.stop)
            wait: Callable[[float], object] = time.sleep
            if self._export is not None:
                self._context = ContextPublisher(self._export, self.task, self._note)
                stack.enter_context(self._context.reported())
                wait = self._context.wait
                if not self._execution.simulate:
                    stack.enter_context(recoveries(self._export, self.task))
            return run(
                self.task,
                self._period,
                wait=wait,
                why_stop=self._why_stop,
                after_tick=self._after_tick,
            )

    # --- display ----------------------------------------------------------------------------------

    def _tell(self, event: Event) -> None:
        if self._trace is not None:
            self._trace.write(event, self.task.ticks, self._execution.clock() - self._start)
        if self._live is not None:
            self._live.tell(event)
        else:
            from ezskiros.cli.progress import line

            typer.echo(line(event))

    def _note(self, snapshot: Snapshot) -> None:
        """Record the running skills in the trace, with times since its start."""
        if self._trace is not None:
            from ezskiros.context.snapshot import plain

            seconds = self._execution.clock() - self._start
            self._trace.write_context(plain(snapshot, self._start), self.task.ticks, seconds)

    def _after_tick(self) -> None:
        if self._context is not None:
            self._context.tell()
        if self._live is not None:
            self._live.draw(self.task)

    # --- stops ------------------------------------------------------------------------------------

    def _why_stop(self) -> str | None:
        if self._is_interrupted:
            return "it was stopped from the keyboard"
        if self._timeout is not None and self._execution.clock() - self._start >= self._timeout:
            return f"it had no result after {self._timeout:g} s"
        return None

    @contextmanager
    def _interruptible(self) -> Iterator[None]:
        """While the context is active, the first Ctrl-C stops the task after its tick; the second
        one ends a blocked process.
        """

        def note(_signal: int, _frame: FrameType | None) -> None:
            if self._is_interrupted:
                raise KeyboardInterrupt
            self._is_interrupted = True

        before = signal.signal(signal.SIGINT, note)
        try:
            yield
        finally:
            signal.signal(signal.SIGINT, before)

    # --- questions to the user --------------------------------------------------------------------

    def _choose(self, skill: SkillInterface, solutions: Sequence[Solution]) -> Solution:
        """The solution that the user chooses by its number."""
        if self._live is not None:
            self._live.stop()
        spelled = self._execution.world.spelled
        typer.echo(f"{skill.name} can be run with")
        for number, each in enumerate(solutions, start=1):
            named = ", ".join(f"{name}={spelled(iri)}" for name, iri in each.items())
            typer.echo(f"  {number}  {named}")
        number = 0
        while not 1 <= number <= len(solutions):
            number = typer.prompt("which", type=int, default=1)
        if self._live is not None:
            self._live.start()
        return solutions[number - 1]


def _tell(name: str, outcome: TaskOutcome) -> None:
    """Report how the task ended."""
    took = f"{outcome.ticks} tick{'s' if outcome.ticks != 1 else ''}, {outcome.seconds:.1f} s"
    if outcome.is_success:
        typer.echo(f"{name} has succeeded ({took})")
    else:
        reason = outcome.reason.text if outcome.reason else "no reason reported"
        output.complain(f"{name} has failed ({took}): {reason}")
