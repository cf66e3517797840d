"""Lists of names in sentences."""

from __future__ import annotations

from collections.abc import Sequence

_MOST = 12


def listed(names: Sequence[str]) -> str:
    """`a`, `b` and `c`; long lists are cut."""
    quoted = [f"`{name}`" for name in names[:_MOST]]
    if len(names) > _MOST:
        return f"{', '.join(quoted)} and {len(names) - _MOST} more"
    if len(quoted) < 2:
        return "".join(quoted)
    return f"{', '.join(quoted[:-1])} and {quoted[-1]}"
