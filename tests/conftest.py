"""Options and profiles of the whole test suite."""

from __future__ import annotations

import gc
import os
import signal
from collections.abc import Generator, Iterator

import pytest
from hypothesis import HealthCheck, settings

from support.lacking import Lacking
from support.order import arranged
from support.parts import PARTS, prover_programs

_SLOW_MACHINE = (HealthCheck.too_slow,)

settings.register_profile(
    "usual",
    max_examples=10,
    deadline=None,
    derandomize="CI" in os.environ,
    print_blob=True,
    suppress_health_check=_SLOW_MACHINE,
)
settings.register_profile(
    "deep", max_examples=250, deadline=None, suppress_health_check=_SLOW_MACHINE
)


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add our options."""
    parser.addoption(
        "--bless",
        action="store_true",
        help="write the expectations and golden files from what the code does now; then look",
    )
    parser.addoption(
        "--deep",
        action="store_true",
        help="run the tests marked `deep` as well, and try many examples of each property",
    )
    parser.addoption(
        "--soak",
        type=float,
        default=40.0,
        metavar="SECONDS",
        help="for how long a node runs in the test of endurance; 600 before a release",
    )
    parser.addoption(
        "--sanitize",
        action="store_true",
        help="build the nodes of live tests with AddressSanitizer and UndefinedBehaviorSanitizer",
    )


def pytest_configure(config: pytest.Config) -> None:
    """Choose how many examples are tried, and refuse to bless where nobody looks."""
    config.pluginmanager.register(Lacking(PARTS))
    config.addinivalue_line("markers", "deep: too slow for each run; `make deep` runs it")
    os.environ["PATH"] = os.pathsep.join([str(prover_programs()), os.environ["PATH"]])
    settings.load_profile("deep" if config.getoption("--deep") else "usual")
    if config.getoption("--bless") and os.environ.get("CI"):
        raise pytest.UsageError("--bless is for people; it is refused where CI is set")


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """Tests live until the end of the run: nobody looks for garbage among them, then or later."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.enable()
        gc.freeze()


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave deep tests to `make deep`, and put the others in the order in which they are run."""
    deep = [item for item in items if item.get_closest_marker("deep")]
    if deep and not config.getoption("--deep"):
        config.hook.pytest_deselected(items=deep)
        items[:] = [item for item in items if not item.get_closest_marker("deep")]
    items[:] = arranged(items)


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Print what tests have `reported`, in whichever process they ran."""
    for report in terminalreporter.getreports("passed"):
        for name, reported in report.user_properties:
            if name == "reported":
                terminalreporter.write_line(str(reported))


@pytest.fixture
def bless(request: pytest.FixtureRequest) -> bool:
    """True if expectations and golden files are to be written."""
    return bool(request.config.getoption("--bless"))


@pytest.fixture(autouse=True)
def same_environment() -> Iterator[None]:
    """Restore the environment after each test."""
    before = dict(os.environ)
    yield
    if os.environ != before:
        os.environ.clear()
        os.environ.update(before)


@pytest.fixture(scope="session", autouse=True)
def interruptible() -> None:
    """Make child processes interruptible, also if a shell runs the tests in the background."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
