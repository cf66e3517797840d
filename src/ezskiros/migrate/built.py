"""The classes of a file as base classes of skills, for the migration of other files."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

import libcst as cst

from ezskiros.migrate.bases import BuiltClass
from ezskiros.migrate.built_on import SKIROS2_BASES
from ezskiros.migrate.calls import last_name
from ezskiros.migrate.classes import describing_method
from ezskiros.migrate.implementations import described_by, description_name
from ezskiros.migrate.robots import is_about_robot


def built_in(
    classes: Iterable[cst.ClassDef], path: str, names: Mapping[str, str]
) -> Iterator[BuiltClass]:
    """Some classes as possible base classes for other files. `names` are the imported names of the
    file.
    """
    for node in classes:
        called = [last_name(each.value) or "" for each in node.bases]
        bases = [names.get(each, each) for each in called]
        call = described_by(node)
        name = description_name(call) if call is not None else None
        skill = None if call is None else names.get(name or "", name or "")
        yield BuiltClass(
            path,
            node.name.value,
            [each for each in bases if each not in SKIROS2_BASES],
            is_native=not SKIROS2_BASES.isdisjoint(bases),
            is_described=describing_method(node) is not None or call is not None,
            implements=skill,
            is_about_robot=is_about_robot(node),
        )
