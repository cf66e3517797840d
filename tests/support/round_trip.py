"""Old descriptions and new ones, each brought into SkiROS2's own form, to compare them."""

from __future__ import annotations

import enum
import linecache
import sys
import tokenize
from collections.abc import Iterable, Iterator
from dataclasses import replace
from io import StringIO
from itertools import count
from pathlib import Path
from types import ModuleType
from typing import Any

from dslkit.diagnostics import Collector
from ezskiros import SkillDescription, session
from ezskiros.hosts.skiros2_form import Form, FormCondition, form_of
from ezskiros.ontology import Ontology, load
from ezskiros.skills.calls import SkillClass
from ezskiros.skills.describe import describe
from ezskiros.skills.stand_ins import standing_in
from support import skiros2_api

_numbers = count()


def old_forms(text: str) -> dict[str, Form]:
    """The descriptions of SkiROS2 in a module, in stored form."""
    with skiros2_api.installed(), standing_in(lambda _name, _place: None):
        found = _run("old", text)
        return {
            name: _comparable(each().form())
            for name, each in found.items()
            if isinstance(each, type)
            and issubclass(each, skiros2_api.SkillDescription)
            and each is not skiros2_api.SkillDescription
        }


def new_forms(text: str, folder: Path, world: str = "world") -> dict[str, Form]:
    """The descriptions of EzSkiROS in a module, in the form of SkiROS2; `folder` has the
    ontology.
    """
    ontology = load(folder, relations=False)
    with skiros2_api.installed(), standing_in(lambda _name, _place: None), _world(world, ontology):
        found = _run("new", text)
        skills = {
            name: each
            for name, each in found.items()
            if isinstance(each, type)
            and issubclass(each, SkillDescription)
            and each is not SkillDescription
        }
        return {name: _new_form(each, ontology) for name, each in skills.items()}


def _new_form(skill: SkillClass, ontology: Ontology) -> Form:
    collector = Collector()
    with session.collecting(collector):
        described = describe(skill)
    assert described is not None
    wrong = [f"{each.code}: {each.title}" for each in collector.sorted()]
    assert not wrong, wrong
    return _comparable(form_of(described.interface, ontology.model))


def _run(name: str, text: str) -> dict[str, Any]:
    """The names of a module with this text, of which Python finds the source."""
    name = f"{name}_{next(_numbers)}"
    path = f"<{name}>.py"
    linecache.cache[path] = (len(text), None, text.splitlines(keepends=True), path)
    module = ModuleType(name)
    module.__file__ = path
    sys.modules[name] = module
    try:
        exec(compile(text, path, "exec"), vars(module))
    finally:
        del sys.modules[name]
    return vars(module)


class _world:  # noqa: N801
    """Within, the module of the world gives the namespaces of an ontology."""

    def __init__(self, name: str, ontology: Ontology) -> None:
        self._name, self._ontology = name, ontology

    def __enter__(self) -> None:
        module = ModuleType(self._name)
        vars(module).update(self._ontology.namespaces)
        sys.modules[self._name] = module

    def __exit__(self, *_problem: object) -> None:
        del sys.modules[self._name]


def _comparable(form: Form) -> Form:
    """Enumerations of two runs of a module are different classes: compared by their names."""
    parameters = tuple(
        replace(each, default=str(each.default)) if isinstance(each.default, enum.Enum) else each
        for each in form.parameters
    )
    return replace(form, parameters=parameters)


def without_order(form: Form) -> Form:
    """Conditions are a set: options put theirs first, wherever the parameter was declared."""
    pre, hold, post = (tuple(sorted(each, key=repr)) for each in (form.pre, form.hold, form.post))
    return replace(form, pre=pre, hold=hold, post=post)


_PREFIXES = """\
@prefix owl: <http://www.w3.org/2002/07/owl#> .
"""


def write_ontology(forms: Iterable[Form], folder: Path) -> None:
    """An ontology that declares just what some descriptions use."""
    classes, relations, values = {"skiros:Thing", "sumo:Agent"}, set[str](), {"skiros:Value"}
    for form in forms:
        classes |= {each.type for each in form.parameters if ":" in each.type}
        for condition in _all((*form.pre, *form.hold, *form.post)):
            name = str(condition.arguments[0])
            if condition.maker in ("getRelationCond", "getAbstractRelationCond"):
                relations.add(name)
            elif condition.maker in ("getPropCond", "getHasPropCond"):
                values.add(name)
            elif condition.maker == "getOnTypeCond":
                classes.add(str(condition.arguments[1]))
    lines = [_PREFIXES]
    for names, kind in (
        (classes, "Class"),
        (relations, "ObjectProperty"),
        (values, "DatatypeProperty"),
    ):
        for name in sorted(names):
            prefix, _, local = name.partition(":")
            lines.append(f"<http://example.org/{prefix}.owl#{local}> a owl:{kind} .\n")
    (folder / "all.ttl").write_text("".join(lines), encoding="utf-8")


def _all(conditions: Iterable[FormCondition]) -> Iterator[FormCondition]:
    for each in conditions:
        if each.maker == "getOrCond":
            yield from _all(each.parts)
        else:
            yield each


def comments(text: str) -> list[str]:
    """The comments of a module; a label may stand in front of one, or behind."""
    tokens = tokenize.generate_tokens(StringIO(text).readline)
    return [token.string for token in tokens if token.type == tokenize.COMMENT]
