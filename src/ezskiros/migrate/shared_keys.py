"""Undeclared keys that the children of a compound skill share, and the parameters that its
description gets for them.

SkiROS2 has one set of keys for all running skills. So a key that a remap names is the key of every
child with this key, and of the children below, if all descriptions between have the key.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from ezskiros.migrate.skills import MigratedSkill, SharedKeys, SkillId

GENERAL = "sumo:Object"
"""The class of all individuals. A parameter of this class accepts anything."""


@dataclass(frozen=True)
class SharingChild:
    """A child of a tree. `shared` are the keys of its parameters, with their classes or types, and
    `renamed` the remapped ones among them. Its own keys that are `hidden` have another meaning
    outside.
    """

    skill: MigratedSkill
    shared: Mapping[str, str]
    renamed: Collection[str]
    hidden: Collection[str]


@dataclass(frozen=True)
class SharingTree:
    """The tree of the implementation `name`. If it `can_be` translated, only keys of its
    description are missing.
    """

    name: str
    skill: MigratedSkill
    children: Sequence[SharingChild]
    can_be: bool

    @property
    def skills(self) -> list[MigratedSkill]:
        """The skill of the tree, and the skills of its children."""
        return [self.skill, *(each.skill for each in self.children)]

    @property
    def undeclared(self) -> list[str]:
        """The keys in remaps that the description does not have, except keys that were added
        here.
        """
        declared = {*self.skill.names} - {*self.skill.added}
        renamed = [key for child in self.children for key in child.renamed]
        return [key for key in dict.fromkeys(renamed) if key not in declared]


@dataclass
class _Need:
    """A key that a description needs: the children with the key, each with its class or type; the
    implementations with these children; and the skills whose trees need the key.
    """

    uses: list[tuple[str, str]] = field(default_factory=list)
    names: list[str] = field(default_factory=list)
    asking: dict[SkillId, None] = field(default_factory=dict)


def shared_keys(trees: Iterable[SharingTree]) -> SharedKeys:
    """The keys that descriptions get or do not get for the trees of some files."""
    return _Sharing(list(trees)).found()


class _Sharing:
    def __init__(self, trees: Sequence[SharingTree]) -> None:
        self._trees = trees
        self._of: dict[SkillId, list[SharingTree]] = {}
        for each in trees:
            if each.can_be:
                self._of.setdefault(each.skill.id, []).append(each)
        self._needs: dict[tuple[SkillId, str], _Need] = {}

    def found(self) -> SharedKeys:
        refused: dict[SkillId, dict[str, str]] = {}
        for tree in self._trees:
            why = {key: text for key in tree.undeclared if (text := _refused(tree, key))}
            refused.setdefault(tree.skill.id, {}).update(why)
        unclear = True
        while unclear:  # each time for fewer trees
            self._needs = {}
            for tree in self._able(refused):
                for key in tree.undeclared:
                    self._want(tree, key, tree)
            unclear = False
            for (_, key), need in self._needs.items():
                kind, why_not = _kind(need.uses)
                for skill in need.asking if not kind else ():
                    refused.setdefault(skill, {})[key] = why_not
                    unclear = True
        added: dict[SkillId, dict[str, str]] = {}
        sharing: dict[SkillId, dict[str, list[str]]] = {}
        for (skill, key), need in self._needs.items():
            added.setdefault(skill, {})[key] = _kind(need.uses)[0]
            sharing.setdefault(skill, {})[key] = need.names
        return SharedKeys(added, {skill: why for skill, why in refused.items() if why}, sharing)

    def _able(self, refused: Mapping[SkillId, Mapping[str, str]]) -> list[SharingTree]:
        """The trees that can be translated if they get all their keys, and that do get them."""
        return [
            tree
            for tree in self._trees
            if tree.can_be and refused.get(tree.skill.id, {}).keys().isdisjoint(tree.undeclared)
        ]

    def _want(self, tree: SharingTree, key: str, asking: SharingTree) -> None:
        """Add a key to a description for the tree `asking`, and to the descriptions between it and
        the children with the key.
        """
        need = self._needs.setdefault((tree.skill.id, key), _Need())
        need.asking.setdefault(asking.skill.id)
        is_known = tree.name in need.names
        need.names += [] if is_known else [tree.name]
        for child in tree.children:
            use = (child.skill.name, child.shared.get(key, ""))
            if key in child.shared and use not in need.uses:
                # The name in the child itself is more precise than names that others use for it.
                need.uses.insert(len(need.uses) if key in child.renamed else 0, use)
            is_own = key in child.shared and key not in child.skill.added
            if not (is_known or is_own or key in child.hidden or child.skill.is_new):
                for below in self._below(child.skill, key):
                    self._want(below, key, asking)

    def _below(self, skill: MigratedSkill, key: str) -> Iterator[SharingTree]:
        """The trees of a skill with a child that has a key, on any level."""
        for tree in self._of.get(skill.id, ()):
            if self._has(tree, key, set()):
                yield tree

    def _has(self, tree: SharingTree, key: str, seen: set[str]) -> bool:
        if tree.name in seen:
            return False
        seen.add(tree.name)
        for child in tree.children:
            if key in child.shared and key not in child.skill.added:
                return True
            below = self._of.get(child.skill.id, ()) if key not in child.hidden else ()
            if any(self._has(each, key, seen) for each in below):
                return True
        return False


def _kind(uses: Sequence[tuple[str, str]]) -> tuple[str, str]:
    """The class or type of a shared key, or the reason why it is unknown. Children that accept
    anything follow the others.
    """
    by_kind = {kind: name for name, kind in reversed(uses)}
    if len(by_kind) > 1:
        by_kind.pop(GENERAL, None)
    if "" in by_kind:
        return "", f"for `{by_kind['']}` it is of a type that has no name here"
    if len(by_kind) == 1:
        return next(iter(by_kind)), ""
    said = [f"{_article(kind)} for `{name}`" for kind, name in reversed(by_kind.items())]
    return "", f"it is {', and '.join(said)}"


def _article(kind: str) -> str:
    return f"{'an' if kind[0] in 'aeiou' else 'a'} {kind}"


def _refused(tree: SharingTree, key: str) -> str:
    """The reason why a description gets no parameter for a key; an empty string if it may get
    one.
    """
    if tree.skill.is_new:
        return f"`{tree.skill.name}` is a skill of EzSkiROS already"
    uses = [child for child in tree.children if key in child.shared]
    if len(uses) > 1:
        return ""
    others = [each for child in tree.children for each in child.shared]
    known = [*tree.skill.names, *(each for each in others if others.count(each) > 1)]
    meant = next((each for each in known if _is_slip(key, each)), "")
    return f'only this child has it: is "{meant}" meant?' if meant else ""


def _is_slip(written: str, meant: str) -> bool:
    """Say whether two texts differ by one letter or by two exchanged letters."""
    short, long = sorted((written, meant), key=len)
    if len(long) - len(short) > 1 or short == long:
        return False
    start = next((i for i, (a, b) in enumerate(zip(short, long)) if a != b), len(short))  # noqa: B905
    if long[start].isdigit():  # `Waste1` and `Waste2` are different
        return False
    is_swapped = short[start : start + 2] == long[start : start + 2][::-1]
    is_other = short[start + (len(short) == len(long)) :] == long[start + 1 :]
    return is_other or (is_swapped and short[start + 2 :] == long[start + 2 :])
