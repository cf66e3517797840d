"""The words that a shell completes, read without the modules that the command needs."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from importlib.util import find_spec
from pathlib import Path

Words = Callable[[str], list[tuple[str, str]]]
"""A completion of Typer: from the start of a word, the words with an explanation of each."""


def package_folder(package: str) -> Path:
    """The folder of a top-level package; the package is not imported."""
    spec = find_spec(package)
    if spec is None or not spec.submodule_search_locations:
        raise ModuleNotFoundError(package)
    return Path(spec.submodule_search_locations[0])


def codes(package: str) -> Words:
    """The codes of the diagnostics of a package, each with the name of the diagnostic."""

    def complete(incomplete: str) -> list[tuple[str, str]]:
        pages = package_folder(package) / "catalog" / "pages"
        return list(_codes(sorted(pages.glob(f"{_plain(incomplete.upper())}*.md"))))

    return complete


def _plain(text: str) -> str:
    """The letters and digits of a text: no character that has a meaning in path patterns."""
    return "".join(each for each in text if each.isalnum())


def _codes(pages: list[Path]) -> Iterator[tuple[str, str]]:
    for page in pages:
        with page.open(encoding="utf-8") as stream:
            _, _, name = stream.readline().lstrip("# ").rstrip().partition(" ")
        yield page.stem, name


def folders(package: str, below: str, holding: str) -> Words:
    """The folders of a package below a folder that contain a certain file, with the first line of
    the file.
    """

    def complete(incomplete: str) -> list[tuple[str, str]]:
        found = sorted((package_folder(package) / below).glob(f"*/{holding}"))
        return [
            (path.parent.name, _first_line(path))
            for path in found
            if path.parent.name.startswith(incomplete)
        ]

    return complete


def _first_line(path: Path) -> str:
    with path.open(encoding="utf-8") as stream:
        return stream.readline().lstrip("/# ").rstrip()
