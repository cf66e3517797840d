"""Closed sets: a skill or a class with everything that is derived from it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence


class Closure:
    """The names below and above other names. `parents` maps each name to the names that it is
    derived from.

    Parents without an entry of their own are included. All names on a circle, such as equivalent
    classes, are derived from each other.
    """

    def __init__(self, parents: Mapping[str, Sequence[str]]) -> None:
        self._parents = parents
        self._children: dict[str, list[str]] = {}
        for name, above in parents.items():
            for parent in above:
                self._children.setdefault(parent, []).append(name)

    def below(self, name: str) -> tuple[str, ...]:
        """The name and all names that are derived from it, sorted."""
        return _reached(name, self._children)

    def above(self, name: str) -> tuple[str, ...]:
        """The name and all names that it is derived from, sorted."""
        return _reached(name, self._parents)

    def are_related(self, one: str, other: str) -> bool:
        """Say whether two names are equal, or one is derived from the other, or another name is
        derived from both.
        """
        return not set(self.below(one)).isdisjoint(self.below(other))


def _reached(name: str, following: Mapping[str, Sequence[str]]) -> tuple[str, ...]:
    found = {name}
    waiting = [name]
    while waiting:
        for each in following.get(waiting.pop(), ()):
            if each not in found:
                found.add(each)
                waiting.append(each)
    return tuple(sorted(found))


def circle_among(parents: Mapping[str, Sequence[str]]) -> str | None:
    """A name that is derived from itself, if there is one."""
    waits_for = {name: len([each for each in above if each in parents])
                 for name, above in parents.items()}  # fmt: skip
    children: dict[str, list[str]] = {}
    for name, above in parents.items():
        for each in above:
            children.setdefault(each, []).append(name)
    ready = [name for name, count in waits_for.items() if count == 0]
    while ready:
        name = ready.pop()
        del waits_for[name]
        for child in children.get(name, ()):
            waits_for[child] -= 1
            if waits_for[child] == 0:
                ready.append(child)
    return _on_circle(next(iter(waits_for)), parents, waits_for) if waits_for else None


def _on_circle(start: str, parents: Mapping[str, Sequence[str]], left: Mapping[str, int]) -> str:
    """A name on a circle, found by steps from a name to a parent in `left`."""
    seen: set[str] = set()
    name = start
    while name not in seen:
        seen.add(name)
        name = next(each for each in parents[name] if each in left)
    return name
