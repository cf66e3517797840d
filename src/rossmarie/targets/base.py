"""The interface of a target: a name, what it cannot do, and how it writes files.

A target takes a machine that `ir.verify` has passed. What it cannot do it says with ordinary
diagnostics, before it writes anything.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

from dslkit.diagnostics import Diagnostic
from rossmarie import ir
from rossmarie.targets.manifest import Placement


@dataclass(frozen=True)
class Target:
    """`unsupported` gives a finding for everything in a machine that the target cannot do; only if
    there is none, `generate` gives the files of the machine by name. Those that are `owned_by_user`
    are written once: a file that is there is left alone. `next_step` says what comes after
    `generate`, None if nothing has to be said. Only a target that `is_package` looks at where its
    node is placed.
    """

    name: str
    unsupported: Callable[[ir.Machine], Iterable[Diagnostic]]
    generate: Callable[[ir.Machine, Placement], Mapping[str, str]]
    owned_by_user: frozenset[str] = frozenset()
    next_step: Callable[[ir.Machine], str | None] = lambda _: None
    is_package: bool = False
