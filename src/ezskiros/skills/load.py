"""Loading of Python files and packages. The result is the skills that they define and implement.

Modules are imported as usual, without ROS: stand-ins replace packages that are not installed. A
module that fails does not hide the others.
"""

from __future__ import annotations

import errno
import importlib
import os
import re
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.machinery import PathFinder
from pathlib import Path
from types import ModuleType
from typing import TypeVar

from dslkit.diagnostics import Collector, Diagnostic, Remark
from dslkit.source import SourceFile, Span, is_file, is_folder
from dslkit.source.call_site import line_span, source_file
from ezskiros import session
from ezskiros.skills import errors as skill_errors
from ezskiros.skills import load_errors as errors
from ezskiros.skills.blame import said, user_files, user_place, user_steps
from ezskiros.skills.calls import SkillClass
from ezskiros.skills.description import SkillDescription
from ezskiros.skills.encoding import UnreadableError
from ezskiros.skills.guard import (
    CodeTimeOverError,
    ProcessEndError,
    Refusals,
    SideEffectError,
    guarded,
)
from ezskiros.skills.implementation import SkillImplementation
from ezskiros.skills.importing import forget_since, importing, module_name
from ezskiros.skills.intercept import intercept
from ezskiros.skills.stand_ins import is_installed
from ezskiros.skills.syntax import classes_of

SECONDS = 20.0
"""The limit of processor time for the import of one module, including its own imports."""

T = TypeVar("T")


@dataclass(frozen=True)
class Loaded:
    """The definitions of some modules, in source order."""

    descriptions: Sequence[SkillClass]
    implementations: Sequence[type[SkillImplementation]]


def load_skills(paths: Iterable[Path]) -> Loaded:
    """The skills of some files, folders and packages."""
    paths = list(paths)
    for path in paths:
        if located(path) is None:
            nowhere = Span(SourceFile(str(path), ""), 0, 0)
            found = errors.NoFile(path=str(path))
            help = found.NoModule() if _is_name_of_module(path) else None
            session.report(found.at(nowhere, help=help))
    descriptions: dict[SkillClass, None] = {}
    implementations: dict[type[SkillImplementation], None] = {}
    endless: dict[str, str] = {}
    for file in module_files(paths):
        module = _module(file.resolve(), endless)
        if module is not None:
            described = _own(module, SkillDescription)
            implementing = _own(module, SkillImplementation)
            _report_repeated(file, {each.__name__ for each in (*described, *implementing)})
            descriptions.update(dict.fromkeys(described))
            implementations.update(dict.fromkeys(implementing))
    return Loaded(list(descriptions), list(implementations))


def skill_files(paths: Iterable[Path]) -> list[Path]:
    """The Python files among some paths, including files in folders."""
    found: dict[Path, None] = {}
    for path in paths:
        if is_folder(path):
            inside = (each for each in path.rglob("*.py") if _is_wanted(each.relative_to(path)))
            found.update(dict.fromkeys(sorted(inside)))
        elif is_file(path):
            found[path] = None
    return list(found)


def module_files(paths: Iterable[Path]) -> list[Path]:
    """The Python files of some paths, or of modules and packages that are given by name."""
    return skill_files(filter(None, map(located, paths)))


def located(path: Path) -> Path | None:
    """The file or folder of a path, or of the module or package with that name.

    None if there is none. The search imports nothing.
    """
    if is_folder(path) or is_file(path):
        return path
    parts = str(path).split(".")
    if not _is_name_of_module(path) or parts[0] in sys.stdlib_module_names:
        return None
    places: Iterable[str] | None = [str(Path.cwd()), *sys.path]
    spec = None
    for count in range(1, len(parts) + 1):
        spec = PathFinder.find_spec(".".join(parts[:count]), list(places or ()))
        if spec is None:
            return None
        places = spec.submodule_search_locations
    if places:
        return Path(next(iter(places)))
    return Path(spec.origin) if spec and spec.origin and spec.origin.endswith(".py") else None


def _is_name_of_module(path: Path) -> bool:
    return path.suffix != ".py" and all(part.isidentifier() for part in str(path).split("."))


def roots(files: Iterable[Path]) -> Iterator[str]:
    """The beginnings of the paths of all files in the same packages as some files."""
    for file in map(Path.resolve, files):
        name, folder = module_name(file)
        package = folder / name.partition(".")[0]
        yield f"{package}{os.sep}" if is_folder(package) else str(file)


def _is_wanted(path: Path) -> bool:
    """Say whether a file is searched. Hidden folders and folders of installed packages are left
    out.
    """
    return not any(part.startswith(".") or part == "__pycache__" for part in path.parts)


def _module(file: Path, endless: dict[str, str]) -> ModuleType | None:
    """The module of a file; None, after a finding, if it cannot be run.

    `endless` has the names and files of modules whose import does not end. They are not imported
    again.
    """
    if str(file) in endless.values():
        return None
    is_again, known = True, dict(sys.modules)
    while is_again:
        session.come_to(str(file))
        with importing(file), _without(endless):
            module, problem, guard, found = _imported(module_name(file)[0])
        is_open = module is None and not isinstance(problem, CodeTimeOverError)
        is_again = is_open and intercept([*guard.files, *user_files(problem)])
        if is_again:
            forget_since(known)
    for diagnostic in found.sorted():
        session.report(diagnostic)
    is_stopped = isinstance(problem, SideEffectError)
    for refusal in guard.replaced if is_stopped else guard.refusals():
        session.report(errors.ImportSideEffect(deed=refusal.deed).at(refusal.span))
    if isinstance(problem, CodeTimeOverError):
        endless.update([_module_of(problem)])
    if problem is not None:
        session.report(_failed(problem, file, endless))
    return module


def _imported(name: str) -> tuple[ModuleType | None, BaseException | None, Refusals, Collector]:
    """A module, or the exception of its import; the refused calls; and the findings."""
    module, problem = None, None
    with session.trying() as found, guarded(SECONDS, is_import=True) as guard:
        try:
            module = importlib.import_module(name)
        except KeyboardInterrupt:
            raise
        except BaseException as raised:
            problem = raised
    return module, problem, guard, found


@contextmanager
def _without(modules: Iterable[str]) -> Iterator[None]:
    """While the context is active, these modules are missing."""
    for name in modules:
        sys.modules[name] = None  # type: ignore[assignment]  # Python will not look for it
    try:
        yield
    finally:
        for name in modules:
            sys.modules.pop(name, None)


def _module_of(problem: BaseException) -> tuple[str, str]:
    """The name and the file of the user's module that was running when an exception was raised."""
    frames = [each.tb_frame for each in user_steps(problem.__traceback__)]
    modules = [frame for frame in frames if frame.f_code.co_name == "<module>"]
    found = modules[-1].f_globals if modules else {}
    return found.get("__name__", ""), found.get("__file__", "")


def _own(module: ModuleType, base: type[T]) -> list[type[T]]:
    """The classes that a module itself derives from another class."""
    return [
        each
        for each in vars(module).values()
        if isinstance(each, type) and issubclass(each, base) and each.__module__ == module.__name__
    ]


def _report_repeated(file: Path, skills: set[str]) -> None:
    """Report classes that a module defines twice, because Python forgets the first one."""
    source = source_file(str(file.resolve())) or SourceFile(str(file), "")
    seen: dict[str, Span] = {}
    for name, span in classes_of(source):
        if name in skills and name in seen:
            twice = skill_errors.DuplicateSkill(skill=name)
            session.report(twice.at(span, twice.Other().at(seen[name])))
        seen.setdefault(name, span)


def _syntax_error(problem: SyntaxError, file: Path) -> Diagnostic:
    source = source_file(problem.filename or str(file)) or SourceFile(str(file), "")
    line = line_span(source, problem.lineno or 1)
    start = min(
        source.line_starts[source.position(line.start).line - 1] + max(problem.offset or 1, 1) - 1,
        len(source.text),
    )
    return errors.NoPython(said=problem.msg).at(Span(source, start, max(start, line.end)))


def _failed(problem: BaseException, file: Path, endless: Mapping[str, str]) -> Diagnostic:
    """The finding for a module that raised, at the last line of the user's code."""
    if isinstance(problem, UnreadableError):
        return problem.diagnostic
    if isinstance(problem, SyntaxError):
        return _syntax_error(problem, file)
    source = source_file(str(file)) or SourceFile(str(file), "")
    span = user_place(problem) or Span(source, 0, 0)
    if isinstance(problem, CodeTimeOverError):
        return errors.EndlessImport(seconds=SECONDS).at(span)
    exception, why = type(problem).__name__, said(problem)
    if isinstance(problem, SideEffectError):
        exception, why = f"it {problem.deed}", "skipped: a check has no side effects"
    elif isinstance(problem, ProcessEndError):
        exception, why = "it ends the process", "the code after this is not imported"
    elif isinstance(problem, ModuleNotFoundError) and problem.name in endless:
        why = f"the import of `{problem.name}` does not end"
    found = errors.ModuleFailed(exception=exception, said=why)
    help: Remark | None = _star_help(source) if isinstance(problem, NameError) else None
    if _was_refused(problem):
        help = found.Refused()
    return found.at(span, help=help)


def _was_refused(problem: BaseException | None) -> bool:
    """Say whether the system refused an action, after which a library may raise a different
    exception.
    """
    while problem is not None:
        if isinstance(problem, PermissionError) and problem.errno == errno.EPERM:
            return True
        problem = problem.__cause__ or problem.__context__
    return False


def _star_help(source: SourceFile) -> Remark | None:
    """The help for `from rospy import *`: a stand-in has no list of names."""
    stars = re.findall(r"(?m)^\s*from\s+([\w.]+)\s+import\s+\*", source.text)
    missing = [each for each in stars if not is_installed(each.partition(".")[0])]
    if not missing:
        return None
    return errors.ModuleFailed.Star(module=missing[0])
