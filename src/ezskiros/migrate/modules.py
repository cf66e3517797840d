"""The imports of skills between files."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from pathlib import Path

from ezskiros.skills.importing import module_name


def import_of(path: str, target: str) -> str:
    """The relative module name under which the file `path` imports the file `target`, such as
    `.arm_skills`.
    """
    own, own_root = module_name(Path(path).resolve())
    other, other_root = module_name(Path(target).resolve())
    package = own.split(".")[:-1]
    if own_root != other_root or not package:
        return other
    parts = other.split(".")
    common = 0
    while common < min(len(package), len(parts) - 1) and package[common] == parts[common]:
        common += 1
    if not common:
        return other
    return "." * (len(package) - common + 1) + ".".join(parts[common:])


def imported_files(path: str, sources: Iterable[str], files: Collection[str]) -> set[str]:
    """The files that a file imports when it runs, given the names of its imported modules."""
    by_name = {module_name(Path(each).resolve()): each for each in files}
    own, root = module_name(Path(path).resolve())
    found = set()
    for source in sources:
        name = source.lstrip(".")
        level = len(source) - len(name)
        package = own.split(".")[: -level or None] if level else []
        full = ".".join([*package, *filter(None, [name])])
        found |= {by_name[key] for key in by_name if key == (full, root) or key[0] == full}
    return found - {path}


def reaches(start: str, end: str, imports: Mapping[str, Iterable[str]]) -> bool:
    """Say whether a file imports another file, directly or indirectly."""
    seen, waiting = set[str](), [start]
    while waiting:
        found = waiting.pop()
        if found == end:
            return True
        if found not in seen:
            seen.add(found)
            waiting += imports.get(found, ())
    return False
