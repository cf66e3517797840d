"""ROSS5xx: what a target cannot do."""

from __future__ import annotations

from dataclasses import dataclass

from dslkit.diagnostics import Error, Template


@dataclass(frozen=True, kw_only=True)
class MonitorTooLarge(Error, code="ROSS501", name="monitor-too-large"):
    """More conditions, rules and limits than the indexes of the generated code can tell apart."""

    title = "these rules are too large for one {target} monitor"
    label = "with this rule there are {found} {what}; a monitor holds up to {most}"
    note = "the tables of a monitor are indexed by 16 bits, so that they stay small"
    help = "split the rules over several files: each becomes a monitor of its own"
    target: str
    what: str
    found: int
    most: int


ALL: tuple[type[Template], ...] = (MonitorTooLarge,)
