"""Arguments and options of several subcommands."""

from __future__ import annotations

import enum
import re
from pathlib import Path
from typing import Annotated, Any

import typer

from dslkit.completion import codes, folders
from dslkit.options import ReportFormat
from rossmarie.ir.filing import Category
from rossmarie.targets.manifest import BadFieldError, Maintainer, parse_license, parse_maintainer


def written(text: str) -> Path:
    """A path to write to. An empty path is refused, because it would mean the current folder."""
    if not text:
        raise typer.BadParameter("the path is empty")
    return Path(text)


def ros_name(text: str) -> str:
    """A name that ROS and CMake accept for a package and for a node."""
    if not re.fullmatch("[a-z][a-z0-9_]*", text):
        raise typer.BadParameter(f"`{text}` is not a package name: use a-z, 0-9 and _")
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
        raise typer.BadParameter(f"`{text}` is not one of {known}") from None


def _maintainer(text: str) -> Maintainer:
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
            raise typer.BadParameter(f"`{word}` is not one of {', '.join(values)}")
        return kind(word.lower())

    return typer.Option(
        help=text, parser=parse, metavar="|".join(values), autocompletion=lambda: values
    )


_RECORDINGS = (".bag", ".csv", ".db3", ".mcap")


def _rules(path: Path) -> Path:
    """The path, if it can be the path of a rules file; a file of another kind ends the run."""
    suffix = path.suffix.lower()
    if suffix in _RECORDINGS:
        raise typer.BadParameter(
            f"{path} is a recording, not a rules file (.ross); name the rules file first"
        )
    if suffix == ".py":
        raise typer.BadParameter(f"{path} is a Python file: `ezskiros check {path}` checks skills")
    return path


# Typer fails in Python 3.10 if a callback has the type `list[Path]`.
def _all_rules(paths: list[Path] | None) -> list[Path] | None:
    return paths and [_rules(path) for path in paths]


def _recordings(paths: list[Path] | None) -> list[Path] | None:
    """The paths, if they can be paths of recordings; a rules file ends the run."""
    for path in paths or ():
        if path.suffix.lower() == ".ross":
            raise typer.BadParameter(
                f"{path} is a rules file: name one rules file first, then recordings"
            )
    return paths


# Not `readable`: an unreadable file is an ordinary finding (ROSS801, ROSS611).
Rules = Annotated[
    Path,
    typer.Argument(metavar="RULES", help="A rules file (.ross).", readable=False, callback=_rules),
]
RulesFiles = Annotated[
    list[Path],
    typer.Argument(
        metavar="RULES...", help="Rules files (.ross).", readable=False, callback=_all_rules
    ),
]
Recordings = Annotated[
    list[Path],
    typer.Argument(
        metavar="RECORDINGS...",
        help="Recordings: .bag, .db3, .mcap, a bag folder, or .csv.",
        readable=False,
        callback=_recordings,
    ),
]
Systems = Annotated[
    list[Path] | None,
    typer.Option("--system", metavar="FILE", help="An additional system model.", readable=False),
]
MessageFolders = Annotated[
    list[Path] | None,
    typer.Option(
        "--messages",
        metavar="DIR",
        help="A folder with message definitions (.msg).",
        exists=True,
        file_okay=False,
    ),
]

Licenses = Annotated[
    list[str] | None,
    typer.Option(
        "--license", metavar="NAME", help="The license of the ROS package.", parser=_license
    ),
]
Maintainers = Annotated[
    list[Maintainer] | None,
    typer.Option(
        "--maintainer",
        metavar='"NAME <MAIL>"',
        help="The maintainer of the ROS package.",
        parser=_maintainer,
    ),
]
ListOfSources = Annotated[
    Path | None,
    typer.Option(
        "--sources",
        metavar="FILE",
        help="Also write a list of all source files of the rules.",
        parser=written,
    ),
]
_OUT = typer.Option("--out", "-o", metavar="FILE", help="The output file.", parser=written)
OutFile = Annotated[Path, _OUT]
OptionalOutFile = Annotated[Path | None, _OUT]
ProofsFile = Annotated[
    Path | None,
    typer.Option(metavar="FILE", help="The report of `verify --out`.", readable=False),
]
WithSkills = Annotated[bool, typer.Option("--skills", help="Also check rules and skills together.")]
CoverageFile = Annotated[
    Path | None,
    typer.Option(metavar="FILE", help="The report of `coverage --out`.", readable=False),
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
        help="Also write a page with the rules next to their C.",
        parser=written,
    ),
]

Compared = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        help="Draw a second run below the first: another recording, or another version of the rules"
        " (.ross). Needs --out.",
        readable=False,
    ),
]
ReportFolder = Annotated[
    Path | None,
    typer.Option(
        "--out",
        "-o",
        metavar="DIR",
        help="Write timeline.html and verdicts.jsonl into this folder. Each of several recordings"
        " gets its own folder.",
        parser=written,
    ),
]
Toggle = Annotated[
    float | None,
    typer.Option(
        metavar="SECONDS",
        min=0.0,
        help="With --thorough: report rules that can become active again within SECONDS after they"
        " have cleared; default: 1.",
    ),
]
Witnesses = Annotated[
    Path | None,
    typer.Option(
        metavar="PATH",
        help="Write the traces of findings into this folder, or as tests into a .ross file.",
        parser=written,
    ),
]
ProverTimeout = Annotated[
    int,
    typer.Option(
        metavar="SECONDS",
        min=1,
        help="The CPU-time limit of each solver for one query.",
    ),
]
ProverFolder = Annotated[
    Path | None,
    typer.Option(
        metavar="DIR", help="Save the input files of the prover in this folder.", parser=written
    ),
]

Code = Annotated[
    str,
    typer.Argument(
        metavar="CODE", help="A code or name, such as ROSS301.", autocompletion=codes("rossmarie")
    ),
]

RobotName = Annotated[
    str | None,
    typer.Argument(
        metavar="ROBOT",
        help="The name of a robot, such as turtlebot4.",
        autocompletion=folders("rossmarie", "robots", "system.ross"),
    ),
]
RobotFolder = Annotated[
    Path | None,
    typer.Argument(metavar="DIR", help="The output folder; default: ./ROBOT.", parser=written),
]

Only = Annotated[
    list[Category] | None,
    typer.Option(
        "--only",
        metavar="CATEGORY",
        help="Use only rules of this category, such as human or 'task dependent'.",
        parser=_category,
    ),
]

TopicMap = Annotated[
    list[str] | None,
    typer.Option(
        "--topic-map",
        metavar="RULES=RECORDED",
        help="Read the topic RULES of the rules from the recorded topic RECORDED.",
    ),
]
