"""The files that a build writes, and the files that it keeps."""

from __future__ import annotations

from pathlib import Path

from rossmarie.driver.build import build_files
from support.live_cases import rules as rules_of_vehicle


def test_a_second_build_changes_nothing(tmp_path: Path) -> None:
    rules, folder = tmp_path / "vehicle.ross", tmp_path / "package"
    rules.write_text(rules_of_vehicle(), encoding="utf-8")
    build_files(rules, "ros1", folder)
    before = {path: path.stat().st_mtime_ns for path in folder.rglob("*")}
    build_files(rules, "ros1", folder)
    assert {path: path.stat().st_mtime_ns for path in folder.rglob("*")} == before


def test_files_of_the_user_are_written_once(tmp_path: Path) -> None:
    rules, folder = tmp_path / "vehicle.ross", tmp_path / "package"
    rules.write_text(rules_of_vehicle(), encoding="utf-8")
    written = build_files(rules, "ros1", folder).written
    hooks = folder / "src" / "hooks.cpp"
    assert hooks in written
    hooks.write_text("// mine\n", encoding="utf-8")
    written = build_files(rules, "ros1", folder).written
    assert hooks not in written
    assert hooks.read_text(encoding="utf-8") == "// mine\n"
