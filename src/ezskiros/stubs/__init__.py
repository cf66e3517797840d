"""Stubs (PEP 484) for type checkers: they find wrong relations while one writes."""

from ezskiros.stubs.write import write_stub

__all__ = ["write_stub"]
