"""The extras of the distribution `rossmarie`."""

from __future__ import annotations

from dslkit.extras import Extras

EXTRAS = Extras(
    "rossmarie",
    {
        "run": ("apsw", "cffi", "lz4", "numpy", "rosbags"),
        "solver": ("z3",),
        "prover": ("bitwuzla",),
        "gym": ("gymnasium",),
        "skills": ("crosscheck",),
    },
)
