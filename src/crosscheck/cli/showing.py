"""`crosscheck show` and `crosscheck impact`."""

from __future__ import annotations

import difflib
from collections.abc import Sequence
from pathlib import Path

import typer

from crosscheck.cli.loading import loaded
from crosscheck.cli.output import output
from crosscheck.impact import dependents
from crosscheck.picture import Pictured, pictured
from crosscheck.svg import svg_of


def run_show(
    rules: Path, svg: Path | None, systems: Sequence[Path], message_folders: Sequence[Path]
) -> None:
    """Print the skills with what rules have to do with them, or write a picture of that."""
    if svg is not None:
        if svg.suffix != ".svg":
            output.fail(f"{svg} does not end in .svg; choose another --svg", exit_code=2)
        output.try_file(svg)
    skills = list(pictured(loaded(rules, systems, message_folders)))
    if svg is None:
        typer.echo("\n\n".join(map(_reported, skills)))
        return
    output.save(svg, svg_of(skills))
    output.tell_written(svg)


def run_impact(
    skill: str, rules: Path, systems: Sequence[Path], message_folders: Sequence[Path]
) -> None:
    """Print what depends on a skill."""
    if skill.endswith(".ross"):
        output.fail(f"name the skill first: `crosscheck impact {rules} {skill}`", exit_code=2)
    robot = loaded(rules, systems, message_folders)
    found = robot.skills.skills.get(skill)
    if found is None:
        near = difflib.get_close_matches(skill, robot.skills.skills, n=1)
        meant = f"; did you mean `{near[0]}`?" if near else ""
        output.fail(f"there is no skill `{skill}`{meant}", exit_code=2)
    lines = [f"{each.what} {each.how} ({each.span})" for each in dependents(robot, found)]
    typer.echo("\n".join(lines) if lines else f"nothing depends on {skill}")


def _reported(skill: Pictured) -> str:
    parts = (
        ("has in its tree", skill.children),
        ("uses", skill.uses),
        ("permits", skill.permits),
        ("guarded by", [str(each) for each in skill.guards if not each.is_taken]),
        ("interrupted by", [str(each) for each in skill.guards if each.is_taken]),
        ("exempt from", skill.exempt_from),
        ("asked for by", skill.asked_by),
    )
    lines = [f"  {title}: {', '.join(names)}" for title, names in parts if names]
    return "\n".join([skill.name, *lines])
