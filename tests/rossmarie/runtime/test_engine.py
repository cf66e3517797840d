"""The part of the C that is the same for all rules: compiled by itself, and kept together."""

from __future__ import annotations

from pathlib import Path

import pytest

from rossmarie.targets.c99 import generate
from rossmarie.targets.c99.engine import files
from support.c99_cases import CASES
from support.c_compiler import STRICT, needs_c, run, write
from support.parts import SHA256SUM, needs

HERE = Path(__file__).parent / "engine"
SANITIZED = ("-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=undefined")


@needs_c
def test_it_works_with_tables_that_were_written_by_hand(tmp_path: Path) -> None:
    write(files(), tmp_path)
    program = tmp_path / "by_hand"
    folders = [f"-I{tmp_path}", f"-I{HERE}"]
    run(["gcc", "-std=c99", *STRICT, *SANITIZED, *folders, HERE / "by_hand.c", "-o", program])
    run([program])


@needs_c
def test_a_file_of_another_version_is_refused(tmp_path: Path) -> None:
    write(generate(CASES["reacting"]()), tmp_path)
    version = tmp_path / "engine" / "version.h"
    version.write_text("#define ROSSMARIE_ENGINE 0x00000001\n", encoding="utf-8")
    for part in ("monitor", "reactor"):
        with pytest.raises(AssertionError, match="generated for another version of engine"):
            run(["gcc", "-std=c99", "-fsyntax-only", tmp_path / f"reacting_{part}.c"])


@needs_c
@pytest.mark.parametrize("part", ["monitor", "reactor"])
def test_two_of_them_in_one_file_are_refused(part: str, tmp_path: Path) -> None:
    write(generate(CASES["reacting"]()), tmp_path)
    both = tmp_path / "both.c"
    both.write_text(f'#include "reacting_{part}.c"\n' * 2, encoding="utf-8")
    with pytest.raises(AssertionError, match=f"the engine of only one {part}"):
        run(["gcc", "-std=c99", "-fsyntax-only", both])


@needs(SHA256SUM)
def test_the_sums_tell_a_file_that_was_changed(tmp_path: Path) -> None:
    write(files(), tmp_path)
    folder = tmp_path / "engine"
    check = ["env", "-C", str(folder), "sha256sum", "--strict", "--quiet", "-c", "SHA256SUMS"]
    assert run(check).stdout == b""
    changed = folder / "limits.h"
    changed.write_text(changed.read_text(encoding="utf-8") + "\n", encoding="utf-8")
    with pytest.raises(AssertionError, match="1 computed checksum did NOT match"):
        run(check)


def test_no_rules_change_it() -> None:
    one, two = (
        {name: text for name, text in generate(CASES[case]()).items() if "/" in name}
        for case in ("arrays", "reacting")
    )
    assert one == two == files()
