"""Every file beside the code is installed with it."""

from __future__ import annotations

import re
from fnmatch import fnmatch
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_every_data_file_is_installed() -> None:
    project = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    section = project.partition("[tool.setuptools.package-data]")[2].partition("[tool.")[0]
    patterns = re.findall(r'"(\*?[\w.]+)"', section)
    files = [
        path.relative_to(ROOT)
        for package in ("campaign", "dslkit", "heron", "rossmarie")
        for path in (ROOT / "src" / package).rglob("*")
        if path.is_file() and path.suffix not in (".py", ".pyc")
    ]
    assert len(files) > 10
    assert [path for path in files if not any(fnmatch(path.name, one) for one in patterns)] == []
