"""Reasons for expectations that came out otherwise, by formulation, algorithm and expectation."""

from __future__ import annotations

from collections.abc import Mapping

REASONS: Mapping[tuple[str, str, str], str] = {}
