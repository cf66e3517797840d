"""The main functions of EzSkiROS, which turn paths into findings. The command line and other
programs call them.
"""

from __future__ import annotations

import difflib
import os
import sys
from collections.abc import Iterable, Iterator, Sequence, Set
from contextlib import redirect_stdout
from dataclasses import dataclass
from io import StringIO
from pathlib import Path

from dslkit import garbage
from dslkit.diagnostics import Collector, Diagnostic, Severity
from dslkit.source import SourceFile, Span, is_file
from ezskiros import session
from ezskiros.check import check_implementations, check_skills
from ezskiros.check.inference import chains
from ezskiros.check.scene_errors import NoOntologyForScene
from ezskiros.check.scenes import check_scene
from ezskiros.contracts import MissingCondition, check_contracts, missing_pre_conditions
from ezskiros.engine.depth import deep
from ezskiros.export import export_skills
from ezskiros.hosts.owl_files import owl_files
from ezskiros.locations import Location, find_locations
from ezskiros.ontology import Ontology, load
from ezskiros.ontology.load import VARIABLE
from ezskiros.ontology.read import read
from ezskiros.skills.interface import SkillInterface
from ezskiros.skills.load import load_skills, module_files, roots
from ezskiros.skills.load_errors import NoFile, NoSkills
from ezskiros.skills.markers import ParameterKind
from ezskiros.trees.library import LaunchValues, Library
from ezskiros.trees.tree import Tree

SCENE = ".turtle"


@dataclass(frozen=True)
class Checked:
    """The skills of some files, the trees of the compound skills, and the findings."""

    files: Sequence[Path]
    skills: Sequence[SkillInterface]
    diagnostics: Sequence[Diagnostic]
    library: Library
    trees: Sequence[Tree]


def check_paths(
    paths: Iterable[Path], values: Path | None = None, collector: Collector | None = None
) -> Checked:
    """Check the skills of files, folders and packages, and scenes. The output of skills is
    discarded.

    `values` is a file with values of parameters that are known at launch. Findings are added to
    `collector` immediately. This function runs the modules in this process: unlike `ezskiros
    check`, it trusts them.
    """
    paths = list(paths)
    scenes = [path for path in paths if path.suffix == SCENE]
    paths = [path for path in paths if path.suffix != SCENE]
    collector = Collector() if collector is None else collector
    files = module_files(paths)
    with (
        session.collecting(collector),
        session.checking(roots(files)),
        redirect_stdout(StringIO()),
        garbage.not_now(),
        deep(),
    ):
        loaded = load_skills(paths)
        described = check_skills(loaded.descriptions, scenes)
        library = Library(described)
        interfaces = [each.interface for each in described.values()]
        known = _launch_values(values, interfaces) if values else {}
        trees = check_implementations(loaded.implementations, library, known)
        collector.extend(check_contracts(trees, library).diagnostics)
        collector.extend(found for scene in scenes for found in _scene(scene))
    is_empty = not loaded.descriptions and not loaded.implementations
    if paths and is_empty and not collector.sorted():
        shown = ", ".join(map(str, paths))
        collector.add(NoSkills(path=shown).at(Span(SourceFile(shown, ""), 0, 0)))
    skills = list({each.name: each for each in reversed(interfaces)}.values())[::-1]
    return Checked([*files, *scenes], skills, collector.sorted(), library, trees)


def _launch_values(path: Path, interfaces: Sequence[SkillInterface]) -> LaunchValues:
    """The values that are known at launch. YAML is imported here, because only this file needs
    it.
    """
    from ezskiros.trees.launch import read_launch_values

    return read_launch_values(path, interfaces)


def missing_conditions(
    paths: Iterable[Path], collector: Collector | None = None
) -> list[MissingCondition]:
    """The missing pre-conditions of compound skills, in files, folders and packages."""
    checked = check_paths(paths, collector=collector)
    return missing_pre_conditions(checked.trees, checked.library)


def _scene(path: Path) -> Iterable[Diagnostic]:
    """Check a scene against the ontology that `load()` loads."""
    nowhere = Span(SourceFile(str(path), ""), 0, 0)
    if not os.environ.get(VARIABLE):
        return [NoOntologyForScene().at(nowhere)]
    if not is_file(path):
        return [NoFile(path=str(path)).at(nowhere)]
    return check_scene(path, load())


def stub_of(*, relations: bool) -> tuple[str, Sequence[Diagnostic]]:
    """The stub of the ontology that `load()` loads, and the findings on the ontology."""
    from ezskiros.stubs import write_stub

    collector = Collector()
    with session.commanding(collector):
        ontology = load(relations=relations)
    return write_stub(ontology), collector.sorted()


def owl_of() -> tuple[dict[str, str], Sequence[Diagnostic]]:
    """The files with the ontology that `load()` loads, in the format of SkiROS2, and the findings.
    After an error there are no files.
    """
    collector = Collector()
    with session.commanding(collector):
        ontology = load(relations=False)
    if _has_errors(collector):
        return {}, collector.sorted()
    files, wrong = owl_files(ontology)
    collector.extend(wrong)
    return files, collector.sorted()


def ambiguous_names() -> tuple[frozenset[str], Sequence[Diagnostic]]:
    """The names of properties that are in several namespaces of the ontology that `load()` loads,
    and the findings on the ontology.
    """
    collector = Collector()
    with session.commanding(collector):
        ontology = load()
    return ontology.ambiguous(), collector.sorted()


def export_paths(paths: Iterable[Path], out: Path, collector: Collector) -> str | None:
    """The text of the export `out` with the skills of files, folders and packages; None after an
    error. Findings are added to `collector`. Raises `OSError` for a source that can no longer be
    read.
    """
    known = set(sys.modules)
    checked = check_paths(paths, collector=collector)
    if _has_errors(collector):
        return None
    collector.extend(checked.library.elsewhere)
    files = [each for each in checked.files if each.suffix != SCENE]
    beginnings = tuple(roots(files))
    with (
        session.collecting(collector),
        session.checking(beginnings),
        garbage.not_now(),
        deep(),
    ):
        loaded = _user_modules(known, beginnings)
        scene = [
            found for each in checked.files if each.suffix == SCENE for found in _located(each)
        ]
        text = export_skills(checked.library, checked.trees, scene, [*files, *loaded], out.parent)
    return None if _has_errors(collector) else text


def _located(path: Path) -> Iterable[tuple[Ontology, Location]]:
    """The locations of a checked scene, with the ontology of their classes."""
    ontology = load()
    document, _ = read(path)
    assert document is not None, "the scene was read before"
    return [(ontology, each) for each in find_locations(document, ontology.model).locations]


def _user_modules(known: Set[str], beginnings: tuple[str, ...]) -> Iterator[Path]:
    """The users' modules that have been imported since only `known` modules were, and modules of
    packages with files that have these beginnings.
    """
    for name, module in list(sys.modules.items()):
        file = str(getattr(module, "__file__", None))
        is_new = name not in known or file.startswith(beginnings)
        if is_new and file.endswith(".py") and session.is_of_user(file) and is_file(Path(file)):
            yield Path(file)


def _has_errors(collector: Collector) -> bool:
    return any(each.severity is Severity.ERROR for each in collector.sorted())


class UnknownSkillError(LookupError):
    """The skill does not exist. The message may suggest a similar name."""


def explain_skill(name: str, paths: Iterable[Path], collector: Collector | None = None) -> str:
    """Explain how each inferred parameter of a skill gets its value, and list the permissions and
    resources of the skill. Raises `UnknownSkillError`.
    """
    skills = {each.name: each for each in check_paths(paths, collector=collector).skills}
    if name not in skills:
        near = difflib.get_close_matches(name, skills, n=1)
        hint = f"; did you mean `{near[0]}`?" if near else ""
        raise UnknownSkillError(f"there is no skill `{name}` in these files{hint}")
    return "\n".join(_lines(skills[name]))


def trees_of(name: str, checked: Checked) -> list[Tree]:
    """The trees of a skill, or of one implementation. Raises `UnknownSkillError` if the skill is
    unknown or a primitive.
    """
    found = [tree for tree in checked.trees if name in (tree.implementation, tree.skill.name)]
    if found:
        return found
    known = {each.name for each in checked.skills} | {each.implementation for each in checked.trees}
    owner = checked.library.owner(name)
    if owner is not None or name in known:
        what = "is primitive" if owner else "has no compound implementation in these files"
        raise UnknownSkillError(f"`{name}` {what}: it has no behavior tree")
    near = difflib.get_close_matches(name, sorted(known), n=1)
    hint = f"; did you mean `{near[0]}`?" if near else ""
    raise UnknownSkillError(f"there is no skill `{name}` in these files{hint}")


def _lines(skill: SkillInterface) -> Iterable[str]:
    steps = chains(skill)
    for parameter in skill.parameters:
        key = f" ({parameter.key!r})" if parameter.key != parameter.name else ""
        shown = parameter.name + key + (f": {parameter.type!r}" if parameter.is_individual else "")
        if parameter.is_output:
            yield f"{shown}  set by the skill"
        elif parameter.kind is not ParameterKind.INFERRED:
            origin = "given" if parameter.default is None else f"given, or {parameter.default!r}"
            yield f"{shown}  {origin if parameter.kind is ParameterKind.REQUIRED else 'optional'}"
        elif parameter.name in steps:
            step = steps[parameter.name]
            place = step.clause.span
            yield f"{shown}  from {step.source}, by {place.text} ({place})"
        else:
            yield f"{shown}  any individual of this class: no pre-condition restricts the choice"
    yield from (f"permits {each.span.text} ({each.span})" for each in skill.permits)
    yield from (f"uses {each.kind.value} {each.name} ({each.span})" for each in skill.uses)
