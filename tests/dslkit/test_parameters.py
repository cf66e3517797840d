"""Values of commands: read without pydantic, understood as typer does, refused in plain words."""

from __future__ import annotations

import enum
from pathlib import Path
from typing import Annotated, Any

import pytest
import typer
from typer.testing import CliRunner, Result

from dslkit.parameters import Group


class Colour(str, enum.Enum):
    RED = "red"
    BLUE = "blue"


def _even(text: str) -> int:
    if int(text) % 2:
        raise typer.BadParameter(f"{text} is odd")
    return int(text)


def program(**options: Any) -> typer.Typer:
    app = typer.Typer(add_completion=False, **options)

    @app.callback()
    def whole(verbose: bool = False) -> None:
        typer.echo(verbose)

    @app.command()
    def paint(
        files: list[Path],
        colour: Colour = Colour.RED,
        folders: Annotated[list[Path] | None, typer.Option(exists=True, file_okay=False)] = None,
        files_only: Annotated[Path | None, typer.Option(dir_okay=False)] = None,
        layers: Annotated[int, typer.Option(min=1)] = 1,
        seconds: Annotated[float, typer.Option(min=0.5)] = 1.0,
        even: Annotated[int, typer.Option(parser=_even)] = 2,
        name: str = "x",
        names: Annotated[list[str] | None, typer.Option()] = None,
        is_dry: bool = False,
    ) -> None:
        """Paint."""
        values = [files, colour, folders, files_only, layers, seconds, even, name, names]
        typer.echo([*values, is_dry])

    return app


COMMANDS = (
    "a.txt",
    "a.txt b/../c.txt --colour blue --is-dry --name y --names p --names q",
    "a.txt --folders . --folders ..",
    "a.txt --folders nowhere/./at/all",
    "a.txt --folders file",
    "a.txt --files-only file",
    "a.txt --files-only .",
    "a.txt --files-only new",
    "a.txt --layers 3 --seconds 2 --even 4",
    "a.txt --even 3",
    "",
    "--help",
    "a.txt --nothing",
)
REFUSED = {
    "a.txt --colour BLUE": "--colour': 'BLUE' is not one of 'red', 'blue'.",
    "a.txt --layers 0": "it has to be greater than or equal to 1",
    "a.txt --layers x": "`x` is not a whole number",
    "a.txt --seconds 0.1": "it has to be greater than or equal to 0.5",
    "a.txt --seconds x": "`x` is not a number",
    "a.txt --even x": "--even': invalid literal",
}
"""Words of a command line, and a part of the answer that differs from typer's."""


@pytest.mark.parametrize("words", COMMANDS)
def test_values_and_errors_are_those_of_typer(
    words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "file").touch()
    ours, theirs = (ran(program(**each), words) for each in ({"cls": Group}, {}))
    assert (ours.exit_code, ours.output) == (theirs.exit_code, theirs.output)
    assert type(ours.exception) is type(theirs.exception)


@pytest.mark.parametrize("words", REFUSED)
def test_errors_of_pydantic_are_told_in_plain_words(words: str) -> None:
    ours, theirs = (ran(program(**each), words) for each in ({"cls": Group}, {}))
    assert ours.exit_code == theirs.exit_code == 2
    assert REFUSED[words] in ours.output
    assert REFUSED[words] not in theirs.output


def ran(app: typer.Typer, words: str) -> Result:
    return CliRunner().invoke(app, ["paint", *words.split()])
