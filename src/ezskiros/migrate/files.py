"""Files and folders in, their migrations out; written only when somebody asks for that."""

from __future__ import annotations

import difflib
import tokenize
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from dslkit.diagnostics import Diagnostic
from dslkit.source import SourceFile, Span, is_file, is_folder
from ezskiros.migrate import errors
from ezskiros.migrate.module import Migrated, migrate_text
from ezskiros.skills.load import skill_files
from ezskiros.skills.load_errors import NoFile

_UNREAD = {NoFile.code, errors.UnreadableSource.code}


@dataclass(frozen=True)
class MigratedFile:
    """A file, and what becomes of it; `encoding` is what it is written in."""

    path: Path
    encoding: str
    migrated: Migrated

    @property
    def is_changed(self) -> bool:
        """Whether there is anything to write."""
        return self.migrated.text != self.migrated.file.text

    def diff(self) -> str:
        """The changes, as `patch` takes them."""
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
        """Put the new text into the file. Raises `OSError`."""
        self.path.write_bytes(self.migrated.text.encode(self.encoding))


@dataclass(frozen=True)
class Migration:
    """What becomes of some files."""

    files: Sequence[MigratedFile]
    diagnostics: Sequence[Diagnostic]

    def summary(self, *, is_written: bool) -> str:
        """How many descriptions there are, and what has become of them."""
        translated = sum(len(each.migrated.translated) for each in self.files)
        left = sum(len(each.migrated.left) for each in self.files)
        changed = sum(each.is_changed for each in self.files)
        done = "written" if is_written else "to be written"
        unread = sum(each.code in _UNREAD for each in self.diagnostics)
        rest = f"; {_counted(unread, 'file')} cannot be read" if unread else ""
        return (
            f"{_counted(translated + left, 'description')}: {translated} translated, "
            f"{left} left as they are; {_counted(changed, 'file')} {done}{rest}"
        )


def migrate_paths(
    paths: Iterable[Path], world: str = "world", ambiguous: Collection[str] = ()
) -> Migration:
    """Migrate the Python files of files and folders; `world` is the module with the ontology, of
    which several namespaces have the properties that are `ambiguous`.
    """
    paths = list(paths)
    files: list[MigratedFile] = []
    wrong: list[Diagnostic] = []
    for path in paths:
        if not is_folder(path) and not is_file(path):
            nowhere = Span(SourceFile(str(path), ""), 0, 0)
            wrong.append(NoFile(path=str(path)).at(nowhere))
    for path in skill_files(paths):
        try:
            encoding, text = _read(path)
        except (SyntaxError, UnicodeDecodeError) as problem:
            found = errors.UnreadableSource(said=str(problem).partition("\n")[0])
            wrong.append(found.at(Span(SourceFile(str(path), ""), 0, 0)))
            continue
        files.append(
            MigratedFile(path, encoding, migrate_text(str(path), text, world, ambiguous=ambiguous))
        )
    files = _with_inherited(files, world, ambiguous)
    return Migration(files, [*wrong, *(d for each in files for d in each.migrated.diagnostics)])


def _with_inherited(
    files: Sequence[MigratedFile], world: str, ambiguous: Collection[str]
) -> list[MigratedFile]:
    """Without the translations of descriptions that other files build on."""
    found = []
    for each in files:
        others = {base for other in files if other is not each for base in other.migrated.bases}
        text = each.migrated.file.text
        needed = others & {*each.migrated.translated}
        again = each.migrated
        if needed:
            again = migrate_text(str(each.path), text, world, needed, ambiguous)
        found.append(MigratedFile(each.path, each.encoding, again))
    return found


def _read(path: Path) -> tuple[str, str]:
    """The encoding of a Python file, and its text, with the line ends that it has."""
    with path.open("rb") as file:
        encoding, _ = tokenize.detect_encoding(file.readline)
    return encoding, path.read_bytes().decode(encoding)


def _counted(count: int, thing: str) -> str:
    return f"{count} {thing}{'' if count == 1 else 's'}"
