"""Options and profiles of the whole test suite."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator

import pytest
from hypothesis import HealthCheck, settings

_SLOW_MACHINE = (HealthCheck.too_slow,)

settings.register_profile(
    "quick", max_examples=40, deadline=None, suppress_health_check=_SLOW_MACHINE
)
settings.register_profile(
    "ci",
    max_examples=150,
    deadline=None,
    derandomize=True,
    print_blob=True,
    suppress_health_check=_SLOW_MACHINE,
)
settings.register_profile(
    "thorough", max_examples=3000, deadline=None, suppress_health_check=_SLOW_MACHINE
)
settings.load_profile("ci" if os.environ.get("CI") else "quick")


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add our options. The profile of hypothesis is its own, `--hypothesis-profile`."""
    parser.addoption(
        "--bless",
        action="store_true",
        help="write the expectations and golden files from what the code does now; then look",
    )
    parser.addoption(
        "--soak",
        type=float,
        default=40.0,
        metavar="SECONDS",
        help="for how long a node runs in the test of endurance; 600 before a release",
    )


def pytest_configure(config: pytest.Config) -> None:
    """Refuse to bless where nobody looks."""
    if config.getoption("--bless") and os.environ.get("CI"):
        raise pytest.UsageError("--bless is for people; it is refused where CI is set")


@pytest.fixture
def bless(request: pytest.FixtureRequest) -> bool:
    """Whether expectations and golden files are to be written."""
    return bool(request.config.getoption("--bless"))


@pytest.fixture(autouse=True)
def same_environment() -> Iterator[None]:
    """What a test sets in the environment is not there for the next one."""
    before = dict(os.environ)
    yield
    if os.environ != before:
        os.environ.clear()
        os.environ.update(before)


@pytest.fixture(scope="session", autouse=True)
def interruptible() -> None:
    """What tests start can be interrupted, also if a shell runs the tests in the background."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
