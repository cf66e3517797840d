"""Extras of the distributions of this project: the modules of each, and the advice to install it.

Every message that advises `pip install` of one of these distributions comes from here.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.util import find_spec


@dataclass(frozen=True)
class Extras:
    """The extras of a distribution: `modules` has the top-level modules of each, by its name."""

    distribution: str
    modules: Mapping[str, Sequence[str]]

    def advice(self, *extras: str) -> str:
        """The command that installs extras, or the distribution alone: `pip install 'a[b]'`."""
        unknown = set(extras) - set(self.modules)
        if unknown:
            raise LookupError(f"{self.distribution} has no extra {', '.join(sorted(unknown))}")
        brackets = f"[{','.join(extras)}]" if extras else ""
        return f"pip install '{self.distribution}{brackets}'"

    def missing(self, extra: str) -> list[str]:
        """The modules of an extra that are not installed."""
        return [name for name in self.modules[extra] if not _is_installed(name)]

    def explained(self, error: ModuleNotFoundError) -> str | None:
        """A message for a user whose environment does not have a module; None if no extra contains
        the module.
        """
        name = (error.name or "").partition(".")[0]
        extra = next((each for each, modules in self.modules.items() if name in modules), None)
        if extra is None:
            return None
        return f"this needs {name}, which is not installed: {self.advice(extra)}"


def _is_installed(name: str) -> bool:
    try:
        return find_spec(name) is not None
    except ValueError:  # a module without a specification, such as a stand-in of a test
        return True
