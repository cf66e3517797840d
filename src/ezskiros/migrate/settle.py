"""Repeated migration of files until no file changes the result of another."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ezskiros.migrate.migrated import Migrated
from ezskiros.migrate.shared_keys import shared_keys
from ezskiros.migrate.skills import KnownSkills

_MOST_PASSES = 10
"""The most passes. Each pass handles skills one level higher in the trees."""


def until_settled(
    skills: KnownSkills, migrated: Callable[[KnownSkills], Sequence[Migrated]]
) -> Sequence[Migrated]:
    """The files, migrated so that descriptions have the keys that children share, and that classes
    with the same base stay unchanged together. Each pass shows further descriptions that need keys,
    and further classes that stay unchanged.
    """
    found = migrated(skills)
    for _ in range(_MOST_PASSES):
        keys = shared_keys(tree for each in found for tree in each.trees)
        causes = {id_: codes for each in found for id_, codes in each.obstacles.items()}
        bases = skills.bases.with_left(causes)
        if keys == skills.keys and not bases.changed(skills.bases):
            break
        skills = skills.with_more(keys, bases)
        found = migrated(skills)
    return found
