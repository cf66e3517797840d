"""The output of the C99 target: its form, its warnings, its requirements."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

import pytest

from rossmarie import ir
from rossmarie.driver import compile_file
from rossmarie.ir.reactions import CancelGoal, RecoveryPlan
from rossmarie.targets.c99 import engine, generate, generate_loadable
from rossmarie.targets.c99.monitor import own_files
from support.c99_cases import CASES
from support.c_compiler import (
    C_COMPILERS,
    STRICT,
    each_c_compiler,
    each_cpp_compiler,
    needs_c,
    run,
    write,
)
from support.depth import is_deep
from support.drafts import Draft
from support.golden import assert_golden
from support.parts import NM, needs

MOBILE_BASE = Path(__file__).parents[4] / "examples" / "thesis" / "mobile_base.ross"
GOLDEN = Path(__file__).parents[3] / "golden" / "c99"


@pytest.mark.parametrize("case", sorted(CASES))
def test_looks_as_when_somebody_last_looked(case: str, bless: bool) -> None:
    files = own_files(CASES[case]())
    # Of rules that do something only the reactor: the others show what a monitor looks like.
    reactor = {name: text for name, text in files.items() if "_reactor." in name}
    for name, text in (reactor or files).items():
        unversioned = text.replace(engine.version(), "0x00000000")
        assert_golden(GOLDEN / case / name, unversioned, bless=bless)


@pytest.mark.parametrize("case", sorted(CASES))
def test_machines_of_the_golden_files_are_well_formed(case: str) -> None:
    ir.verify(CASES[case]())


def test_carries_the_place_and_the_words_of_the_user() -> None:
    source = generate(CASES["thresholds"]())["thresholds_monitor.c"]
    assert "drive.ross:1 drive.fast: speed > 0.5 m/s for 2.0 sec" in source
    assert "rules/" not in source


def sources_in(files: Mapping[str, str]) -> list[str]:
    return [name for name in files if name.endswith(".c")]


@pytest.mark.parametrize("case", sorted(CASES))
@each_c_compiler
def test_is_clean_as_c99(case: str, compiler: str, tmp_path: Path) -> None:
    files = {**generate(CASES[case]()), **generate_loadable(CASES[case]())}
    write(files, tmp_path)
    for source in sources_in(files):
        run([compiler, "-std=c99", *STRICT, "-c", tmp_path / source, "-o", tmp_path / "out.o"])


def one_comparison() -> ir.Machine:
    """The smallest machine: optimizers unroll its loops to the end of its arrays."""
    draft = Draft()
    draft.rule(draft.above(draft.read(), 1.0), draft.proposition(ir.Literal(True)))
    return draft.machine("single")


@pytest.mark.parametrize("case", [*CASES.values(), one_comparison])
@each_c_compiler
def test_is_clean_when_optimized(
    case: Callable[[], ir.Machine], compiler: str, tmp_path: Path
) -> None:
    files = generate(case())
    write(files, tmp_path)
    for source in sources_in(files):
        command = [compiler, "-std=c99", "-O3", *STRICT, "-c", str(tmp_path / source)]
        run([*command, "-o", tmp_path / "out.o"])


@pytest.mark.parametrize("case", sorted(CASES))
@each_cpp_compiler
def test_is_clean_as_cpp17(case: str, compiler: str, tmp_path: Path) -> None:
    files = generate(CASES[case]())
    write(files, tmp_path)
    for source in sources_in(files):
        command = [compiler, "-x", "c++", "-std=c++17", *STRICT, "-c", str(tmp_path / source)]
        run([*command, "-o", tmp_path / "out.o"])


@needs_c
@needs(NM)
@pytest.mark.parametrize("case", sorted(CASES))
def test_needs_nothing_but_math(case: str, tmp_path: Path) -> None:
    files = generate(CASES[case]())
    write(files, tmp_path)
    built = tmp_path / "built.o"
    options = ["-std=c99", "-O2", "-fno-builtin-memset"]
    # Compilers call memset of their own accord, so a freestanding system has it as well.
    known = {"fabs", "sqrt", "memset", f"{case}_is_active", f"{case}_watch"}
    for source in sources_in(files):
        run([C_COMPILERS[0], *options, "-c", tmp_path / source, "-o", built])
        needed = run(["nm", "--undefined-only", "--format=posix", built]).stdout.decode()
        names = {line.split()[0] for line in needed.split("\n") if line}
        assert names - {"_GLOBAL_OFFSET_TABLE_"} <= known


NASTY = 'int */ "?? \\ // /* while\nπ\u202e'


def renamed(machine: ir.Machine, name: str, path: str) -> ir.Machine:
    """The same machine, where everything has the same unfortunate name."""
    return replace(
        machine,
        propositions=tuple(
            replace(proposition, text=name, name=name) for proposition in machine.propositions
        ),
        rules=tuple(replace(rule, name=name, contract=name) for rule in machine.rules),
        inputs=tuple(replace(used, name=name) for used in machine.inputs),
        signals=tuple(replace(signal, text=name) for signal in machine.signals),
        channels=tuple(replace(channel, topic=f"/{path}") for channel in machine.channels),
        slots=tuple(replace(slot, path=(path,)) for slot in machine.slots),
        arrays=tuple(replace(array, path=(path,)) for array in machine.arrays),
        reactions=replace(
            machine.reactions,
            commands=tuple(replace(each, topic=name) for each in machine.reactions.commands),
            actions=tuple(replace(action, name=name) for action in machine.reactions.actions),
            resources=(name,) * len(machine.reactions.resources),
        ),
    )


def invented_functions() -> set[str]:
    """The names of all functions of the engine."""
    texts = engine.files().values()
    declared = re.compile(r"^(?:static|INLINE|RARE)[^=;{]*?(\w+)\(", re.MULTILINE)
    return {name for text in texts for name in declared.findall(text)}


@needs_c
@pytest.mark.parametrize("case", ["arrays", "memories", "reacting"])
def test_names_of_users_cannot_break_the_code(case: str, tmp_path: Path) -> None:
    fields = sorted(invented_functions() | {"while", "fabs", "sqrt", "isnan", "m", "value", "i"})
    assert "cross" in fields
    fields = fields if is_deep() else [*fields[::5], "cross", "value", "while"]
    sources = []
    for number, field in enumerate(fields):
        machine = replace(renamed(CASES[case](), NASTY, field), name=f"{case}_{number}")
        files = generate(machine)
        write(files, tmp_path)
        headers = [header for header in own_files(machine) if header.endswith(".h")]
        sources += [f'#include "{header}"\n' for header in headers]
    (tmp_path / "headers.c").write_text("".join(sources), encoding="utf-8")
    quick = ["-std=c99", "-fsyntax-only", *STRICT]
    run([C_COMPILERS[0], *quick, *sorted(tmp_path.glob("*.c"))])


def test_texts_are_reported_to_whoever_gives_them() -> None:
    header = generate(CASES["memories"]())["memories_monitor.h"]
    assert "extern const char *const memories_texts[1];" in header
    assert "_texts[" not in generate(CASES["arrays"]())["arrays_monitor.h"]


def test_there_is_a_reactor_only_if_there_are_tasks() -> None:
    assert sorted(own_files(CASES["thresholds"]())) == [
        "thresholds_monitor.c",
        "thresholds_monitor.h",
    ]
    assert sorted(own_files(CASES["reacting"]()))[2:] == [
        "reacting_reactor.c",
        "reacting_reactor.h",
    ]


def test_a_reactor_carries_the_place_and_the_words_of_the_user() -> None:
    source = generate(CASES["reacting"]())["reacting_reactor.c"]
    assert "actions.ross:3 act: scale /cmd_vel by 50 %" in source
    assert "rules/" not in source


def test_a_reactor_has_only_what_it_needs() -> None:
    machine = CASES["reacting"]()
    found = machine.reactions
    cancel = found.tasks[3].effect
    assert isinstance(cancel, CancelGoal)
    cancel = replace(cancel, confirmation=None)
    tasks = (replace(found.tasks[3], effect=cancel, otherwise=()),)
    plain = replace(
        found, commands=(), tasks=tasks, plans=(RecoveryPlan(((0,),), (0,)), RecoveryPlan((), ()))
    )
    files = own_files(replace(machine, reactions=plain, watches=()))
    assert "math.h>" not in files["reacting_reactor.c"]
    assert not re.search("_bounds|_watch", "".join(files.values()))


def test_rules_of_the_thesis_are_short() -> None:
    """As decision 45 says."""
    files = own_files(compile_file(MOBILE_BASE).machine)
    assert files["mobile_base_monitor.c"].count("\n") <= 300
    assert files["mobile_base_reactor.c"].count("\n") <= 75
