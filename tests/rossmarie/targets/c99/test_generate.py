"""What the C99 target writes: its looks, its warnings, its needs."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from rossmarie import ir
from rossmarie.targets.c99 import generate, generate_loadable
from support.c99_cases import CASES
from support.c_compiler import C_COMPILERS, CPP_COMPILERS, STRICT, needs_c, run, write
from support.golden import assert_golden

GOLDEN = Path(__file__).parents[3] / "golden" / "c99"


@pytest.mark.parametrize("case", sorted(CASES))
def test_looks_as_when_somebody_last_looked(case: str, bless: bool) -> None:
    for name, text in generate(CASES[case]()).items():
        assert_golden(GOLDEN / case / name, text, bless=bless)


@pytest.mark.parametrize("case", sorted(CASES))
def test_machines_of_the_golden_files_are_well_formed(case: str) -> None:
    ir.verify(CASES[case]())


def test_carries_the_place_and_the_words_of_the_user() -> None:
    source = generate(CASES["thresholds"]())["thresholds_monitor.c"]
    assert "drive.ross:1 drive.fast: speed > 0.5 m/s for 2.0 sec" in source
    assert "rules/" not in source


@needs_c
@pytest.mark.parametrize("case", sorted(CASES))
@pytest.mark.parametrize("compiler", C_COMPILERS)
def test_is_clean_as_c99(case: str, compiler: str, tmp_path: Path) -> None:
    write(generate_loadable(CASES[case]()), tmp_path)
    for source in (f"{case}_monitor.c", "host.c"):
        run([compiler, "-std=c99", *STRICT, "-c", tmp_path / source, "-o", tmp_path / "out.o"])


@pytest.mark.skipif(not CPP_COMPILERS, reason="there is no C++ compiler on this system")
@pytest.mark.parametrize("case", sorted(CASES))
@pytest.mark.parametrize("compiler", CPP_COMPILERS)
def test_is_clean_as_cpp17(case: str, compiler: str, tmp_path: Path) -> None:
    write(generate(CASES[case]()), tmp_path)
    source = tmp_path / f"{case}_monitor.c"
    command = [compiler, "-x", "c++", "-std=c++17", *STRICT, "-c", source]
    run([*command, "-o", tmp_path / "out.o"])


@needs_c
@pytest.mark.skipif(not shutil.which("nm"), reason="there is no nm on this system")
@pytest.mark.parametrize("case", sorted(CASES))
def test_needs_nothing_but_math(case: str, tmp_path: Path) -> None:
    write(generate(CASES[case]()), tmp_path)
    built = tmp_path / "monitor.o"
    options = ["-std=c99", "-O2", "-fno-builtin-memset"]
    run([C_COMPILERS[0], *options, "-c", tmp_path / f"{case}_monitor.c", "-o", built])
    needed = run(["nm", "--undefined-only", "--format=posix", built]).stdout.decode().split("\n")
    names = {line.split()[0] for line in needed if line} - {"_GLOBAL_OFFSET_TABLE_"}
    # Compilers call memset of their own accord, so a freestanding system has it as well.
    assert names <= {"asin", "atan2", "fabs", "sqrt", "memset"}


@needs_c
def test_names_of_users_cannot_break_the_code(tmp_path: Path) -> None:
    from dataclasses import replace

    machine = CASES["thresholds"]()
    nasty = 'int */ "?? \\ // /* while\nπ\u202e'
    truths = tuple(replace(truth, text=nasty, name=nasty) for truth in machine.truths)
    rules = tuple(replace(rule, name=nasty, contract=nasty) for rule in machine.rules)
    inputs = tuple(replace(used, name=nasty) for used in machine.inputs)
    channels = tuple(replace(channel, topic="/while/int") for channel in machine.channels)
    slots = tuple(replace(slot, path=("while",)) for slot in machine.slots)
    named = replace(
        machine, truths=truths, rules=rules, inputs=inputs, channels=channels, slots=slots
    )
    write(generate(named), tmp_path)
    source = tmp_path / "thresholds_monitor.c"
    run([C_COMPILERS[0], "-std=c99", *STRICT, "-c", source, "-o", tmp_path / "out.o"])
