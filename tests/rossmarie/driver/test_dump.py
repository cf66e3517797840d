"""The data of the compiler after each stage."""

from __future__ import annotations

from pathlib import Path

import pytest

from rossmarie.driver.dump import CompilerStage, dump
from rossmarie.driver.workspace import load_modules


@pytest.mark.parametrize("stage", CompilerStage)
def test_every_stage_reads_the_rules_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, stage: CompilerStage
) -> None:
    rules = tmp_path / "rules.ross"
    rules.write_text("action stop;\n")
    read: list[object] = []

    def counting(*arguments: object) -> object:
        read.append(arguments)
        return load_modules(*arguments)  # type: ignore[arg-type]

    monkeypatch.setattr("rossmarie.driver.pipeline.load_modules", counting)
    dump(rules, stage)
    assert len(read) == 1
