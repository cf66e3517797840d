"""Migration of files and folders. Files are only written on request."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from dslkit.diagnostics import Diagnostic
from dslkit.source import SourceFile, Span, is_file, is_folder
from dslkit.source.python_file import read_python
from dslkit.writing import write_whole
from ezskiros.migrate import errors
from ezskiros.migrate.bases import Bases
from ezskiros.migrate.consequences import consequences
from ezskiros.migrate.migrated import Migrated
from ezskiros.migrate.module import migrate_text
from ezskiros.migrate.modules import imported_files, reaches
from ezskiros.migrate.robots import with_robots
from ezskiros.migrate.settle import until_settled
from ezskiros.migrate.skills import KnownSkills
from ezskiros.skills.load import skill_files
from ezskiros.skills.load_errors import NoFile

_UNREAD = {NoFile.code, errors.UnreadableSource.code}


@dataclass(frozen=True)
class MigratedFile:
    """A file, and its migrated text; `encoding` is the encoding of the file."""

    path: Path
    encoding: str
    migrated: Migrated

    @property
    def is_changed(self) -> bool:
        """Say whether the text has changed."""
        return self.migrated.text != self.migrated.file.text

    def diff(self) -> str:
        """The changes, in the format of `patch`."""
        name = self.path.as_posix().lstrip("/")
        before, after = self.migrated.file.text, self.migrated.text
        lines = difflib.unified_diff(
            before.splitlines(keepends=True),
            after.splitlines(keepends=True),
            fromfile=f"a/{name}",
            tofile=f"b/{name}",
        )
        return "".join(
            line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"
            for line in lines
        )

    def write(self) -> None:
        """Write the new text to the file. Raises `OSError`."""
        write_whole(self.path, self.migrated.text.encode(self.encoding))


@dataclass(frozen=True)
class Migration:
    """The result of the migration of some files."""

    files: Sequence[MigratedFile]
    diagnostics: Sequence[Diagnostic]

    def summary(self, *, is_written: bool) -> str:
        """Count the skills: translated, and not translated."""
        described = [(each.migrated.translated, each.migrated.left) for each in self.files]
        implementing = [
            (each.migrated.implemented, each.migrated.unimplemented) for each in self.files
        ]
        changed = sum(each.is_changed for each in self.files)
        done = "written" if is_written else "to be written"
        unread = sum(each.code in _UNREAD for each in self.diagnostics)
        rest = f"; {_counted(unread, 'file')} cannot be read" if unread else ""
        said = _become(described, "description")
        if any(done or left for done, left in implementing):
            said += f"; {_become(implementing, 'implementation')}"
        return f"{said}; {_counted(changed, 'file')} {done}{rest}"

    def result(self, *, is_written: bool) -> dict[str, Any]:
        """The files as JSON data: the path of each, with its change in the format of `patch`."""
        return {
            "is_written": is_written,
            "files": [
                {"path": str(each.path), "diff": each.diff() if each.is_changed else None}
                for each in self.files
            ],
        }


def migrate_paths(
    paths: Iterable[Path], world: str = "world", ambiguous: Collection[str] = ()
) -> Migration:
    """Migrate the Python files of files and folders. `world` is the module with the ontology.
    `ambiguous` are the properties that several namespaces of the ontology have.
    """
    paths = list(paths)
    sources: list[_Source] = []
    wrong: list[Diagnostic] = []
    for path in paths:
        if not is_folder(path) and not is_file(path):
            nowhere = Span(SourceFile(str(path), ""), 0, 0)
            wrong.append(NoFile(path=str(path)).at(nowhere))
    for path in skill_files(paths):
        try:
            sources.append(_Source(path, *read_python(path)))
        except (SyntaxError, UnicodeDecodeError) as problem:  # noqa: PERF203 - each is reported
            found = errors.UnreadableSource(said=str(problem).partition("\n")[0])
            wrong.append(found.at(Span(SourceFile(str(path), ""), 0, 0)))
    migrated = _Migrations(sources, world, ambiguous).all()
    files = [
        MigratedFile(each.path, each.encoding, found)
        for each, found in zip(sources, migrated, strict=True)
    ]
    left = {skill: what for each in migrated for skill, what in each.left_skills.items()}
    more = consequences((one for each in migrated for one in each.followers), left)
    return Migration(files, [*wrong, *(d for each in migrated for d in each.diagnostics), *more])


@dataclass(frozen=True)
class _Source:
    """A readable file."""

    path: Path
    encoding: str
    text: str


class _Migrations:
    """The migrations of some files, repeated with the results of all of them."""

    def __init__(self, sources: Sequence[_Source], world: str, ambiguous: Collection[str]) -> None:
        self._sources, self._world, self._ambiguous = sources, world, ambiguous
        self._found = [self._migrated(each) for each in sources]

    def all(self) -> list[Migrated]:
        """The migrated files, in order."""
        described = [skill for each in self._found for skill in each.skills]
        bases = Bases(one for each in self._found for one in each.built)
        robots = with_robots((each.robots for each in self._found), described) | bases.robots()
        inherited = [self._inherited(each) for each in self._found]
        no_skills = KnownSkills((), robots)
        self._again(
            lambda number, found: (
                (no_skills, inherited[number], ())
                if inherited[number] or robots & {*found.translated}
                else None
            )
        )
        labels = dict(item for each in self._found for item in each.labels.items())
        described = [skill for each in self._found for skill in each.skills]
        skills = self._settled(KnownSkills(described, robots, labels, bases=bases), inherited)
        late = self._late()
        self._again(
            lambda number, _: (skills, inherited[number], late[number]) if late[number] else None
        )
        return self._found

    def _settled(self, skills: KnownSkills, inherited: Sequence[set[str]]) -> KnownSkills:
        """Migrate the files with implementations and their bases, and the files whose descriptions
        get parameters. Returns the resulting skills.
        """
        last = skills

        def migrated(known: KnownSkills) -> list[Migrated]:
            nonlocal last
            is_first, changed = known is last, known.changed(last)
            last = known
            self._again(
                lambda number, found: (
                    (known, inherited[number], ())
                    if (is_first and self._implements(found, known)) or found.needs(changed)
                    else None
                )
            )
            return self._found

        until_settled(skills, migrated)
        return last

    def _implements(self, found: Migrated, known: KnownSkills) -> bool:
        """Say whether a file has implementations of skills, or bases of them."""
        is_base = any(known.bases.is_mixin(each.id) for each in found.built)
        return is_base or bool(found.unimplemented)

    def _again(
        self,
        wanted: Callable[[int, Migrated], tuple[KnownSkills, set[str], Collection[str]] | None],
    ) -> None:
        """Migrate the files for which `wanted` gives new input: skills, unchanged classes, late
        imports.
        """
        for number, (source, found) in enumerate(zip(self._sources, self._found, strict=True)):
            asked = wanted(number, found)
            if asked is not None:
                skills, inherited, late = asked
                self._found[number] = self._migrated(source, skills, inherited, late)

    def _migrated(
        self,
        source: _Source,
        skills: KnownSkills | None = None,
        inherited: Collection[str] = (),
        late: Collection[str] = (),
    ) -> Migrated:
        return migrate_text(
            str(source.path), source.text, self._world, inherited, self._ambiguous,
            skills or KnownSkills(), late,
        )  # fmt: skip

    def _inherited(self, own: Migrated) -> set[str]:
        """The skills and implementations of a file from which classes of other files are
        derived.
        """
        others = {base for each in self._found if each is not own for base in each.bases}
        return others & {*own.translated, *own.unimplemented}

    def _late(self) -> list[set[str]]:
        """For each file, the files whose skills it can only import when all are loaded."""
        files = [str(each.path) for each in self._sources]
        imports = {
            path: imported_files(path, each.sources, files) | {*each.wanted}
            for path, each in zip(files, self._found, strict=True)
        }
        return [
            {path for path in each.wanted if reaches(path, own, imports)}
            for own, each in zip(files, self._found, strict=True)
        ]


def _become(found: Sequence[tuple[Sequence[str], Sequence[str]]], noun: str) -> str:
    """Report the numbers of translated and unchanged parts."""
    translated = sum(len(each) for each, _ in found)
    left = sum(len(each) for _, each in found)
    return f"{_counted(translated + left, noun)}: {translated} translated, {left} left as they are"


def _counted(count: int, noun: str) -> str:
    return f"{count} {noun}{'' if count == 1 else 's'}"
