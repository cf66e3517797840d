"""Conditions that last and rules that clear. Do not change this file."""

from __future__ import annotations


class Lasting:
    """True when a condition has been true for some seconds."""

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds
        self._since: float | None = None

    def update(self, now: float, condition: bool) -> bool:
        if not condition:
            self._since = None
            return False
        if self._since is None:
            self._since = now
        return now - self._since >= self._seconds


class Rule:
    """Active from its condition on, until the condition has been false for some seconds."""

    def __init__(self, clear_seconds: float) -> None:
        self._clear = Lasting(clear_seconds)
        self._is_active = False

    def update(self, now: float, condition: bool) -> bool:
        if condition:
            self._is_active = True
        if self._clear.update(now, not condition):
            self._is_active = False
        return self._is_active
