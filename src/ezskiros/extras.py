"""The extras of the distribution `ezskiros`."""

from __future__ import annotations

from dslkit.extras import Extras

EXTRAS = Extras(
    "ezskiros",
    {
        "edit": ("libcst",),
        "locations": ("numpy", "shapely"),
        "plan": ("up_fast_downward",),
        "rules": ("crosscheck",),
    },
)
