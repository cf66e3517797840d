"""Conversion of checked skills to the text of `skills.json`. The same sources give the same
text.
"""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

from ezskiros import session
from ezskiros.check.spelled import spelled
from ezskiros.export import errors
from ezskiros.export.places import ExportPlaces
from ezskiros.export.sources import FORMAT, VERSION, digest_of, sources_of
from ezskiros.export.statements import written
from ezskiros.export.trees import spelled_value, tree_of
from ezskiros.export.vocabulary import Vocabulary, name_in, name_of
from ezskiros.locations import Location
from ezskiros.ontology import Ontology
from ezskiros.ontology.symbols import OntologyClass
from ezskiros.skills.calls import SkillClass
from ezskiros.skills.description import SkillDescription
from ezskiros.skills.interface import BASIC, Clause, Parameter, SkillInterface
from ezskiros.skills.markers import ParameterKind
from ezskiros.skills.permits import Permission
from ezskiros.skills.uses import Use
from ezskiros.trees.library import Library
from ezskiros.trees.tree import Tree

TOPIC, PERIOD = "/skill_context", 0.1
"""The topic of the message about running skills, and its period in seconds."""
CONTEXT = {"topic": TOPIC, "type": "skill_context_msgs/SkillContext", "period": PERIOD}
_KINDS = {
    ParameterKind.REQUIRED: "given",
    ParameterKind.INFERRED: "inferred",
    ParameterKind.OPTIONAL: "optional",
}


def export_skills(
    library: Library,
    trees: Sequence[Tree],
    scene: Sequence[tuple[Ontology, Location]],
    files: Iterable[Path],
    folder: Path,
) -> str:
    """The text of a file in `folder` with all skills of a library, the trees of the checked skills,
    and the locations of a scene. `files` are additional sources besides those of skills, ontologies
    and scenes. After a reported error, the text must not be used. Raises `OSError` for an
    unreadable source.
    """
    return _Writer(library, trees, scene, folder).text(files)


class _Writer:
    def __init__(
        self,
        library: Library,
        trees: Sequence[Tree],
        scene: Sequence[tuple[Ontology, Location]],
        folder: Path,
    ) -> None:
        self._library, self._scene, self._folder = library, scene, folder
        self._places = ExportPlaces(folder)
        self._trees: dict[str, list[Tree]] = defaultdict(list)
        for tree in trees:
            self._trees[tree.skill.name].append(tree)

    def text(self, files: Iterable[Path]) -> str:
        described = self._described()
        skills = [self._skill(each, skill) for each, skill in described]
        vocabularies = self._vocabularies(skill for _, skill in described)
        classes = _by_name("classes", (one for each in vocabularies for one in each.classes()))
        properties = [one for each in vocabularies for one in each.properties()]
        locations = [self._location(*each) for each in self._scene_by_iri()]
        known = [*files, *self._places.files, *self._ontology_files]
        sources = sources_of(known, self._folder)
        return _text(
            {
                "format": FORMAT,
                "version": VERSION,
                "digest": digest_of(sources),
                "sources": [vars(each) for each in sources],
                "context": CONTEXT,
                "classes": classes,
                "properties": _by_name("data properties", properties),
                "skills": skills,
                "locations": locations,
            }
        )

    def _described(self) -> list[tuple[SkillClass, SkillInterface]]:
        """All known skills, by name."""
        found: dict[str, tuple[SkillClass, SkillInterface]] = {}
        for each in self._library.descriptions():
            skill = self._library.skill(each)
            if skill is None:
                continue
            first = found.setdefault(skill.name, (each, skill))[1]
            if first is not skill:
                twice = errors.SameName(kind="skills", spelled=skill.name)
                session.report(twice.at(skill.span, twice.Other().at(first.span)))
        return [found[name] for name in sorted(found)]

    def _vocabularies(self, skills: Iterable[SkillInterface]) -> list[Vocabulary]:
        named: dict[Ontology, set[str]] = defaultdict(set)
        for each in (one for skill in skills for one in _classes_in(skill)):
            if isinstance(each.vocabulary, Ontology):
                named[each.vocabulary].add(each.iri)
        for ontology, location in self._scene:
            named[ontology].update(location.types)
        self._ontology_files = [file for ontology in named for file in ontology.files()]
        return [Vocabulary(each, iris, self._places) for each, iris in named.items()]

    # --- skills -----------------------------------------------------------------------------------

    def _skill(self, description: SkillClass, skill: SkillInterface) -> dict[str, Any]:
        ontology = next((each.vocabulary for each in _classes_in(skill)), None)
        return {
            "name": skill.name,
            "parents": _parents(description),
            "doc": skill.doc,
            "place": self._places.of(skill.span),
            "parameters": [self._parameter(each) for each in skill.parameters],
            "conditions": {
                "pre": [self._condition(each, ontology) for each in skill.pre],
                "hold": [self._condition(each, ontology) for each in skill.hold],
                "post": [self._condition(each, ontology) for each in skill.post],
            },
            "trees": [
                tree_of(each, self._library, self._places) for each in self._trees[skill.name]
            ],
            "permits": [self._permission(each) for each in skill.permits],
            "uses": [self._use(each) for each in skill.uses],
        }

    def _parameter(self, found: Parameter) -> dict[str, Any]:
        return {
            "name": found.name,
            "key": found.key,
            "kind": _KINDS[found.kind],
            "type": _type_of(found),
            "is_output": found.is_output,
            "default": None if found.default is None else spelled_value(found.default),
            "place": self._places.of(found.span),
        }

    def _condition(self, clause: Clause, ontology: object) -> dict[str, Any]:
        text = clause.span.text
        if isinstance(ontology, Ontology):
            text = spelled(clause.statement, ontology.model)
        place = self._places.of(clause.span)
        return {"text": text, "statement": written(clause.statement), "place": place}

    def _permission(self, found: Permission) -> dict[str, Any]:
        return {
            "kind": found.kind.value,
            "with": [
                {"parameter": each.parameter, "class": name_of(each.owl_class)}
                for each in found.individuals
            ],
            "limit": vars(found.limit) if found.limit else None,
            "place": self._places.of(found.span),
        }

    def _use(self, found: Use) -> dict[str, Any]:
        return {
            "kind": found.kind.value,
            "name": found.name,
            "type": found.type,
            "place": self._places.of(found.span),
        }

    def _scene_by_iri(self) -> list[tuple[Ontology, Location]]:
        """The locations by IRI. An individual is in one scene."""
        found: dict[str, tuple[Ontology, Location]] = {}
        for each in self._scene:
            location = each[1]
            first = found.setdefault(location.iri, each)[1]
            if first is not location:
                twice = errors.SameName(kind="locations", spelled=location.iri)
                session.report(twice.at(location.span, twice.Other().at(first.span)))
        return [found[iri] for iri in sorted(found)]

    def _location(self, ontology: Ontology, found: Location) -> dict[str, Any]:
        return {
            "iri": found.iri,
            "label": found.label or None,
            "classes": sorted(name_in(ontology, each) for each in found.types),
            "frame": found.frame or None,
            "corners": found.corners,
            "place": self._places.of(found.span),
        }


def _classes_in(skill: SkillInterface) -> Iterator[OntologyClass]:
    """The classes that the parameters and the permissions of a skill name."""
    yield from (each.type for each in skill.parameters if isinstance(each.type, OntologyClass))
    yield from (individual.owl_class for each in skill.permits for individual in each.individuals)


def _parents(description: SkillClass) -> list[str]:
    """The base descriptions of a description, nearest first."""
    above = description.__mro__[1:]
    return [
        each.__name__
        for each in above
        if issubclass(each, SkillDescription) and each is not SkillDescription
    ]


def _type_of(found: Parameter) -> str:
    if isinstance(found.type, OntologyClass):
        return name_of(found.type)
    return found.type.__name__ if found.type in BASIC else "enum"


def _by_name(kind: str, found: Iterable[dict[str, Any]]) -> list[dict[str, Any]]:
    """Entries of several ontologies, by name. Entries with the same IRI are the same."""
    known: dict[str, dict[str, Any]] = {}
    for each in found:
        first = known.setdefault(each["name"], each)
        if {**first, "place": None} != {**each, "place": None}:
            wrong = errors.SameName(kind=kind, spelled=each["name"])
            session.report(wrong.at(session.NOWHERE))
    return [known[name] for name in sorted(known)]


def _text(found: dict[str, Any]) -> str:
    """JSON with one line for each member of a list, so that changes are visible."""
    parts = []
    for key, value in found.items():
        if isinstance(value, list) and value:
            lines = ",\n".join(map(_json, value))
            parts.append(f"{_json(key)}: [\n{lines}\n]")
        else:
            parts.append(f"{_json(key)}: {_json(value)}")
    return "{\n" + ",\n".join(parts) + "\n}\n"


def _json(value: object) -> str:
    return json.dumps(value, allow_nan=False)
