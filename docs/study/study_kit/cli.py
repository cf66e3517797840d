"""The commands of the study kit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from enum import Enum
from pathlib import Path
from typing import Annotated, Any, NoReturn

import typer

from study_kit import sessions
from study_kit.faults import CONDITIONS, State

app = typer.Typer(
    help="Study kit: prepare sessions, watch them, and analyse their records.",
    add_completion=False,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)


class ConditionName(str, Enum):
    """The conditions, as the command line has them."""

    ROSSMARIE = "rossmarie"
    PYTHON = "python"
    CPP = "cpp"
    EZSKIROS = "ezskiros"
    SKIROS2 = "skiros2"


SessionFolder = Annotated[
    Path, typer.Argument(metavar="SESSION", help="The folder that `prepare` made.")
]


@app.command()
def prepare(
    participant: Annotated[str, typer.Argument(help="A pseudonym, such as P01.")],
    condition: Annotated[ConditionName, typer.Argument(help="The language of the session.")],
    out: Annotated[Path, typer.Option(metavar="DIR", help="The folder of all sessions.")] = Path(
        "sessions"
    ),
) -> None:
    """Make the folder of a session with its task sheet and its starting files."""
    with _telling():
        session = sessions.prepare(participant, CONDITIONS[condition.value], out)
    typer.echo(f"prepared {session.folder}: the participant works in {session.folder / 'work'}")


@app.command()
def watch(
    session: SessionFolder,
    minutes: Annotated[
        float, typer.Option(metavar="MINUTES", min=0.0, help="Length of the session.")
    ] = 25.0,
) -> None:
    """Record when each planted fault is fixed, until the time is over or Ctrl-C."""
    with _telling():
        sessions.watch(sessions.session_of(session), 60 * minutes, _tell)


def _tell(line: Mapping[str, Any]) -> None:
    counts = [
        f"{sum(each == state.value for each in line['faults'].values())} {state.value}"
        for state in State
    ]
    typer.echo(f"{line['time'][11:19]} {line['event']}: {', '.join(counts)}")


@app.command()
def analyse(
    folder: Annotated[Path, typer.Argument(metavar="SESSIONS", help="The folder of all sessions.")],
    out: Annotated[Path, typer.Option(metavar="DIR", help="The folder of the results.")] = Path(
        "results"
    ),
) -> None:
    """Write the report and the figure of a study."""
    from study_kit.analysis import analyse as analysed
    from study_kit.figure import draw
    from study_kit.records import read_study
    from study_kit.report import report

    with _telling():
        study = read_study(folder)
        out.mkdir(parents=True, exist_ok=True)
        (out / "report.md").write_text(report(study, analysed(study)), encoding="utf-8")
        draw(study, out / "figure.svg")
    typer.echo(f"wrote {out / 'report.md'} and {out / 'figure.svg'}")


@app.command()
def simulate(
    out: Annotated[Path, typer.Argument(metavar="DIR", help="A new folder for the records.")],
    participants: Annotated[int, typer.Option(min=1, help="How many participants.")] = 12,
    seed: Annotated[int, typer.Option(help="Seed of all that is random.")] = 1,
    effect: Annotated[
        bool, typer.Option(help="Put in that our languages are faster and more usable.")
    ] = True,
) -> None:
    """Write the records of simulated participants."""
    from study_kit import simulate as simulation

    if out.exists():
        _fail(f"{out} exists already: choose a new folder")
    with _telling():
        effects = simulation.Effects() if effect else simulation.NONE
        simulation.simulate(out, participants, seed, effects)
    typer.echo(f"wrote the records of {participants} simulated participants to {out}")


@app.command()
def matrix() -> None:
    """Run all tools over all faults, and write the matrix; this takes minutes."""
    from study_kit.matrix import PAGE, write_matrix

    with _telling():
        write_matrix()
    typer.echo(f"wrote {PAGE.name}")


@contextmanager
def _telling() -> Iterator[None]:
    """Within, a mistake of the user ends the run with one line."""
    try:
        yield
    except sessions.SessionError as problem:
        _fail(str(problem))
    except OSError as problem:
        _fail(f"{problem.filename or ''}: {problem.strerror or problem}".removeprefix(": "))


def _fail(message: str) -> NoReturn:
    typer.echo(f"study: {message}", err=True)
    raise typer.Exit(2)
