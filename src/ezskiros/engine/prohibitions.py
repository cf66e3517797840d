"""Skills that rules always stop, so that no plan uses them: `Drive`, or
`Drive(Target=hall.SchoolCorridor)` for individuals of one class only.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from ezskiros.ontology import Ontology
from ezskiros.skills.interface import SkillInterface

_FORM = re.compile(r"(?P<skill>[A-Za-z_]\w*)(?:\((?P<individuals>[^()]+)\))?", re.ASCII)


class UnknownProhibitionError(ValueError):
    """A text that is not a prohibition, or contains an unknown name. The message gives the
    reason.
    """


@dataclass(frozen=True)
class Prohibition:
    """A skill that rules stop whenever all `individuals` apply: pairs of a parameter and the IRI of
    the class of its individual. Without `individuals`, the skill is always stopped.
    """

    skill: str
    individuals: tuple[tuple[str, str], ...] = ()


def read_prohibition(
    text: str, skills: Mapping[str, SkillInterface], ontology: Ontology
) -> Prohibition:
    """Parse the text of a prohibition. Raises `UnknownProhibitionError`."""
    found = _FORM.fullmatch(text)
    if found is None:
        raise UnknownProhibitionError(
            f"`{text}` is not a skill, or a skill with the classes of its individuals"
        )
    name, individuals = found["skill"], found["individuals"]
    skill = skills.get(name)
    if skill is None:
        raise UnknownProhibitionError(f"there is no skill `{name}`")
    parts = [] if individuals is None else individuals.split(",")
    return Prohibition(name, tuple(_individual(each.strip(), skill, ontology) for each in parts))


def _individual(text: str, skill: SkillInterface, ontology: Ontology) -> tuple[str, str]:
    name, _, kind = text.partition("=")
    parameter = skill.parameter(name)
    if parameter is None or not parameter.is_individual:
        raise UnknownProhibitionError(f"`{skill.name}` has no parameter `{name}` for an individual")
    classes = ontology.model.classes
    iris = [iri for iri, spelled in ontology.spelled.items() if spelled == kind and iri in classes]
    if not iris:
        raise UnknownProhibitionError(f"the ontology has no class `{kind}`")
    return name, iris[0]
