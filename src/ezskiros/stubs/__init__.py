"""Stubs (PEP 484) for type checkers, which find wrong relations while the user types."""

from ezskiros.stubs.write import write_stub

__all__ = ["write_stub"]
