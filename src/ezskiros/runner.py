"""Preparation of a task from the name of a skill: check, world model and values."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from dslkit.diagnostics import Diagnostic, Severity
from dslkit.source import is_file
from ezskiros.driver import SCENE, Checked, UnknownSkillError, check_paths
from ezskiros.engine.arguments import read_arguments
from ezskiros.engine.scenes import load_world
from ezskiros.engine.world import World
from ezskiros.ontology import Ontology
from ezskiros.ontology.load import load_named
from ezskiros.session import NOWHERE
from ezskiros.skills.calls import SkillCall, SkillClass
from ezskiros.trees.library import Library
from ezskiros.trees.tree import Tree


@dataclass(frozen=True)
class Ready:
    """A skill that can be run, with its arguments and its world.

    `elsewhere` are the findings on skills that it calls and that are not in the files. `sources`
    are the files of the skills and of the ontology.
    """

    library: Library
    trees: Sequence[Tree]
    call: SkillCall
    world: World
    warnings: Sequence[Diagnostic]
    elsewhere: Sequence[Diagnostic]
    sources: Sequence[Path]


class FaultyError(Exception):
    """The skills or the scene have errors, which are in `diagnostics`."""

    def __init__(self, checked: Checked, diagnostics: Sequence[Diagnostic]) -> None:
        super().__init__("there are errors")
        self.diagnostics = diagnostics
        self.file_count = len(checked.files)


def prepare(skill: str, paths: Iterable[Path], scene: Path | None, texts: Iterable[str]) -> Ready:
    """Check the files, find the skill, and read its arguments (`Name=value`).

    `skill` is the name of a description, of an implementation, or both (`Pick.pick`). Raises
    `FaultyError`, `UnknownSkillError`, `WrongArgumentError`, and `OSError` for a scene that cannot
    be read.
    """
    checked = check_paths(paths)
    _refuse_errors(checked, checked.diagnostics)
    library = checked.library
    description, implementation = _found(skill, library)
    ontology, unread = _ontology(library)
    found = [*checked.diagnostics, *unread]
    _refuse_errors(checked, found)
    world, wrong = load_world(ontology, scene)
    found += wrong
    _refuse_errors(checked, found)
    interface = library.skill(description)
    assert interface is not None, "a description without errors says something"
    values = read_arguments(interface, texts, world)
    call = SkillCall(description, implementation, MappingProxyType(values), NOWHERE)
    sources = [*_modules(checked), *ontology.files()]
    return Ready(library, checked.trees, call, world, found, library.elsewhere, sources)


def _modules(checked: Checked) -> list[Path]:
    """The files with skills: the checked files, and the skills files that they call."""
    called = (Path(each.span.file.path) for each in checked.library.skills())
    known = [*(each for each in checked.files if each.suffix != SCENE), *called]
    return [each for each in known if is_file(each)]


def _ontology(library: Library) -> tuple[Ontology, Sequence[Diagnostic]]:
    """Return the ontology of the skills and its findings. If no skill uses individuals, this is the
    ontology that `load()` finds, if any.
    """
    known = library.ontology()
    if known is not None:
        return known, ()
    named, wrong = load_named()
    return named or Ontology(()), wrong


def _refuse_errors(checked: Checked, found: Sequence[Diagnostic]) -> None:
    if any(each.severity is Severity.ERROR for each in found):
        raise FaultyError(checked, found)


def _found(name: str, library: Library) -> tuple[SkillClass, str | None]:
    """The description, and the name of the implementation if it is given."""
    known: dict[str, tuple[SkillClass, str | None]] = {}
    for description in library.descriptions():
        for each in library.implementations(description):
            known.setdefault(each, (description, each))
            known[f"{description.__name__}.{each}"] = (description, each)
    known |= {each.__name__: (each, None) for each in library.descriptions()}
    if name in known:
        return known[name]
    near = difflib.get_close_matches(name, known, n=1)
    listed = ", ".join(sorted(each for each in known if known[each][1] is None))
    hint = f"did you mean `{near[0]}`?" if near else f"there is {listed or 'none'}"
    raise UnknownSkillError(f"there is no skill `{name}` in these files; {hint}")
