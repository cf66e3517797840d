"""The skills that the migrated files describe, with the facts that implementations add."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType

import libcst as cst

from ezskiros.migrate.bases import Bases
from ezskiros.migrate.calls import last_name, literal_text
from ezskiros.migrate.keys import ROBOT, more_names
from ezskiros.migrate.parameters import SourceParameter
from ezskiros.migrate.values import BASIC
from ezskiros.skills.markers import Option, ParameterKind

_NOT_REQUIRED = {ParameterKind.INFERRED.name, ParameterKind.OPTIONAL.name, Option.OUTPUT.name}
SkillId = tuple[str, str]
"""The file and the name of a skill."""
NEW = "description"
"""The method that describes a skill in EzSkiROS."""


@dataclass(frozen=True)
class MigratedSkill:
    """A skill: the names of its parameters by key, and the parameters for individuals.

    For an unchanged skill, only the codes of its findings are known. With `needs_robot`, the skill
    must declare a robot. `kinds` are the known classes and types of parameters by key. `added` are
    the keys of parameters that only its children have in SkiROS2; an `is_new` skill gets none.
    """

    name: str
    path: str
    names: Mapping[str, str] = field(default_factory=dict)
    individuals: Collection[str] = frozenset()
    left_for: Sequence[str] = ()
    needs_robot: bool = False
    kinds: Mapping[str, str] = field(default_factory=dict)
    added: Collection[str] = frozenset()
    is_new: bool = False

    @property
    def is_left(self) -> bool:
        """Say whether the description stays unchanged."""
        return bool(self.left_for)

    def left_as(self) -> str:
        """The text of marks and messages for an unchanged skill."""
        return f"not translated because of {' and '.join(dict.fromkeys(self.left_for))}"

    @property
    def id(self) -> SkillId:
        """The file and the name of the skill, because several skills may have the same name."""
        return self.path, self.name

    def with_added(self, kinds: Mapping[str, str]) -> MigratedSkill:
        """A copy with more parameters, of the given classes and types."""
        if not kinds:
            return self
        names = {**self.names, **more_names(self.names, kinds)}
        individuals = {
            *self.individuals,
            *(names[key] for key, kind in kinds.items() if kind not in BASIC),
        }
        return replace(
            self,
            names=names,
            individuals=individuals,
            kinds={**self.kinds, **kinds},
            added=kinds.keys(),
        )


def skill_of(
    name: str, path: str, parameters: Iterable[SourceParameter], *, is_new: bool = False
) -> MigratedSkill:
    """The skill of a translated description."""
    found = list(parameters)
    names = {each.key: each.name for each in found}
    individuals = {each.name for each in found if each.is_individual}
    needs_robot = any(each.key == ROBOT and each.is_required for each in found)
    kinds = {each.key: each.kind for each in found if each.kind}
    return MigratedSkill(
        name, path, names, individuals, needs_robot=needs_robot, kinds=kinds, is_new=is_new
    )


@dataclass(frozen=True)
class SharedKeys:
    """The keys that children share and that a description does not declare: parameters to be
    `added`, with their classes or types, and keys to be `refused`, with the reason. `sharing` are
    the implementations for which a description gets parameters.
    """

    added: Mapping[SkillId, Mapping[str, str]] = field(default_factory=dict)
    refused: Mapping[SkillId, Mapping[str, str]] = field(default_factory=dict)
    sharing: Mapping[SkillId, Mapping[str, Sequence[str]]] = field(default_factory=dict)

    def changed(self, before: SharedKeys) -> set[SkillId]:
        """The skills with other keys than before."""
        pairs = (
            (self.added, before.added),
            (self.refused, before.refused),
            (self.sharing, before.sharing),
        )
        return {
            each for new, old in pairs for each in {*new, *old} if new.get(each) != old.get(each)
        }


class KnownSkills:
    """All skills of some files. SkiROS2 finds them by their names alone, whatever their modules.

    `robots` are the skills whose robot is used and which SkiROS2 adds by itself. `labels` are the
    names that implementations give themselves, with their class names. `keys` are the keys that
    children share and no description declares. `bases` are the base classes of implementations.
    """

    def __init__(
        self,
        found: Iterable[MigratedSkill] = (),
        robots: Collection[str] = (),
        labels: Mapping[str, str] = MappingProxyType({}),
        keys: SharedKeys | None = None,
        bases: Bases | None = None,
    ) -> None:
        self.robots, self.labels, self.keys = {*robots}, labels, keys or SharedKeys()
        self.bases = bases or Bases()
        self._before = [*found]
        self._found: dict[str, list[MigratedSkill]] = {}
        for each in self._before:
            more = self.keys.added.get(each.id, {})
            self._found.setdefault(each.name, []).append(each.with_added(more))

    def with_more(self, keys: SharedKeys, bases: Bases) -> KnownSkills:
        """The same skills with other shared keys, and with other unchanged classes."""
        return KnownSkills(self._before, self.robots, self.labels, keys, bases)

    def changed(self, before: KnownSkills) -> set[SkillId]:
        """The skills and other classes with another state than before."""
        return self.keys.changed(before.keys) | self.bases.changed(before.bases)

    def called(self, name: str, path: str) -> list[MigratedSkill]:
        """The skills with a name: those of the same file first, then those of the same folder, then
        others.
        """
        found = self._found.get(name, [])
        same = [each for each in found if each.path == path]
        near = [each for each in found if Path(each.path).parent == Path(path).parent]
        return same or near or found


def new_skills(module: cst.Module, path: str) -> Iterator[MigratedSkill]:
    """The skills that a module already describes in EzSkiROS."""
    classes = [node for node in module.body if isinstance(node, cst.ClassDef)]
    for node in classes:
        for part in node.body.body:
            if isinstance(part, cst.FunctionDef) and part.name.value == NEW:
                declared = _declared(part.params)
                yield skill_of(node.name.value, path, declared, is_new=True)


def _declared(parameters: cst.Parameters) -> Iterator[SourceParameter]:
    for each in (*parameters.posonly_params, *parameters.params[1:], *parameters.kwonly_params):
        name = each.name.value
        annotation = each.annotation.annotation if each.annotation else cst.Name(name)
        key, kind = _read(annotation)
        is_individual = (
            isinstance(kind, (cst.Attribute, cst.Subscript)) or last_name(kind) not in BASIC
        )
        is_required = each.default is None and _NOT_REQUIRED.isdisjoint(_marks(annotation))
        yield SourceParameter(
            key or name,
            name,
            "",
            is_individual=is_individual,
            is_required=is_required,
            kind=_kind(kind),
        )


def _kind(annotation: cst.BaseExpression) -> str:
    """The kind of an annotation: `skiros:Product` for `skiros.Product`, `float` for `float`;
    otherwise empty.
    """
    match annotation:
        case cst.Attribute(value=cst.Name(value=namespace), attr=cst.Name(value=name)):
            return f"{namespace.rstrip('_')}:{name}"
        case cst.Name(value=name) if name in BASIC:
            return name
        case _:  # open: any other node
            pass
    return ""


def _marks(annotation: cst.BaseExpression) -> Iterator[str]:
    """The markers around a class, such as `LOCK` and `INFERRED` in
    `LOCK[INFERRED[skiros.Product]]`.
    """
    while isinstance(annotation, cst.Subscript):
        yield last_name(annotation.value) or ""
        inner = annotation.slice[0].slice
        annotation = inner.value if isinstance(inner, cst.Index) else annotation.value


def _read(annotation: cst.BaseExpression) -> tuple[str, cst.BaseExpression]:
    """The key in an annotation such as `Annotated[LOCK[skiros.Product], Key("the box")]`, if any,
    and its class.
    """
    key = ""
    while isinstance(annotation, cst.Subscript) and last_name(annotation.value) is not None:
        inner = [each.slice for each in annotation.slice]
        if not isinstance(inner[0], cst.Index) or literal_text(inner[0].value) is not None:
            break  # a class without a Python name: `store["2nd shelf"]`
        key = _key(inner[1:]) or key
        annotation = inner[0].value
    return key, annotation


def _key(parts: Iterable[cst.BaseSlice]) -> str:
    for part in parts:
        match part:
            case cst.Index(value=cst.Call(args=[cst.Arg(value=text)]) as call):
                if last_name(call.func) == "Key":
                    return literal_text(text) or ""
            case _:  # open: any other slice
                pass
    return ""
