"""Base classes of skills in all files: those that become mixins, and those that stay unchanged.

A base class of SkiROS2's primitives without a description becomes a class without SkiROS2's own
base. All classes that are derived from one class are translated together, or none of them.
"""

from __future__ import annotations

import enum
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

ClassId = tuple[str, str]
"""The file and the name of a class."""


@dataclass(frozen=True)
class BuiltClass:
    """A class of a file, and its base classes.

    `bases` have the names of their own modules. A class that `is_native` has a base of SkiROS2's
    own. A class that `is_described` has a description, or `implements` a skill: `implements` is the
    name of the skill, which is empty for a computed name.
    """

    path: str
    name: str
    bases: Sequence[str] = ()
    is_native: bool = False
    is_described: bool = False
    implements: str | None = None
    is_about_robot: bool = False

    @property
    def id(self) -> ClassId:
        """The file and the name of the class, because several classes may have the same name."""
        return self.path, self.name


class Root(enum.Enum):
    """The kind of the last base class."""

    NATIVE = enum.auto()
    """A base of SkiROS2's own."""
    DESCRIBED = enum.auto()
    """A class that describes or implements a skill."""
    UNKNOWN = enum.auto()
    """A class that is not in the files."""
    PLAIN = enum.auto()
    """A class without relation to SkiROS2: an existing mixin, or any other class."""


@dataclass(frozen=True)
class Cause:
    """The class because of which others stay unchanged, and the codes of its own findings."""

    id: ClassId
    codes: Sequence[str]


class Bases:
    """The classes of some files. `left` are the classes that stay unchanged, each with its
    cause.
    """

    def __init__(
        self,
        classes: Iterable[BuiltClass] = (),
        left: Mapping[ClassId, Cause] = MappingProxyType({}),
    ) -> None:
        self._classes, self.left = list(classes), left
        self._by_name: dict[str, list[BuiltClass]] = {}
        for each in self._classes:
            self._by_name.setdefault(each.name, []).append(each)
        self._groups = self._found_groups()
        self._mixins = {each.id for group in self._groups for each in group if _may_be(each)}

    # --- queries --------------------------------------------------------------------------------

    def is_mixin(self, found: ClassId) -> bool:
        """Say whether a class is a base of skills that loses SkiROS2's own base."""
        return found in self._mixins

    def below(self, name: str, path: str) -> tuple[Root, str]:
        """The root and the name of the class with this name in a file."""
        return self._below(name, path, set())

    def on_top(self, found: ClassId) -> list[BuiltClass]:
        """The classes that implement skills and are derived from a class."""
        return [each for each in self._classes if each.implements and found in self._all_of(each)]

    def robots(self) -> set[str]:
        """The skills whose robot is used in a base class of their implementations."""
        return {
            each.implements
            for each in self._classes
            if each.implements
            for base in self._bases_of(each)
            if base.is_about_robot
        }

    # --- unchanged classes ------------------------------------------------------------------------

    def with_left(self, causes: Mapping[ClassId, Sequence[str]]) -> Bases:
        """The same bases with more unchanged classes. The classes in `causes` keep all related
        classes unchanged; the codes are those of their findings.
        """
        left = {}
        for group in self._groups:
            found = [each.id for each in group if each.id in causes]
            # A class that is a base of others is a better cause than one of these.
            found.sort(key=lambda each: each not in self._mixins)
            for each in group if found else ():
                left[each.id] = Cause(found[0], tuple(causes[found[0]]))
        return Bases(self._classes, left)

    def changed(self, before: Bases) -> set[ClassId]:
        """The classes with another result than before."""
        both = {*self.left, *before.left}
        return {each for each in both if self.left.get(each) != before.left.get(each)}

    # --- relations of classes ---------------------------------------------------------------------

    def _called(self, name: str, path: str) -> BuiltClass | None:
        found = self._by_name.get(name, [])
        same = [each for each in found if each.path == path]
        near = [each for each in found if Path(each.path).parent == Path(path).parent]
        meant = same or near or found
        return meant[-1] if len(meant) == 1 or same else None

    def _below(self, name: str, path: str, seen: set[ClassId]) -> tuple[Root, str]:
        known = self._called(name, path)
        if known is None:
            return (Root.PLAIN if name == "object" else Root.UNKNOWN), name
        if known.is_described:
            return Root.DESCRIBED, name
        if known.is_native:
            return Root.NATIVE, name
        if known.id in seen:
            return Root.PLAIN, name
        seen.add(known.id)
        found = [self._below(each, known.path, seen) for each in known.bases]
        return min(found, key=lambda each: each[0].value, default=(Root.PLAIN, name))

    def _bases_of(self, found: BuiltClass) -> Iterator[BuiltClass]:
        """All base classes of a class that have no description."""
        work, seen = [found], {found.id}
        while work:
            each = work.pop()
            for base in each.bases:
                known = self._called(base, each.path)
                if known is not None and known.id not in seen and not known.is_described:
                    seen.add(known.id)
                    work.append(known)
                    yield known

    def _all_of(self, found: BuiltClass) -> Collection[ClassId]:
        return {each.id for each in self._bases_of(found)}

    def _found_groups(self) -> list[list[BuiltClass]]:
        """Classes that have to be translated together, each group with a skill and a base of it."""
        group_of: dict[ClassId, dict[ClassId, BuiltClass]] = {}
        for each in self._classes:
            if self._is_on_native(each) and (_may_be(each) or each.implements is not None):
                group = {each.id: each}
                for base in self._bases_of(each):
                    group |= {base.id: base} if self._is_on_native(base) else {}
                for one in [*group]:
                    group |= group_of.get(one, {})
                group_of |= dict.fromkeys(group, group)
        groups = [[*each.values()] for each in {id(g): g for g in group_of.values()}.values()]
        return [
            group
            for group in groups
            if any(map(_may_be, group)) and any(each.implements is not None for each in group)
        ]

    def _is_on_native(self, found: BuiltClass) -> bool:
        """Say whether SkiROS2's own base is below a class, without another skill between them."""
        roots = (self.below(base, found.path)[0] for base in found.bases)
        return found.is_native or Root.NATIVE in roots


def _may_be(found: BuiltClass) -> bool:
    """Say whether a class has no description, and can become a mixin."""
    return not found.is_described
