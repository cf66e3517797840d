"""The interface of a target: its name, its limits, and its generator.

A target takes a machine that `ir.verify` has accepted. It reports unsupported features with
ordinary diagnostics, before it writes anything.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

from dslkit.diagnostics import Diagnostic
from rossmarie import ir
from rossmarie.targets.manifest import Placement


@dataclass(frozen=True)
class Target:
    """A target and its functions.

    `unsupported` gives a finding for every feature of a machine that the target does not support.
    If there is none, `generate` gives the files of the machine by name. Files that are
    `owned_by_user` are written once: an existing file is left alone. `next_step` describes the step
    after `generate`; it is None if no step follows. Only a target that `is_package` uses the
    placement of the node.
    """

    name: str
    unsupported: Callable[[ir.Machine], Iterable[Diagnostic]]
    generate: Callable[[ir.Machine, Placement], Mapping[str, str]]
    owned_by_user: frozenset[str] = frozenset()
    next_step: Callable[[ir.Machine], str | None] = lambda _: None
    is_package: bool = False
