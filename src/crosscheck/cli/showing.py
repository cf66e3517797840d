"""`crosscheck show` and `crosscheck impact`."""

from __future__ import annotations

import difflib
import json
from collections.abc import Sequence
from pathlib import Path

import typer

from crosscheck.cli.choices import ShowFormat
from crosscheck.cli.loading import loaded
from crosscheck.cli.output import output
from crosscheck.impact import dependents
from crosscheck.picture import Pictured, pictured
from crosscheck.svg import svg_of
from dslkit.diagnostics.render_json import Json, place
from dslkit.options import ReportFormat
from dslkit.ownership import Comment

_COMMENTS = {ShowFormat.TEXT: Comment.HASH}


def run_show(
    rules: Path,
    form: ShowFormat,
    out: Path | None,
    systems: Sequence[Path],
    message_folders: Sequence[Path],
) -> None:
    """Print the skills with their rules, or write them to `out`."""
    with output.answering(form, "show", files=1) as answer:
        output.try_file(out)
        skills = list(pictured(loaded(rules, systems, message_folders)))
        answer.result = {"skills": [_skill(each) for each in skills]}
        text = _drawn(skills, form)
        if out is not None:
            output.save(out, text, _COMMENTS.get(form))
            output.tell_written(out)
        elif not answer.is_printed:
            typer.echo(text, nl=False)


def _drawn(skills: Sequence[Pictured], form: ShowFormat) -> str:
    match form:
        case ShowFormat.TEXT:
            return "\n\n".join(map(_reported, skills)) + "\n"
        case ShowFormat.SVG:
            return svg_of(skills)
        case ShowFormat.JSON:
            document = {"generator": output.tool, "skills": [_skill(each) for each in skills]}
            return json.dumps(document, indent=2) + "\n"


def _skill(skill: Pictured) -> Json:
    return {
        "name": skill.name,
        "children": skill.children,
        "uses": skill.uses,
        "permits": skill.permits,
        "guards": [
            {"rule": each.rule, "uses": each.resource, "interrupts": each.is_taken}
            for each in skill.guards
        ],
        "exempt_from": skill.exempt_from,
        "asked_for_by": skill.asked_by,
    }


def run_impact(
    skill: str,
    rules: Path,
    form: ReportFormat,
    systems: Sequence[Path],
    message_folders: Sequence[Path],
) -> None:
    """Print everything that depends on a skill."""
    with output.answering(form, "impact", files=1) as answer:
        if skill.endswith(".ross"):
            output.fail(f"name the skill first: `crosscheck impact {rules} {skill}`", exit_code=2)
        robot = loaded(rules, systems, message_folders)
        found = robot.skills.skills.get(skill)
        if found is None:
            near = difflib.get_close_matches(skill, robot.skills.skills, n=1)
            meant = f"; did you mean `{near[0]}`?" if near else ""
            output.fail(f"there is no skill `{skill}`{meant}", exit_code=2)
        dependent = list(dependents(robot, found))
        answer.result = {
            "dependents": [
                {"name": each.what, "reason": each.how, "place": place(each.span)}
                for each in dependent
            ]
        }
        if answer.is_printed:
            return
        lines = [f"{each.what} {each.how} ({each.span})" for each in dependent]
        typer.echo("\n".join(lines) if lines else f"nothing depends on {skill}")


def _reported(skill: Pictured) -> str:
    parts = (
        ("has in its tree", skill.children),
        ("uses", skill.uses),
        ("permits", skill.permits),
        ("guarded by", [str(each) for each in skill.guards if not each.is_taken]),
        ("interrupted by", [str(each) for each in skill.guards if each.is_taken]),
        ("exempt from", skill.exempt_from),
        ("queried by", skill.asked_by),
    )
    lines = [f"  {title}: {', '.join(names)}" for title, names in parts if names]
    return "\n".join([skill.name, *lines])
