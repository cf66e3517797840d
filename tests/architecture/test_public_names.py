"""Each package has an explicit door: what `__all__` lists, in order, and nothing that is absent."""

from __future__ import annotations

import importlib
import pkgutil
from importlib.util import find_spec

import pytest

import dslkit
import ezskiros
import heron
import rossmarie

# What cannot be imported where Python is too old for MuJoCo.
SIMULATION = {"heron.experiments", "heron.robot", "heron.scene"}
WITHOUT_MUJOCO = set() if find_spec("mujoco") else SIMULATION

PACKAGES = [
    module.name
    for package in (dslkit, ezskiros, heron, rossmarie)
    for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}.")
    if module.ispkg and module.name not in WITHOUT_MUJOCO
]


@pytest.mark.parametrize("name", PACKAGES)
def test_the_door_of_a_package_is_explicit(name: str) -> None:
    package = importlib.import_module(name)
    assert package.__doc__
    names = getattr(package, "__all__", [])
    assert sorted(names, key=_isort_key) == names
    for public in names:
        assert hasattr(package, public)


def _isort_key(name: str) -> tuple[int, str]:
    """Constants, then classes, then functions: the order that the linter keeps."""
    if name.isupper():
        return 0, name
    return (1 if name[0].isupper() else 2), name
