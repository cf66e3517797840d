"""Files of skills for rules: those of the fixtures, which examples in the documentation name."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).parents[1] / "fixtures" / "skills"
FILE = FOLDER / "skills.json"
DIGEST = "5b" * 32
"""The digest of that file."""


def put_skills(folder: Path) -> None:
    """Copy all files of skills into a folder."""
    for file in FOLDER.glob("*.json"):
        shutil.copy(file, folder)


def content() -> dict[str, Any]:
    """The contents of the file, to be changed."""
    found: dict[str, Any] = json.loads(FILE.read_text(encoding="utf-8"))
    return found
