"""The extras of the distribution `heron-robot`."""

from __future__ import annotations

from dslkit.extras import Extras

EXTRAS = Extras(
    "heron-robot",
    {
        "gym": ("gymnasium",),
        "learning": ("cmaes", "flax", "jax", "msgpack", "skrl"),
        "ray": ("ray",),
    },
)
