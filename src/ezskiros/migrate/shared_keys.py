"""Undeclared keys that the children of a compound skill share, and the parameters that its
description gets for them.

SkiROS2 has one set of keys for all that runs. So a key that a remap says is the one of every child
with it, and of the children below those, as long as all the descriptions between have it.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from ezskiros.migrate.skills import SharedKeys, Skill, SkillId

GENERAL = "sumo:Object"
"""The class of all things: who names it takes anything."""


@dataclass(frozen=True)
class SharingChild:
    """A child of a tree. `shared` are the keys that its parameters have, with their classes or
    types, and `renamed` those of them that a remap says; its own keys that are `hidden` are others
    outside.
    """

    skill: Skill
    shared: Mapping[str, str]
    renamed: Collection[str]
    hidden: Collection[str]


@dataclass(frozen=True)
class SharingTree:
    """The tree of the implementation `name`; one that `can_be` is translated as soon as its
    description has all the keys.
    """

    name: str
    skill: Skill
    children: Sequence[SharingChild]
    can_be: bool

    @property
    def skills(self) -> list[Skill]:
        """The skill of the tree, and those of its children."""
        return [self.skill, *(each.skill for each in self.children)]

    @property
    def undeclared(self) -> list[str]:
        """The keys that remaps say and the description has not, unless it got them here."""
        declared = {*self.skill.names} - {*self.skill.added}
        renamed = [key for child in self.children for key in child.renamed]
        return [key for key in dict.fromkeys(renamed) if key not in declared]


@dataclass
class _Need:
    """A key that a description needs: the children that have it, each with its class or type; the
    implementations with these children; and the skills whose trees ask for it.
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
        """The trees that are translated if they get all their keys, and that do."""
        return [
            tree
            for tree in self._trees
            if tree.can_be and refused.get(tree.skill.id, {}).keys().isdisjoint(tree.undeclared)
        ]

    def _want(self, tree: SharingTree, key: str, asking: SharingTree) -> None:
        """A description needs a key for the tree `asking`, and so do those between it and the
        children that have the key.
        """
        need = self._needs.setdefault((tree.skill.id, key), _Need())
        need.asking.setdefault(asking.skill.id)
        is_known = tree.name in need.names
        need.names += [] if is_known else [tree.name]
        for child in tree.children:
            use = (child.skill.name, child.shared.get(key, ""))
            if key in child.shared and use not in need.uses:
                # A name that a child has itself says more than one that others have for it.
                need.uses.insert(len(need.uses) if key in child.renamed else 0, use)
            is_own = key in child.shared and key not in child.skill.added
            if not (is_known or is_own or key in child.hidden or child.skill.is_new):
                for below in self._below(child.skill, key):
                    self._want(below, key, asking)

    def _below(self, skill: Skill, key: str) -> Iterator[SharingTree]:
        """The trees of a skill somewhere in which a child has a key."""
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
    """The class or type of a shared key, or else why it is not known. Who takes anything takes
    what the others do.
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
    """Say whether two texts differ by one letter, or by two that are swapped."""
    short, long = sorted((written, meant), key=len)
    if len(long) - len(short) > 1 or short == long:
        return False
    start = next((i for i, (a, b) in enumerate(zip(short, long)) if a != b), len(short))  # noqa: B905
    if long[start].isdigit():  # `Waste1` and `Waste2` are two
        return False
    is_swapped = short[start : start + 2] == long[start : start + 2][::-1]
    is_other = short[start + (len(short) == len(long)) :] == long[start + 1 :]
    return is_other or (is_swapped and short[start + 2 :] == long[start + 2 :])
