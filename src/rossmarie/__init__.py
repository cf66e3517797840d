"""ROSSMARie: safety rules for robots, checked before launch and monitored at run time.

`rossmarie.load("rules.ross")` returns a running `Monitor`. Its method `guard(...)` puts the monitor
between a policy and its robot. `docs/reference/python.md` shows how to use both.
"""

from __future__ import annotations

TYPE_CHECKING = False  # not from `typing`: Ctrl-C during that import prints a traceback
if TYPE_CHECKING:
    from rossmarie.driver.monitor import Monitor, load
    from rossmarie.driver.pipeline import RulesError
    from rossmarie.native import ColumnError

__all__ = ["ColumnError", "Monitor", "RulesError", "load"]


def __getattr__(name: str) -> object:
    """Import the compiler at the first access: every subpackage imports this package."""
    try:
        return _public(name)
    except ModuleNotFoundError as error:
        from rossmarie.extras import EXTRAS

        if advice := EXTRAS.explained(error):
            raise ImportError(f"rossmarie.{name}: {advice}") from error
        raise


def _public(name: str) -> object:
    if name in ("Monitor", "load"):
        from rossmarie.driver import monitor

        return getattr(monitor, name)
    if name == "RulesError":
        from rossmarie.driver import pipeline

        return pipeline.RulesError
    if name == "ColumnError":
        from rossmarie import native

        return native.ColumnError
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
