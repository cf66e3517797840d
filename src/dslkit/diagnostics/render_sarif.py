"""Findings as SARIF 2.1.0, the format that code hosts and editors read.

Columns count code points from 1, as everywhere in this project, and the SARIF run declares this.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote

from dslkit.diagnostics.model import Diagnostic, Edit, Fix, Label, Severity
from dslkit.diagnostics.render_json import Json
from dslkit.source import SourceFile, Span

_SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"


@dataclass(frozen=True)
class SarifRule:
    """The meaning of a code; `help` is its page, in Markdown."""

    code: str
    name: str
    severity: Severity
    summary: str
    help: str


@dataclass(frozen=True)
class Tool:
    """The tool that reported the findings. `rules` has an entry for each code of the tool; codes of
    other tools have none.
    """

    name: str
    version: str
    rules: Sequence[SarifRule]


def render_sarif(diagnostics: Sequence[Diagnostic], tool: Tool) -> str:
    """A SARIF log with one run, in ASCII, with a final newline."""
    index = {rule.code: number for number, rule in enumerate(tool.rules)}
    run: Json = {
        "tool": {
            "driver": {
                "name": tool.name,
                "semanticVersion": tool.version,
                "rules": [_rule(rule) for rule in tool.rules],
            }
        },
        "columnKind": "unicodeCodePoints",
        "results": [_result(found, index.get(found.code)) for found in diagnostics],
    }
    return json.dumps({"$schema": _SCHEMA, "version": "2.1.0", "runs": [run]}, indent=2) + "\n"


def _rule(rule: SarifRule) -> Json:
    return {
        "id": rule.code,
        "name": "".join(word.capitalize() for word in rule.name.split("-")),
        "shortDescription": {"text": rule.summary},
        "help": {"text": rule.help, "markdown": rule.help},
        "defaultConfiguration": {"level": rule.severity.value},
    }


def _result(found: Diagnostic, rule_index: int | None) -> Json:
    result: dict[str, Json] = {
        "ruleId": found.code,
        **({} if rule_index is None else {"ruleIndex": rule_index}),
        "level": found.severity.value,
        "message": {"text": _message(found)},
        "locations": [{"physicalLocation": _location(found.primary.span)}],
    }
    if found.labels:
        related = enumerate(found.labels, start=1)
        result["relatedLocations"] = [_related(number, label) for number, label in related]
    if found.fix is not None:
        result["fixes"] = [_fix(found.fix)]
    return result


def _message(found: Diagnostic) -> str:
    lines = [found.title, found.primary.text, *found.notes, found.help]
    return "\n".join(line for line in lines if line)


def _related(number: int, label: Label) -> Json:
    return {
        "id": number,
        "physicalLocation": _location(label.span),
        "message": {"text": label.text},
    }


def _location(span: Span) -> Json:
    return {"artifactLocation": _artifact(span.file), "region": _region(span)}


def _artifact(file: SourceFile) -> Json:
    path = Path(file.path)
    quoted = quote(path.as_posix(), errors="surrogateescape")
    return {"uri": f"file://{quoted}" if path.is_absolute() else quoted}


def _region(span: Span) -> Json:
    begin, finish = span.begin, span.finish
    return {
        "startLine": begin.line,
        "startColumn": begin.column,
        "endLine": finish.line,
        "endColumn": finish.column,
    }


def _fix(fix: Fix) -> Json:
    by_file: dict[SourceFile, list[Edit]] = {}
    for edit in fix.edits:
        by_file.setdefault(edit.span.file, []).append(edit)
    changes = [
        {
            "artifactLocation": _artifact(file),
            "replacements": [_replacement(edit) for edit in edits],
        }
        for file, edits in by_file.items()
    ]
    return {"description": {"text": fix.title}, "artifactChanges": changes}


def _replacement(edit: Edit) -> Mapping[str, Json]:
    return {
        "deletedRegion": _region(edit.span),
        "insertedContent": {"text": edit.replacement},
    }
