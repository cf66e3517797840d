"""The loader: from the path of a rules file to the syntax trees of the file and of everything that
it imports.

It reads files and never fails: an unreadable file is a finding, and becomes a module without items.
"""

from __future__ import annotations

import difflib
import os
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path, PurePosixPath
from typing import NamedTuple

from dslkit.diagnostics import Collector, Diagnostic, DidYouMean, Remark
from dslkit.source import SourceFile, Span, ending, is_file, is_folder
from rossmarie.check.instances.errors import EndlessImport, ValuesTwice
from rossmarie.check.instances.spaces import Imported
from rossmarie.driver.errors import (
    FileUnreadable,
    ForeignFile,
    ImportNotFound,
    NotARulesFile,
    NotUtf8,
    RulesAsSystem,
)
from rossmarie.driver.foreign import WEB_PAGE, foreign_kind
from rossmarie.syntax import MAXIMUM_FILE_SIZE, ast, parse

SYSTEM_MODEL = "system.ross"
"""The name of the implicit system model, a file beside the rules."""

MOST_INSTANCES = 256
"""The greatest number of files that are imported under names, or with values."""

_RULES = ".ross"

LIBRARY = Path(__file__).parents[1] / "library"
"""The built-in files, for import as `rossmarie/NAME.ross` or `rossmarie/FOLDER/NAME.ross`. A file
with this path beside the importing file takes precedence.
"""

_SHIPPED = "rossmarie"


def load_modules(main: Path, systems: Sequence[Path], collector: Collector) -> list[Imported]:
    """The trees of `systems`, of the folder's system model and of all imports, `main` last.

    Each file is read once, however many files import it, even if a system model imports `main`. The
    result contains it once for each name under which it is imported.
    """
    loader = _Loader(collector, main)
    beside = main.parent / SYSTEM_MODEL
    for path in (*systems, *([beside] if is_file(beside) else []), main):
        loader.load(path)
    for path in systems:
        loader.refuse_rules(path)
    return loader.with_last(main)


class _Wanted(NamedTuple):
    """A file to open for an import in another file. `importer` is None for files from the command
    line.
    """

    path: Path
    written: ast.Import | None = None
    importer: Imported | None = None

    @property
    def space(self) -> tuple[str, ...]:
        """The name space of the file: the name space of the whole program, unless the import has a
        name.
        """
        if self.written is None or self.importer is None or not _is_instance(self.written):
            return ()
        alias = self.written.alias
        return (*self.importer.space, *(() if alias is None else (alias.text,)))


@dataclass
class _Loader:
    collector: Collector
    main: Path
    loaded: list[Imported] = field(default_factory=list)
    visited: dict[tuple[Path, tuple[str, ...]], Imported] = field(default_factory=dict)
    parsed: dict[Path, ast.Module] = field(default_factory=dict)

    def with_last(self, path: Path) -> list[Imported]:
        """All files, with the file at `path` at the end."""
        last = self.visited[_identity(path), ()]
        return [each for each in self.loaded if each is not last] + [last]

    def load(self, path: Path) -> None:
        """Add the file at `path` after everything that it imports. The stack is explicit, so that a
        long chain of imports cannot exhaust Python's stack.
        """
        stack: list[tuple[Imported, list[_Wanted]]] = []
        self._open(_Wanted(path), stack)
        while stack:
            imported, imports = stack[-1]
            if imports:
                self._open(imports.pop(0), stack)
            else:
                self.loaded.append(imported)
                stack.pop()

    def refuse_rules(self, system: Path) -> None:
        """Report a system model that contains rules."""
        module = self.parsed[_identity(system)]
        rule = next((item for item in module.items if isinstance(item, ast.Rule)), None)
        if rule is not None:
            self.collector.add(RulesAsSystem(path=str(system)).at(rule.span))

    def _open(self, wanted: _Wanted, stack: list[tuple[Imported, list[_Wanted]]]) -> None:
        path, written = wanted.path, wanted.written
        if written is not None and not is_file(path):
            self.collector.add(_import_not_found(path, written.path.span))
            self.loaded.append(Imported(_unread(path), ()))
            return
        identity = _identity(path)
        key = identity, wanted.space
        if key in self.visited:
            self._again(self.visited[key], wanted)
            return
        if self._is_endless(wanted, identity):
            return
        is_new = identity not in self.parsed
        if is_new and not self._is_rules_file(path):
            place = Span(SourceFile(str(path), ""), 0, 0) if written is None else written.path.span
            self.collector.add(NotARulesFile(path=str(path)).at(place))
            self.parsed[identity] = _unread(path)
        elif is_new:
            source = read_source(path, self.collector)
            module = _unread(path) if source is None else parse(source, self.collector)
            self.parsed[identity] = module
        imported = Imported(self.parsed[identity], wanted.space)
        if written is not None and _is_instance(written):
            imported = replace(imported, written=written, importer=wanted.importer)
        self.visited[key] = imported
        stack.append((imported, _imports(imported, path.parent, self.main)))

    def _again(self, known: Imported, wanted: _Wanted) -> None:
        """Handle an import of a loaded file: its values count if the file has none so far."""
        written = wanted.written
        if written is None or not written.given or written.alias is not None:
            return
        if known.written is None:
            known.written, known.importer = written, wanted.importer
            return
        subject = f"a value for `{written.path.value}`"
        advice = "import it `as` another name, or give the values once"
        finding = ValuesTwice(subject=subject, advice=advice)
        place = finding.First().at(known.written.path.span)
        self.collector.add(finding.at(written.path.span, place))

    def _is_endless(self, wanted: _Wanted, identity: Path) -> bool:
        """Say whether an import would never end, or creates too many instances. Report it if so."""
        written, importer = wanted.written, wanted.importer
        if written is None or importer is None or written.alias is None:
            return False
        module = self.parsed.get(identity)
        around = (importer, *(each for each, _ in importer.chain()))
        if module is not None and any(each.module is module for each in around):
            problem = f"`{written.path.value}` imports itself under a name"
            reason = f"`{written.alias.text}` would have a `{written.alias.text}` of its own"
        elif sum(each.written is not None for each in self.visited.values()) >= MOST_INSTANCES:
            problem = f"more than {MOST_INSTANCES} files are imported under a name"
            reason = "this import is one too many"
        else:
            return False
        finding = EndlessImport(problem=problem, reason=reason)
        self.collector.add(finding.at(written.alias.span))
        return True

    def _is_rules_file(self, path: Path) -> bool:
        """Say whether a file may be read as rules. `main` may have any name, but must not be a link
        to a file of another type.
        """
        return ending(path) in (_RULES, self.main.suffix.lower() if path == self.main else _RULES)


def _unread(path: Path) -> ast.Module:
    return ast.Module(SourceFile(str(path), ""), (), is_whole=False)


def _identity(path: Path) -> Path:
    """One path for all names of a file. Circular links lead nowhere."""
    try:
        return Path(os.path.realpath(path))
    except (OSError, ValueError):
        return path.absolute()


def read_source(path: Path, collector: Collector) -> SourceFile | None:
    """The text of a file; None after reporting the reason.

    Reads little more than the parser accepts, even if the file is huge.
    """
    nothing = SourceFile(str(path), "")
    try:
        with path.open("rb") as stream:
            content = stream.read(MAXIMUM_FILE_SIZE + 8)
    except (OSError, ValueError) as error:  # ValueError: an impossible path
        collector.add(_unreadable(path, error).at(Span(nothing, 0, 0), help=_other_path(path)))
        return None
    try:
        source = SourceFile.decoded(str(path), content)
    except UnicodeDecodeError as error:
        if error.reason == "unexpected end of data" and len(content) > MAXIMUM_FILE_SIZE:
            return SourceFile(str(path), content.decode("utf-8-sig", errors="ignore"))
        collector.add(_not_utf8(path, content, error))
        return None
    kind = foreign_kind(path, source.text)
    if kind is not None:
        collector.add(_foreign(source, kind))
        return None
    return source


def _unreadable(path: Path, error: OSError | ValueError) -> FileUnreadable:
    system_reason = getattr(error, "strerror", None) or "it cannot be opened"
    reason = "this is a folder" if is_folder(path) else system_reason.lower()
    return FileUnreadable(path=str(path), reason=reason)


def _other_path(path: Path) -> Remark:
    """The help for a path that cannot be read: a rules file in this folder, or a similar name."""
    if is_folder(path):
        inside = next(iter(_rules_in(path)), None)
        return FileUnreadable.NameRules(example=f", for example `{inside}`" if inside else "")
    present = {found.name: found for found in _rules_in(path.parent)}
    near = difflib.get_close_matches(path.name, present, n=1)
    is_other = bool(near) and near[0] != path.name
    return DidYouMean(near=str(present[near[0]])) if is_other else FileUnreadable.CheckPath()


def _rules_in(folder: Path) -> list[Path]:
    """The rules files in a folder, by name; none if the folder cannot be read."""
    try:
        return sorted(folder.glob("*.ross"))
    except (OSError, ValueError):
        return []


def _not_utf8(path: Path, content: bytes, error: UnicodeDecodeError) -> Diagnostic:
    good = content[: error.start].decode("utf-8-sig", errors="replace")
    source = SourceFile(str(path), good + content[error.start :].decode("latin-1"))
    looks_binary = b"\0" in content[:4096]
    guess = "a binary file" if looks_binary else "text in another encoding, such as Latin-1"
    finding = NotUtf8(byte=f"0x{content[error.start]:02x}", guess=guess)
    return finding.at(Span(source, len(good), len(good) + 1))


def _foreign(source: SourceFile, kind: str) -> Diagnostic:
    finding = ForeignFile(path=source.path, kind=kind)
    is_page = kind == WEB_PAGE and Path(source.path).suffix == _RULES
    start = len(source.text) - len(source.text.lstrip())
    end = source.text.find("\n", start)
    span = Span(source, start, len(source.text) if end < 0 else end)
    return finding.at(span, help=finding.Download() if is_page else finding.NameRules())


def _imports(importer: Imported, folder: Path, main: Path) -> list[_Wanted]:
    return [
        _Wanted(_imported(item.path.value, folder, main), item, importer)
        for item in importer.module.items
        if isinstance(item, ast.Import)
    ]


def _is_instance(written: ast.Import) -> bool:
    """Say whether an import has a name or values."""
    return bool(written.given) or written.alias is not None


def _imported(written: str, folder: Path, main: Path) -> Path:
    """The file for an import in a file of a folder. In a file of the library, an import has the
    same meaning as in the main file, so a copy beside the main file is used everywhere.
    """
    shipped = _shipped(written)
    if shipped is None:
        return folder / written
    path = (main.parent if LIBRARY in folder.parents or folder == LIBRARY else folder) / written
    return path if is_file(path) else shipped


def _shipped(written: str) -> Path | None:
    """The library file with this name; None if there is none."""
    first, *others = PurePosixPath(written).parts or ("",)
    if first != _SHIPPED or not others or ".." in others:
        return None
    path = LIBRARY.joinpath(*others)
    return path if is_file(path) else None


def _import_not_found(path: Path, span: Span) -> Diagnostic:
    folder = path.parent
    if _SHIPPED in folder.parts and not is_folder(folder):
        parts = folder.parts
        last = len(parts) - 1 - parts[::-1].index(_SHIPPED)
        folder = LIBRARY.joinpath(*parts[last + 1 :])
    present = [found.stem for found in folder.glob("*.ross")] if is_folder(folder) else []
    near = difflib.get_close_matches(path.stem, present, n=1)
    finding = ImportNotFound(path=span.text.strip('"'), looked_for=f"`{path}`")
    help = DidYouMean(near=f"{near[0]}.ross") if near else finding.CheckPath()
    return finding.at(span, help=help)
