"""The import of user modules during a check: from their own folders, with stand-ins for missing
packages.
"""

from __future__ import annotations

import importlib
import os
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from types import ModuleType

from dslkit.diagnostics import Diagnostic
from dslkit.source import Span
from ezskiros import session
from ezskiros.skills import load_errors as errors
from ezskiros.skills.encoding import reading_strictly
from ezskiros.skills.intercept import Finder
from ezskiros.skills.stand_ins import is_installed, standing_in


def module_name(file: Path) -> tuple[str, Path]:
    """The module name of a file in Python, and the folder from which it is imported."""
    parts = [] if file.stem == "__init__" else [file.stem]
    folder = file.parent
    while (folder / "__init__.py").is_file():
        parts.insert(0, folder.name)
        folder = folder.parent
    return ".".join(parts), folder


@contextmanager
def importing(file: Path) -> Iterator[None]:
    """While the context is active, modules are imported as by the module of this file. Afterwards
    stand-ins are reported.
    """
    _, root = module_name(file)
    finder, found = Finder(), list[Diagnostic]()
    telling = standing_in(lambda *reported: found.append(_stand_in(*reported)))
    with _importable_from(root), telling, reading_strictly():
        sys.meta_path.insert(0, finder)
        try:
            yield
        finally:
            sys.meta_path.remove(finder)
    for each in found:
        session.report(each)


def forget_since(known: Mapping[str, ModuleType]) -> None:
    """Forget the user's modules that were imported in addition to known ones, so that they are
    imported again.
    """
    for name, module in list(sys.modules.items()):
        file = getattr(module, "__file__", None)
        if known.get(name) is not module and file and session.is_of_user(file):
            del sys.modules[name]


def _stand_in(module: str, place: Span) -> Diagnostic:
    """The finding for a stand-in, at its name in the import if the name is there."""
    start = place.start + place.text.find(module)
    named = Span(place.file, start, start + len(module)) if module in place.text else place
    if is_installed(module):
        return errors.ClientStandIn(module=module).at(named)
    return errors.StandIn(module=module).at(named)


@contextmanager
def _importable_from(root: Path) -> Iterator[None]:
    """While the context is active, modules of a folder take precedence, even over loaded ones with
    the same names.
    """
    sys.path.insert(0, str(root))
    _forget_others(root, root.stat().st_mtime_ns)
    try:
        yield
    finally:
        sys.path.remove(str(root))


@lru_cache(maxsize=1)  # once is enough, until modules of another folder are imported
def _forget_others(root: Path, _changed: int) -> None:
    """Forget the modules of other folders with the names of modules of this folder."""
    own = {each.stem for each in root.iterdir() if each.suffix == ".py" or each.is_dir()}
    start = f"{root}{os.sep}"
    for name in [name for name in sys.modules if name.partition(".")[0] in own]:
        file = getattr(sys.modules[name], "__file__", None)
        if file and not file.startswith(start):
            del sys.modules[name]
    importlib.invalidate_caches()
