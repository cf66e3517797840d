"""Knowledge from runs as a file: lessons, and a digest of the records behind them.

The schema is `knowledge.schema.json` beside this module (docs/reference/knowledge-file.md).
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from dslkit.diagnostics import Diagnostic
from dslkit.source import Span
from ezskiros.export.sources import ExportedSource, path_from
from ezskiros.learning.errors import NoKnowledge
from ezskiros.learning.lessons import Cost, Lessons, Places, Share, SkillFailure, Stale, Trip
from ezskiros.learning.records import RecordError, RecordLine, parsed, read_text
from ezskiros.learning.runs import TaskRun

FORMAT = "ezskiros/knowledge"
VERSION = 1
_HEXADECIMAL = re.compile(r"[0-9a-f]{64}")


@dataclass(frozen=True)
class Knowledge:
    """Lessons, and the records from which they were learnt."""

    lessons: Lessons
    sources: Sequence[ExportedSource]


def known(lessons: Lessons, runs: Iterable[TaskRun], folder: Path) -> Knowledge:
    """Lessons with the records of their runs, with paths relative to a folder."""
    files = {file for run in runs for file in (run.trace.file, run.verdicts.file)}
    return Knowledge(
        lessons, sorted(ExportedSource(path_from(folder, each.path), each.sha256) for each in files)
    )


# --- writing --------------------------------------------------------------------------------------


def text_of(knowledge: Knowledge) -> str:
    """The text of the file, with a final newline."""
    lessons = knowledge.lessons
    head = {
        "format": FORMAT,
        "version": VERSION,
        "digest": _digest(knowledge.sources),
        "runs": lessons.runs,
    }
    lists = {
        "sources": [{"path": each.path, "sha256": each.sha256} for each in knowledge.sources],
        "trips": [_trip(each) for each in lessons.trips],
        "failures": [
            {"skill": each.skill, **_share(each.share), "reason": each.reason}
            for each in lessons.failures
        ],
        "costs": [
            {
                "skill": each.skill,
                "places": dict(each.places),
                "executions": each.executions,
                "activations": each.activations,
                "lost_s": each.lost_s,
            }
            for each in lessons.costs
        ],
        "stale": [{"rule": each.rule, **_share(each.share)} for each in lessons.stale],
    }
    parts = [f"  {json.dumps(key)}: {json.dumps(value)}" for key, value in head.items()]
    parts += [f"  {json.dumps(key)}: {_in_lines(value)}" for key, value in lists.items()]
    return "{\n" + ",\n".join(parts) + "\n}\n"


def _in_lines(found: Sequence[Mapping[str, Any]]) -> str:
    """A list with one object in each line, so that differences are readable."""
    if not found:
        return "[]"
    return "[\n" + ",\n".join(f"    {json.dumps(each)}" for each in found) + "\n  ]"


def _trip(found: Trip) -> dict[str, Any]:
    return {
        "rule": found.rule,
        "skill": found.skill,
        **_share(found.share),
        "activations": found.activations,
        "lost_s": found.lost_s,
        "within": dict(found.within),
        "at": [{"places": dict(each), **_share(share)} for each, share in found.at.items()],
        "evidence": found.evidence,
    }


def _share(found: Share) -> dict[str, int]:
    return {"runs": found.runs, "all_runs": found.all}


def _digest(sources: Iterable[ExportedSource]) -> str:
    lines = [f"{FORMAT} {VERSION}", *(f"{each.sha256}  {each.path}" for each in sorted(sources))]
    return hashlib.sha256("\n".join(lines).encode("utf-8", "surrogatepass")).hexdigest()


# --- reading --------------------------------------------------------------------------------------


def read_knowledge(path: Path) -> Knowledge | Diagnostic:
    """The knowledge in a file, or the finding for an invalid file. Raises `OSError` if the file
    cannot be read.
    """
    try:
        file = read_text(path, NoKnowledge)
        try:
            found = parsed(file.text)
        except json.JSONDecodeError as problem:
            why = f"it is not JSON: {problem.msg}"
            at = Span(file, problem.pos, min(problem.pos + 1, len(file.text)))
            return NoKnowledge(path=file.path, reason=why).at(at)
        except (ValueError, RecursionError) as problem:
            why = str(problem) if isinstance(problem, ValueError) else "it is nested too deeply"
            return NoKnowledge(path=file.path, reason=why).at(Span(file, 0, 0))
        if not isinstance(found, dict):
            found = {}
        return _read(RecordLine(Span(file, 0, len(file.text)), found, NoKnowledge))
    except RecordError as problem:
        return problem.diagnostic


def _read(head: RecordLine) -> Knowledge:
    if head.values.get("format") != FORMAT:
        head.fail(f"its `format` is not `{FORMAT}`", "format")
    if head.get("version", int) != VERSION:
        head.fail(
            f"its `version` is not {VERSION}, the only version that this EzSkiROS reads", "version"
        )
    sources = [_source(each) for each in head.objects("sources")]
    if head.get("digest", str) != _digest(sources):
        head.fail("its `digest` does not match its `sources`", "digest")
    lessons = Lessons(
        head.count("runs"),
        [_read_trip(each) for each in head.objects("trips")],
        [
            SkillFailure(each.get("skill", str), _read_share(each), each.get("reason", str))
            for each in head.objects("failures")
        ],
        [_read_cost(each) for each in head.objects("costs")],
        [Stale(each.get("rule", str), _read_share(each)) for each in head.objects("stale")],
    )
    return Knowledge(lessons, sources)


def _source(found: RecordLine) -> ExportedSource:
    sha256 = found.get("sha256", str)
    if _HEXADECIMAL.fullmatch(sha256) is None:
        found.fail("`sha256` is not 64 hexadecimal digits", "sources")
    return ExportedSource(found.get("path", str), sha256)


def _read_trip(found: RecordLine) -> Trip:
    within = found.below(found.get("within", dict))
    return Trip(
        found.get("rule", str),
        None if found.values.get("skill") is None else found.get("skill", str),
        _read_share(found),
        found.count("activations"),
        found.seconds("lost_s"),
        {name: within.count(name) for name in within.values},
        {_read_places(each): _read_share(each) for each in found.objects("at")},
        found.get("evidence", str),
    )


def _read_cost(found: RecordLine) -> Cost:
    return Cost(
        found.get("skill", str),
        _read_places(found),
        found.count("executions"),
        found.count("activations"),
        found.seconds("lost_s"),
    )


def _read_share(found: RecordLine) -> Share:
    runs, all_runs = found.count("runs"), found.count("all_runs")
    if runs > all_runs:
        found.fail("`runs` is more than `all_runs`", "all_runs")
    return Share(runs, all_runs)


def _read_places(found: RecordLine) -> Places:
    places = found.below(found.get("places", dict))
    return tuple(sorted((name, places.get(name, str)) for name in places.values))
