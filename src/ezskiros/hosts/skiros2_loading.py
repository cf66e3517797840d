"""A library that SkiROS2 imports: its skills are checked and become SkiROS2 classes."""

from __future__ import annotations

import importlib
import pkgutil
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

from rich.console import Console

from dslkit.diagnostics import Collector, Severity
from dslkit.diagnostics.render_text import render_text
from dslkit.source import is_file
from ezskiros import session
from ezskiros.hosts import skiros2_context, skiros2_recovery
from ezskiros.hosts.skiros2_api import api
from ezskiros.hosts.skiros2_library import CheckedLibrary, check_library
from ezskiros.hosts.skiros2_recovery import HostedTree
from ezskiros.hosts.skiros2_skills import (
    HostedSkill,
    host_of,
    hosted_skill,
    implementation_class,
    refused_class,
)
from ezskiros.hosts.skiros2_versions import unfit
from ezskiros.ontology import Ontology
from ezskiros.skills.calls import SkillClass
from ezskiros.skills.load import roots

_hosted: dict[SkillClass, HostedSkill] = {}
"""The skills of all libraries that SkiROS2 has loaded."""


def load(package: str, context: str | None = None) -> None:
    """Give SkiROS2 the skills of a library that have no errors. The others raise
    `RefusedSkillError` when SkiROS2 instantiates them. All modules of the library are imported.
    `context` is the export that defines the published context.
    """
    problem = unfit()
    if problem is not None:
        api().log.error("ezskiros", problem)
    found = Collector()
    with session.collecting(found):
        modules = list(_modules(package))
    files = [Path(each.__file__) for each in modules if each.__file__]
    with session.checking(roots(files)):
        checked = check_library(modules, found)
    text = _rendered(checked)
    if checked.refused:
        names = ", ".join(each.__name__ for each in checked.refused)
        api().log.error("ezskiros", f"{package}: refused: {names}\n{text}")
    if context is not None:
        _begin_context(package, context, checked)
    _give(checked, text)
    if context is not None:
        _begin_recoveries(package, checked)


def _begin_context(package: str, context: str, checked: CheckedLibrary) -> None:
    """Publish the running skills. If this fails, rules treat the context as stale."""
    ontology = checked.library.ontology() or Ontology(())
    skills = (Path(each.span.file.path) for each in checked.library.skills())
    files = [*filter(is_file, skills), *ontology.files()]
    file = sys.modules[package].__file__
    path = Path(file).parent / context if file else Path(context)
    problem = skiros2_context.begin(path, files)
    if problem is not None:
        api().log.error("ezskiros", f"{package}: the context is not published: {problem}")


def _begin_recoveries(package: str, checked: CheckedLibrary) -> None:
    """Let rules run the skills as trees. Without a published context, no rule can."""
    context = skiros2_context.current()
    if context is None:
        return
    names = {
        each: tuple(
            found.__name__ for found in checked.implementations if found.description is each
        )
        for each in checked.described
    }
    trees = [
        HostedTree(each, _hosted[each].skill, _hosted[each].ontology, names[each])
        for each in checked.described
    ]
    problem = skiros2_recovery.begin(trees, context)
    if problem is not None:
        api().log.error("ezskiros", f"{package}: rules cannot request trees: {problem}")


def _modules(package: str) -> Iterator[ModuleType]:
    """The modules of a library, as SkiROS2 finds them."""
    places = sys.modules[package].__path__
    for found in pkgutil.walk_packages(places, f"{package}.", onerror=lambda _name: None):
        if found.ispkg:
            continue
        try:
            yield importlib.import_module(found.name)
        except Exception:  # SkiROS2 imports it again, and reports the error
            continue


def _rendered(checked: CheckedLibrary) -> str:
    """The text of the errors. Warnings are omitted, because the robot is starting."""
    errors = [each for each in checked.diagnostics if each.severity is Severity.ERROR]
    console = Console(no_color=True, width=100)
    with console.capture() as captured:
        console.print(render_text(errors), soft_wrap=True)
    return captured.get().strip()


def _give(checked: CheckedLibrary, text: str) -> None:
    """Put the classes for SkiROS2 into the modules of the skills, where it looks for them."""
    whole = checked.library.ontology() or Ontology(())
    for each, known in checked.described.items():
        ontology = known.ontology or whole
        _hosted[each] = hosted_skill(known.interface, ontology, each.__module__)
        _put(each, _hosted[each].description)
    for found in checked.implementations:
        host = host_of(found, _hosted[found.description], checked.library)
        _put(found, implementation_class(host))
    for refused in checked.refused:
        _put(refused, refused_class(refused, text))


def _put(found: type, made: type) -> None:
    """Put a class where SkiROS2 finds it in a module, under any name."""
    setattr(sys.modules[found.__module__], f"{found.__name__}_in_skiros2", made)
