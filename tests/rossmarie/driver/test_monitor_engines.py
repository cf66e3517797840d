"""The engine that runs a rules file, and the message if it is not the native engine."""

from __future__ import annotations

import warnings
from pathlib import Path

import pytest

import rossmarie
from rossmarie import Monitor
from support.c_compiler import needs_c

RULES = """
action slow;
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 1 sec
rule fast: if speed > 1 m/s then { slow; };
"""


@pytest.fixture
def rules(tmp_path: Path) -> Path:
    path = tmp_path / "rules.ross"
    path.write_text(RULES)
    return path


def warned(rules: Path) -> tuple[Monitor, str]:
    """The monitor, and the one warning that came with it."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        monitor = rossmarie.load(rules)
    (warning,) = caught
    assert warning.category is RuntimeWarning
    assert warning.filename == __file__, "it points to who loads"
    assert str(warning.message) == monitor.reason
    return monitor, str(warning.message)


def test_without_a_compiler_the_reason_is_reported_once(
    rules: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("CC", "no-such-compiler")
    monitor, reason = warned(rules)
    assert monitor.kind == "python"
    assert "no C compiler found (looked for no-such-compiler)" in reason


def test_a_compiler_that_is_no_command(rules: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CC", 'gcc "')
    monitor, reason = warned(rules)
    assert monitor.kind == "python"
    assert "No closing quotation" in reason


@needs_c
def test_with_a_compiler_nothing_is_reported(rules: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        monitor = rossmarie.load(rules)
    assert (monitor.kind, monitor.reason) == ("native", None)


def test_of_a_compiler_that_fails_the_first_line_is_reported(
    rules: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    script = tmp_path / "failing-cc"
    script.write_text("#!/bin/sh\necho 'out of order\nand more' >&2\nexit 1\n")
    script.chmod(0o755)
    monkeypatch.setenv("CC", str(script))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    _, reason = warned(rules)
    assert reason.endswith(": out of order")


@needs_c
def test_without_a_place_to_keep_it_the_monitor_is_native(
    rules: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("no folder")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    assert rossmarie.load(rules).kind == "native"
