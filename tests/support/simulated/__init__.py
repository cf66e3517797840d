"""Robots in the box as simulations, which write the recordings in the folders of these robots."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module

from rosbags.typesys.store import Typestore

from support.simulated.recording import Reading, Sensor, readings

Simulation = tuple[Typestore, Iterator[Reading]]


def simulated(name: str) -> Simulation:
    """The messages of a robot, by the module of its name, and their types."""
    module = import_module(f"{__name__}.{name}")
    store: Typestore = module.STORE
    sensors: list[Sensor] = module.sensors()
    return store, readings(store, sensors)
