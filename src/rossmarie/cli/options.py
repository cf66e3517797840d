"""Arguments and options that several subcommands take."""

from __future__ import annotations

import enum
import re
from pathlib import Path
from typing import Annotated, Any

import typer

from dslkit.command_line import ReportFormat
from dslkit.completion import codes, folders
from rossmarie.ir.filing import Category
from rossmarie.targets.manifest import BadFieldError, Person, parse_license, parse_maintainer


def written(text: str) -> Path:
    """A path to write to. An empty path is refused, because it would mean the current folder."""
    if not text:
        raise typer.BadParameter("the path is empty")
    return Path(text)


def ros_name(text: str) -> str:
    """A name that ROS and CMake accept for a package and for a node."""
    if not re.fullmatch("[a-z][a-z0-9_]*", text):
        raise typer.BadParameter(f"`{text}` is no name of a package: it takes a-z, 0-9 and _")
    return text


def _license(text: str) -> str:
    try:
        return parse_license(text)
    except BadFieldError as error:
        raise typer.BadParameter(str(error)) from None


def _category(text: str) -> Category:
    try:
        return Category(" ".join(text.lower().split()))
    except ValueError:
        known = ", ".join(f"`{each.value}`" for each in Category)
        raise typer.BadParameter(f"`{text}` is none of {known}") from None


def _maintainer(text: str) -> Person:
    try:
        return parse_maintainer(text)
    except BadFieldError as error:
        raise typer.BadParameter(str(error)) from None


def choice(kind: type[enum.Enum], text: str) -> Any:
    """An option with the values of `kind`, in upper or lower case."""
    values = [str(member.value) for member in kind]

    def parse(word: str) -> enum.Enum:
        if isinstance(word, kind):
            return word  # the default
        if word.lower() not in values:
            raise typer.BadParameter(f"`{word}` is none of {', '.join(values)}")
        return kind(word.lower())

    return typer.Option(
        help=text, parser=parse, metavar="|".join(values), autocompletion=lambda: values
    )


# Not `readable`: an unreadable file is a finding like others (ROSS801, ROSS611).
Rules = Annotated[Path, typer.Argument(metavar="RULES", help="A .ross file.", readable=False)]
RulesFiles = Annotated[
    list[Path], typer.Argument(metavar="RULES...", help=".ross files.", readable=False)
]
Recordings = Annotated[
    list[Path],
    typer.Argument(
        metavar="RECORDINGS...", help=".bag, .db3, .mcap, bag folders, or .csv.", readable=False
    ),
]
Systems = Annotated[
    list[Path] | None,
    typer.Option(
        "--system", metavar="FILE", help="A system model beside those imported.", readable=False
    ),
]
MessageFolders = Annotated[
    list[Path] | None,
    typer.Option(
        "--messages", metavar="DIR", help="A folder with .msg files.", exists=True, file_okay=False
    ),
]

Licenses = Annotated[
    list[str] | None,
    typer.Option(
        "--license", metavar="NAME", help="The licence of a package for ROS.", parser=_license
    ),
]
Maintainers = Annotated[
    list[Person] | None,
    typer.Option(
        "--maintainer",
        metavar='"NAME <MAIL>"',
        help="Who maintains a package for ROS.",
        parser=_maintainer,
    ),
]
ListOfSources = Annotated[
    Path | None,
    typer.Option(
        "--sources",
        metavar="FILE",
        help="Also write a list of all files that the rules rest on.",
        parser=written,
    ),
]
_OUT = typer.Option("--out", "-o", metavar="FILE", help="Write this file.", parser=written)
OutFile = Annotated[Path, _OUT]
OptionalOutFile = Annotated[Path | None, _OUT]
ProofsFile = Annotated[
    Path | None,
    typer.Option(metavar="FILE", help="A report of what was proved, as JSON.", readable=False),
]
WithSkills = Annotated[
    bool, typer.Option("--skills", help="Also look at rules and skills together.")
]
CoverageFile = Annotated[
    Path | None,
    typer.Option(metavar="FILE", help="A report of what was exercised, as JSON.", readable=False),
]


def _report_for(option: str) -> Any:
    """The option for the report file that `option` of `rossmarie report` reads."""
    help = f"Write a file for `rossmarie report {option}`."
    return typer.Option("--out", "-o", metavar="FILE", help=help, parser=written)


CoverageReport = Annotated[Path | None, _report_for("--coverage")]
ProofsReport = Annotated[Path | None, _report_for("--verification")]
AnswerFormat = Annotated[ReportFormat, choice(ReportFormat, "The format of findings and result.")]
ReviewPage = Annotated[
    Path | None,
    typer.Option(
        "--review",
        metavar="FILE",
        help="Also write a page of the rules beside their C.",
        parser=written,
    ),
]

ReportFolder = Annotated[
    Path | None,
    typer.Option(
        "--out",
        "-o",
        metavar="DIR",
        help="Write timeline.html and verdicts.jsonl here; of several recordings, each into a"
        " folder of its name.",
        parser=written,
    ),
]
ProverTimeout = Annotated[
    int,
    typer.Option(
        metavar="SECONDS",
        min=1,
        help="The processor time of each solver for one query.",
    ),
]
ProverFolder = Annotated[
    Path | None,
    typer.Option(
        metavar="DIR", help="Write what the prover gets here, to ask again.", parser=written
    ),
]

Code = Annotated[
    str,
    typer.Argument(metavar="CODE", help="Such as ROSS301.", autocompletion=codes("rossmarie")),
]

RobotName = Annotated[
    str | None,
    typer.Argument(
        metavar="ROBOT",
        help="Such as turtlebot4.",
        autocompletion=folders("rossmarie", "robots", "system.ross"),
    ),
]
RobotFolder = Annotated[
    Path | None,
    typer.Argument(metavar="DIR", help="The folder to write to; else ./ROBOT.", parser=written),
]

Only = Annotated[
    list[Category] | None,
    typer.Option(
        "--only",
        metavar="CATEGORY",
        help="Of the rules only those of this category, such as human or 'task dependent'.",
        parser=_category,
    ),
]

TopicMap = Annotated[
    list[str] | None,
    typer.Option(
        "--topic-map",
        metavar="RULES=RECORDED",
        help="Read the topic that the rules call RULES from the recorded topic RECORDED.",
    ),
]
