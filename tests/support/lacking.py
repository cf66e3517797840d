"""A plugin of pytest that tells which parts of the suite do not run on this machine, and why."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest

from support.parts import Part, require

_DEEP = "deep tests left"


class Lacking:
    """Skips tests whose part is missing. Tells at the start of a run which parts are, and at its
    end how many tests were skipped for each reason, and how the machine gets the part.
    """

    def __init__(self, parts: Sequence[Part]) -> None:
        self._parts = parts
        self._deep = 0

    def pytest_configure(self, config: pytest.Config) -> None:
        """Declare the mark."""
        config.addinivalue_line("markers", "needs(part): skipped where the part is missing")

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_setup(self, item: pytest.Item) -> None:
        """Skip a test before its fixtures are set up."""
        for mark in item.iter_markers("needs"):
            require(mark.args[0])

    def pytest_sessionstart(self, session: pytest.Session) -> None:
        """Tell what is missing; whoever runs a single file wants no such list."""
        terminal = _terminal(session.config)
        if terminal is not None and all(Path(name).is_dir() for name in session.config.args):
            missing = [part for part in self._parts if part.missing is not None]
            for part in missing:
                terminal.write_line(f"skipped: {part}")
            if not missing:
                terminal.write_line("skipped: nothing, no part is missing")

    def pytest_deselected(self, items: Sequence[pytest.Item]) -> None:
        """Count the deep tests that are left out."""
        left = [item for item in items if item.get_closest_marker("deep")]
        if left and not left[0].config.getoption("--deep"):
            self._deep += len(left)

    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        """Hand the count over, where this is a worker of pytest-xdist."""
        if hasattr(session.config, "workeroutput"):
            session.config.workeroutput[_DEEP] = self._deep

    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodedown(self, node: Any) -> None:
        """Take the count over; each worker has collected all tests."""
        self._deep = max(self._deep, getattr(node, "workeroutput", {}).get(_DEEP, 0))

    @pytest.hookimpl(trylast=True)
    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        """Tell what has been skipped, and what is left to `make deep`."""
        if terminalreporter.config.option.collectonly:
            return
        lines = list(self._skipped(terminalreporter.getreports("skipped")))
        terminalreporter.write_line(
            "not run on this machine:" if lines else "no test was skipped on this machine"
        )
        for line in lines:
            terminalreporter.write_line(f"  {line}")
        if self._deep:
            terminalreporter.write_line(f"{_many(self._deep, 'deep test')} left to `make deep`")

    def _skipped(self, reports: Sequence[Any]) -> Iterator[str]:
        """A line for each reason, in the order of the parts; other reasons come last."""
        counts: dict[str, Counter[str]] = {}
        for report in reports:
            reason = str(report.longrepr[2]).removeprefix("Skipped: ")
            kind = "test" if isinstance(report, pytest.TestReport) else "file"
            counts.setdefault(reason, Counter())[kind] += 1
        for part in self._parts:
            for reason in [reason for reason in counts if reason.startswith(f"{part.name} (")]:
                yield f"{_counted(counts.pop(reason))}: {reason}. To have it: {part.remedy}"
        for reason, count in counts.items():
            yield f"{_counted(count)}: {reason}"


def _terminal(config: pytest.Config) -> pytest.TerminalReporter | None:
    """The reporter for messages; None in a worker of pytest-xdist, and if tests are only listed."""
    if config.option.collectonly:
        return None
    found: pytest.TerminalReporter | None = config.pluginmanager.get_plugin("terminalreporter")
    return found


def _counted(count: Counter[str]) -> str:
    """As `3 tests and 1 file`."""
    return " and ".join(_many(count[kind], kind) for kind in ("test", "file") if count[kind])


def _many(number: int, noun: str) -> str:
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"
