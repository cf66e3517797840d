"""Translation of SkiROS2's `State` to the EzSkiROS state."""

from __future__ import annotations

from collections.abc import Collection

import libcst as cst

from ezskiros.migrate.imports import bound_names, has_star, imported, used_names

_STATE = "State"
MEMBERS = {"Success": "SUCCESS", "Failure": "FAILURE", "Running": "RUNNING"}
"""The states that a skill can report, with their SkiROS2 and EzSkiROS names."""
PLACEHOLDER = "_state_of_ezskiros"
"""A placeholder for EzSkiROS's `State` until the free names are known."""


def states_in(module: cst.Module) -> frozenset[str]:
    """The names that a module has for SkiROS2's `State`."""
    found = {name for name, what in imported(module, "skiros2").items() if what == _STATE}
    is_any = has_star(module, "skiros2") and _STATE not in bound_names(module, ())
    return frozenset(found | ({_STATE} if is_any else set()))


def with_states(module: cst.Module, states: Collection[str]) -> tuple[cst.Module, str]:
    """The module with a name for EzSkiROS's `State`, and that name; empty if it is not used."""
    used = used_names(module)
    if PLACEHOLDER not in used:
        return module, ""
    # A name that only unused SkiROS2 imports bound is free again.
    taken = used | (bound_names(module, ()) - {*states})
    name = _STATE
    while name in taken:
        name += "_"
    found = module.visit(_Renamed(name))
    assert isinstance(found, cst.Module)
    return found, name


class _Renamed(cst.CSTTransformer):
    def __init__(self, name: str) -> None:
        self._name = name

    def leave_Name(  # noqa: N802
        self, original_node: cst.Name, updated_node: cst.Name
    ) -> cst.Name:
        is_one = original_node.value == PLACEHOLDER
        return updated_node.with_changes(value=self._name) if is_one else updated_node
