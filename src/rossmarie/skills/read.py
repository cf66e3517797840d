"""Reads the content of a skills file from its text.

The content is not trusted: any violation of the format is an `UnreadableSkills` with its place.
Unknown keys are ignored.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Protocol, TypeVar

from dslkit.source import SourceFile, ending
from rossmarie.skills.closed import circle_among
from rossmarie.skills.json_reader import Json, UnreadableJson, parse_json
from rossmarie.skills.locations import location, place_of
from rossmarie.skills.model import (
    ChildSkill,
    IndividualProperty,
    Node,
    OntologyClass,
    Permission,
    PermissionLimit,
    Skill,
    SkillCondition,
    SkillConditions,
    SkillFile,
    SkillParameter,
    SkillSource,
    Use,
    UseKind,
)
from rossmarie.skills.trees import RETRY, read_tree, steps

FORMAT = "ezskiros/skills"
VERSION = 1
MESSAGE_TYPE = "skill_context_msgs/SkillContext"
LARGEST_FILE = 16 * 2**20
"""The largest size of a skills file in bytes."""
LONGEST_PERIOD = 3600.0
"""The longest time in seconds between two messages of a context."""
PLAIN_TYPES = ("float", "int", "bool", "str", "enum")
"""The types of parameters that stand for no individual."""
NUMBERS = ("float", "int")
"""The numeric types among the plain types."""

_STARTING_AGAIN = (RETRY,)
"""Nodes of a tree that start a child again after a failure."""

_DIGEST = re.compile(r"[0-9a-f]{64}")
_NAME = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_CLASS = re.compile(r"[A-Za-z_]\w*(?:\.[A-Za-z_]\w*)*", re.ASCII)
_TOPIC = re.compile(r"/[A-Za-z_][A-Za-z0-9_]*(?:/[A-Za-z0-9_]+)*", re.ASCII)


class UnreadableSkills(Exception):
    """An unusable skills file: the reason, the text read so far, and the offset in the text. The
    offset is None if the reason contains the place. `is_missing` is True if the file does not
    exist.
    """

    def __init__(
        self,
        problem: str,
        file: SourceFile | None = None,
        offset: int | None = None,
        *,
        is_missing: bool = False,
    ) -> None:
        super().__init__(problem)
        self.problem = problem
        self.file = file
        self.offset = offset
        self.is_missing = is_missing


class _Named(Protocol):
    @property
    def name(self) -> str: ...


_Item = TypeVar("_Item", bound=_Named)


def read_text(path: Path) -> SourceFile:
    """The text of a skills file. Raises `UnreadableSkills`."""
    if ending(path) != ".json":
        raise UnreadableSkills("its name, or that of the file it links to, does not end in .json")
    try:
        with path.open("rb") as stream:
            content = stream.read(LARGEST_FILE + 1)
        if len(content) > LARGEST_FILE:
            raise UnreadableSkills(f"it is larger than {LARGEST_FILE // 2**20} MiB")
        return SourceFile.decoded(str(path), content)
    except FileNotFoundError as error:
        raise UnreadableSkills("there is no such file", is_missing=True) from error
    except UnicodeDecodeError as error:
        raise UnreadableSkills("it is not UTF-8 text") from error
    except (OSError, ValueError) as error:  # ValueError: an impossible path
        reason = getattr(error, "strerror", None) or "it cannot be opened"
        raise UnreadableSkills(reason.lower()) from error


def parse_skills(file: SourceFile) -> SkillFile:
    """The content of a skills file. Raises `UnreadableSkills`."""
    try:
        return _skills(parse_json(file.text))
    except UnreadableJson as error:
        raise UnreadableSkills(error.problem, file, error.offset) from error


def _skills(root: Json) -> SkillFile:
    root.get("format").one_of(FORMAT)
    version = root.get("version")
    if version.whole() != VERSION:
        version.fail(f"is {version.value}, and this program reads version {VERSION}")
    context = root.get("context")
    context.get("type").one_of(MESSAGE_TYPE)
    classes, locations = _by_name(root.get("classes"), _class), root.find("locations")
    skills = _by_name(root.get("skills"), _skill)
    _require_no_circle(root.get("skills"), skills, lambda each: each.parents)
    _require_known(root.get("skills"), classes)
    return SkillFile(
        digest=_matching(root.get("digest"), _DIGEST, "64 hexadecimal digits"),
        sources=root.get("sources").each(_source),
        topic=_matching(context.get("topic"), _TOPIC, "a topic such as /skill_context"),
        message_type=MESSAGE_TYPE,
        period_ns=_period_ns(context.get("period")),
        classes=classes,
        properties=_by_name(root.get("properties"), _property),
        skills=skills,
        locations=() if locations is None else locations.each(location),
    )


def _by_name(items: Json, make: Callable[[Json], _Item]) -> Mapping[str, _Item]:
    found: dict[str, _Item] = {}
    for item in items.elements():
        made = make(item)
        if made.name in found:
            item.get("name").fail(f"is `{made.name}`, which stands in the list before")
        found[made.name] = made
    return found


def _require_no_circle(
    items: Json, found: Mapping[str, _Item], parents: Callable[[_Item], tuple[str, ...]]
) -> None:
    name = circle_among({each: parents(item) for each, item in found.items()})
    if name is not None:
        items.fail(f"derive `{name}` from itself")


def _require_known(skills: Json, classes: Mapping[str, OntologyClass]) -> None:
    """Require that the class of each parameter for an individual is in the file."""
    for skill in skills.elements():
        for parameter in skill.get("parameters").elements():
            type_ = parameter.get("type")
            if type_.text() not in (*PLAIN_TYPES, *classes):
                type_.fail(f"is `{type_.text()}`, which is no class of the file")


def _period_ns(period: Json) -> int:
    seconds = period.number()
    nanoseconds = round(seconds * 1e9) if seconds <= LONGEST_PERIOD else 0
    if nanoseconds < 1:
        period.fail(f"is {seconds:g}, and no time up to {LONGEST_PERIOD:g} seconds")
    return nanoseconds


def _matching(value: Json, pattern: re.Pattern[str], form: str) -> str:
    if not pattern.fullmatch(value.text()):
        value.fail(f"is not {form}")
    return value.text()


def _name(value: Json) -> str:
    return _matching(value, _NAME, "a name")


def _class_name(value: Json) -> str:
    return _matching(value, _CLASS, "a name such as skiros.Product")


def _source(source: Json) -> SkillSource:
    path = source.get("path")
    if Path(path.text()).is_absolute() or "\0" in path.text():
        path.fail("is not relative to the folder of the file")
    return SkillSource(
        path.text(), _matching(source.get("sha256"), _DIGEST, "64 hexadecimal digits")
    )


def _class(item: Json) -> OntologyClass:
    parents = item.get("parents").each(_class_name)
    return OntologyClass(_class_name(item.get("name")), parents, place_of(item))


def _property(item: Json) -> IndividualProperty:
    return IndividualProperty(
        name=_class_name(item.get("name")),
        type=item.get("type").one_of("float", "int", "bool", "str"),
        of=item.get("of").each(_class_name),
        unit=item.get("unit").optional(Json.text),
        place=place_of(item),
    )


def _skill(item: Json) -> Skill:
    parameters = _by_name(item.get("parameters"), _parameter)
    permits = item.get("permits").each(lambda each: _permission(each, parameters))
    numbers = {name for name, each in parameters.items() if each.type in NUMBERS}
    trees = item.get("trees").each(lambda each: read_tree(each, _name, numbers))
    return Skill(
        name=_name(item.get("name")),
        parents=item.get("parents").each(_name),
        parameters=parameters,
        conditions=_conditions(item.get("conditions")),
        permits=permits,
        uses=item.get("uses").each(_use),
        children=tuple(_children(trees)),
        trees=trees,
        place=place_of(item),
    )


def _conditions(item: Json) -> SkillConditions:
    return SkillConditions(*(item.get(kind).each(_condition) for kind in ("pre", "hold", "post")))


def _condition(item: Json) -> SkillCondition:
    return SkillCondition(item.get("text").text(), item.get("statement").fields(), place_of(item))


def _use(item: Json) -> Use:
    kind = item.get("kind").one_of(*(each.value for each in UseKind))
    name = _matching(item.get("name"), _TOPIC, "a name such as /cmd_vel")
    return Use(UseKind(kind), name, item.get("type").optional(Json.text), place_of(item))


def _children(trees: Iterable[Node]) -> Iterator[ChildSkill]:
    """The skills in all trees, at any depth."""
    for tree in trees:
        for step, above in steps(tree):
            is_retried = any(each.kind in _STARTING_AGAIN for each in above)
            yield ChildSkill(step.skill, step.arguments, step.place, is_retried)


def _parameter(item: Json) -> SkillParameter:
    kind = item.get("kind").one_of("given", "inferred", "optional")
    is_output = item.get("is_output").boolean()
    default = item.get("default").optional(Json.text)
    return SkillParameter(
        name=_name(item.get("name")),
        type=item.get("type").text(),
        is_needed=kind != "optional" and not is_output,
        is_given=kind == "given" and not is_output and default is None,
        place=place_of(item),
        default=_number_in(default),
    )


def _number_in(spelled: str | None) -> float | None:
    """The number that a Python literal stands for; None for any other value, or an infinite one."""
    try:
        number = math.nan if spelled is None else float(spelled)
    except ValueError:
        return None
    return number if math.isfinite(number) else None


def _permission(item: Json, parameters: Mapping[str, SkillParameter]) -> Permission:
    return Permission(
        kind=item.get("kind").one_of("contact", "closeness", "speed", "force"),
        individuals=item.get("with").each(lambda each: _individual(each, parameters)),
        limit=item.get("limit").optional(_limit),
        place=place_of(item),
    )


def _individual(item: Json, parameters: Mapping[str, SkillParameter]) -> tuple[str | None, str]:
    parameter = item.get("parameter")
    name = parameter.optional(Json.text)
    if name is not None and name not in parameters:
        parameter.fail("is no parameter of the skill")
    return name, _class_name(item.get("class"))


def _limit(item: Json) -> PermissionLimit:
    return PermissionLimit(
        item.get("value").number(), item.get("unit").text(), item.get("si").number()
    )
