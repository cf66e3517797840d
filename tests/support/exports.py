"""Exports for tests: skills files in, `skills.json` out."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from ezskiros.ontology.load import VARIABLE
from support import command_line
from support.json_schema import faults

SCHEMA: dict[str, Any] = json.loads(
    (Path(__file__).parents[2] / "src/ezskiros/export/skills.schema.json").read_text("utf-8")
)


def export(*paths: Path, out: Path, ontology: Path | None = None) -> dict[str, Any]:
    """The output of `ezskiros export`, which matches its schema."""
    variables = {VARIABLE: str(ontology)} if ontology else {}
    done = command_line.run("ezskiros", "export", *paths, "-o", out, variables=variables)
    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    found: dict[str, Any] = json.loads(out.read_text("utf-8"))
    assert faults(found, SCHEMA) == []
    return found


def named(found: list[dict[str, Any]]) -> dict[str, dict[str, Any]]:
    """The members of a list of an export by their names."""
    return {each["name"]: each for each in found}
