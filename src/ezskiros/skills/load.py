"""Python files and packages in, the skills that they define out.

Modules are run, as Python does when it imports them, without ROS: what is not installed is replaced
by stand-ins. A module that cannot be run does not hide the others.
"""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType

from dslkit.diagnostics import Diagnostic, Label
from dslkit.source import SourceFile, Span, is_file, is_folder
from dslkit.source.call_site import line_span, source_file
from ezskiros import session
from ezskiros.skills import errors as skill_errors
from ezskiros.skills import load_errors as errors
from ezskiros.skills.blame import said, user_place
from ezskiros.skills.description import SkillDescription
from ezskiros.skills.guard import guarding_sleep
from ezskiros.skills.stand_ins import standing_in
from ezskiros.skills.syntax import classes_of


def load_skills(paths: Iterable[Path]) -> list[type[SkillDescription]]:
    """The skills of some files and folders, in the order in which they are written."""
    paths = list(paths)
    for path in paths:
        if not is_folder(path) and not is_file(path):
            nowhere = Span(SourceFile(str(path), ""), 0, 0)
            session.report(errors.NoFile(path=str(path)).at(nowhere))
    found: dict[type[SkillDescription], None] = {}
    for file in skill_files(paths):
        module = _module(file)
        if module is not None:
            skills = _skills_of(module)
            _report_repeated(file, {skill.__name__ for skill in skills})
            found.update(dict.fromkeys(skills))
    return list(found)


def skill_files(paths: Iterable[Path]) -> list[Path]:
    """The Python files that some paths are or have in them."""
    found: dict[Path, None] = {}
    for path in paths:
        if is_folder(path):
            inside = (each for each in path.rglob("*.py") if _is_wanted(each.relative_to(path)))
            found.update(dict.fromkeys(sorted(inside)))
        elif is_file(path):
            found[path] = None
    return list(found)


def _is_wanted(path: Path) -> bool:
    """Hidden folders and those of installed packages are left out."""
    return not any(part.startswith(".") or part == "__pycache__" for part in path.parts)


def _module(file: Path) -> ModuleType | None:
    """The module of a file; None if it cannot be run, after a finding."""
    name, root = _name(file.resolve())
    with _importable_from(root), standing_in(_tell_stand_in), guarding_sleep():
        try:
            return importlib.import_module(name)
        except SyntaxError as problem:
            session.report(_syntax_error(problem, file))
        except (Exception, SystemExit) as problem:
            session.report(_failed(problem, file))
    return None


def _tell_stand_in(module: str, place: Span) -> None:
    """The finding for a stand-in, at its name in the import."""
    start = place.start + max(place.text.find(module), 0)
    named = Span(place.file, start, min(start + len(module), place.end))
    session.report(errors.StandIn(module=module).at(named))


def _name(file: Path) -> tuple[str, Path]:
    """How Python calls the module of a file, and the folder that it is found from."""
    parts = [] if file.stem == "__init__" else [file.stem]
    folder = file.parent
    while (folder / "__init__.py").is_file():
        parts.insert(0, folder.name)
        folder = folder.parent
    return ".".join(parts), folder


@contextmanager
def _importable_from(root: Path) -> Iterator[None]:
    """Within, modules are found from a folder first, even if others are loaded by their names."""
    sys.path.insert(0, str(root))
    for name, module in list(sys.modules.items()):
        file = getattr(module, "__file__", None)
        own = root / name.partition(".")[0]
        is_other = file and not Path(file).is_relative_to(root)
        if is_other and (own.with_suffix(".py").is_file() or own.is_dir()):
            del sys.modules[name]
    importlib.invalidate_caches()
    try:
        yield
    finally:
        sys.path.remove(str(root))


def _skills_of(module: ModuleType) -> list[type[SkillDescription]]:
    """The skills that a module defines itself."""
    return [
        each
        for each in vars(module).values()
        if isinstance(each, type)
        and issubclass(each, SkillDescription)
        and each.__module__ == module.__name__
    ]


def _report_repeated(file: Path, skills: set[str]) -> None:
    """Skills that a module defines again: of the first ones Python knows nothing any more."""
    source = source_file(str(file.resolve())) or SourceFile(str(file), "")
    seen: dict[str, Span] = {}
    for name, span in classes_of(source):
        if name in skills and name in seen:
            label = Label(seen[name], "the other one")
            session.report(skill_errors.DuplicateSkill(skill=name).at(span, label))
        seen.setdefault(name, span)


def _syntax_error(problem: SyntaxError, file: Path) -> Diagnostic:
    source = source_file(problem.filename or str(file)) or SourceFile(str(file), "")
    line = line_span(source, problem.lineno or 1)
    start = min(
        source.line_starts[source.position(line.start).line - 1] + (problem.offset or 1) - 1,
        len(source.text),
    )
    return errors.NoPython(said=problem.msg).at(Span(source, start, max(start, line.end)))


def _failed(problem: BaseException, file: Path) -> Diagnostic:
    """The finding for a module that raised, at the last line of the user's code."""
    span = user_place(problem.__traceback__)
    source = source_file(str(file)) or SourceFile(str(file), "")
    found = errors.ModuleFailed(exception=type(problem).__name__, said=said(problem))
    return found.at(span or Span(source, 0, 0))
