"""Each package has an explicit door: what `__all__` lists, in order, and nothing that is absent."""

from __future__ import annotations

import importlib
import pkgutil

import pytest

import dslkit
import ezskiros
import heron
import rossmarie
from support.parts import MUJOCO, needs

# What imports MuJoCo.
SIMULATION = {
    *("heron.demo", "heron.evaluation", "heron.experiments"),
    *("heron.operation", "heron.robot", "heron.ros1", "heron.scene"),
}

PACKAGES = [
    pytest.param(module.name, marks=[needs(MUJOCO)] if module.name in SIMULATION else [])
    for package in (dslkit, ezskiros, heron, rossmarie)
    for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}.")
    if module.ispkg
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
