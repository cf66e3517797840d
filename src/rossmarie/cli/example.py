"""`rossmarie example`: the built-in robots, listed or copied."""

from __future__ import annotations

from pathlib import Path

import typer

from dslkit.examples import UnknownExampleError
from rossmarie.cli.output import output
from rossmarie.driver.robots import BuiltInRobot, robot, robots


def run_example(name: str | None, folder: Path | None) -> None:
    """List the robots, or copy the robot with this name into a folder."""
    if name is None:
        _list_robots()
        return
    try:
        wanted = robot(name)
    except UnknownExampleError as error:
        output.fail(str(error), exit_code=2)
    _copy(wanted, folder or Path(wanted.name))


def _list_robots() -> None:
    there_are = robots()
    width = max(len(each.name) for each in there_are)
    for each in there_are:
        typer.echo(f"{each.name:{width}}  {each.summary}")


def _copy(wanted: BuiltInRobot, folder: Path) -> None:
    output.copy_example(wanted.folder, folder)
    rules, recording = (folder / path.name for path in (wanted.rules, wanted.recording))
    typer.echo(f"now try: rossmarie replay {rules} {recording}")
