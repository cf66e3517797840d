"""Skills files, and scenes, through the whole check, compared with the expectations in them and
in the ontologies that they load.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from dslkit.diagnostics import Diagnostic
from ezskiros.driver import check_paths
from support import expectations

ONTOLOGY = Path(__file__).parents[1] / "fixtures" / "ezskiros" / "ontology"
"""Small, and what examples of skills load."""
SIGN = "#"
CHECKED = (".py", ".turtle")


def findings(paths: Iterable[Path]) -> Sequence[Diagnostic]:
    """The findings on the skills and scenes among some files, with the launch values in one of
    them.
    """
    paths = list(paths)
    values = next((path for path in paths if path.suffix == ".yaml"), None)
    return check_paths([path for path in paths if path.suffix in CHECKED], values).diagnostics


def compare_files(files: Sequence[Path], *, bless: bool) -> list[str]:
    """The differences between the findings on some files and their expectations.

    Skills and scenes among them are checked together. The skills load the ontologies among them.
    """
    found = findings(files)
    problems = []
    for file in files:
        own = [one for one in found if _is_in(one, file)]
        text = file.read_text(encoding="utf-8")
        if bless:
            file.write_text(expectations.bless(text, own, SIGN), encoding="utf-8")
        else:
            problems += expectations.compare(text, own, SIGN)
    elsewhere = [one for one in found if not any(_is_in(one, file) for file in files)]
    return problems + [f"found, not expected: {one.primary.span}: {one.title}" for one in elsewhere]


def codes_in(files: Iterable[Path]) -> set[str | None]:
    """The codes of the findings that are expected in some files."""
    texts = [file.read_text(encoding="utf-8") for file in files]
    return {expected.code for text in texts for expected in expectations.parse(text, SIGN)}


def _is_in(found: Diagnostic, file: Path) -> bool:
    """Paths of findings are as they were given: some relative to the current folder."""
    return Path(found.primary.span.file.path).resolve() == file.resolve()
