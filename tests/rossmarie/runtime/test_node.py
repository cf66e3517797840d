"""The part of the node that is the same for all rules, without ROS: stand-ins take its place."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from typing import TypeAlias

import pytest

import rossmarie
from rossmarie.driver import compile_file
from rossmarie.driver.build import build_files, generate
from rossmarie.driver.ownership import ForeignFileError
from support.c_compiler import run, write
from support.depth import is_deep
from support.live_cases import acting, vehicle
from support.parts import CLANG_FORMAT, CLANG_FORMAT_PROGRAM, GXX, SHA256SUM, needs

HERE = Path(__file__).parent
RUNTIME = Path(rossmarie.__file__).parent / "runtime" / "ros"
GENERATIONS = ("ros1", "ros2")
SANITIZED = ("-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=undefined")
STRICT = ("-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow=local", "-Werror")
NODE = ("runtime/guard.cpp", "runtime/operators.cpp", "runtime/reporting.cpp",
        "runtime/settings.cpp", "src/rules.cpp")  # fmt: skip
SOURCES = {
    "clock": (),
    "guard": NODE,
    "latched_rules": (),
    "messages": (),
    "settings": ("runtime/settings.cpp",),
    "start": NODE,
}
"""The files of a package that each program tests, besides headers."""


def sanitized() -> Sequence[str]:
    """The options of sanitizers, where there is time for them."""
    return SANITIZED if is_deep() else ()


Package: TypeAlias = Callable[[Path], Path]
"""A package of rules, with its C compiled. Its messages, and ROS, are the stand-ins."""


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Package:
    """Makes a package of rules; the tests share it."""

    @cache
    def made(rules: Path) -> Path:
        folder = tmp_path_factory.mktemp("alarm_safety")
        write(generate(compile_file(rules).machine, "ros1"), folder)
        sources = [folder / "src" / f"alarm_{part}.c" for part in ("monitor", "reactor")]
        for source in sources:
            options = ["-std=c99", "-ffp-contract=off", *sanitized()]
            run(["gcc", *options, "-c", source, "-o", source.with_suffix(".o")])
        return folder

    return made


@needs(GXX)
@pytest.mark.parametrize("name", SOURCES)
def test_a_program_of_checks_passes(
    name: str, package: Package, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All files are compiled as one, which takes a third of the time; with sanitizers only by
    `make deep`.
    """
    own = HERE / name / "alarm.ross"
    folder = package(own if own.exists() else HERE / "alarm.ross")
    texts = [HERE / "programs" / f"{name}.cpp", *(folder / each for each in SOURCES[name])]
    whole = folder / f"all_of_{name}.cpp"
    whole.write_text("".join(f'#include "{each}"\n' for each in texts), encoding="utf-8")
    is_node = SOURCES[name] == NODE
    rules = folder / "src" if is_node else HERE / "few_rules"
    folders = [HERE / "programs", HERE / "stand_ins", rules, folder]
    folders += [folder / "runtime", folder / "runtime" / "ros1"]
    includes = [f"-I{each}" for each in folders]
    objects = sorted((folder / "src").glob("*.o")) if is_node else []
    program = folder / name
    run(["g++", *STRICT, *sanitized(), *includes, whole, *objects, "-lm", "-o", program])
    monkeypatch.setenv("ROS_HOME", str(tmp_path))  # for the files of latched rules
    run([program])


def test_a_package_has_the_files_unchanged(generation: str) -> None:
    files = generate(vehicle(generation), generation)
    copies = {name: text for name, text in files.items() if name.startswith("runtime/")}
    other = "ros2" if generation == "ros1" else "ros1"
    expected = {
        f"runtime/{path.relative_to(RUNTIME)}": path.read_text(encoding="utf-8")
        for path in RUNTIME.rglob("*")
        if path.is_file() and path.parent != RUNTIME / other
    }
    sums = copies.pop("runtime/SHA256SUMS")
    assert copies == expected
    assert sums.count("\n") == len(expected) + 1


def test_the_files_are_the_same_for_all_rules(generation: str) -> None:
    one, two = (
        {name: text for name, text in files.items() if name.startswith("runtime/")}
        for files in (
            generate(vehicle(generation), generation),
            generate(acting('log info "x"'), generation),
        )
    )
    assert one == two


@needs(SHA256SUM)
def test_the_sums_tell_a_file_that_was_changed(generation: str, tmp_path: Path) -> None:
    write(generate(vehicle(generation), generation), tmp_path)
    folder = tmp_path / "runtime"
    check = ["env", "-C", str(folder), "sha256sum", "--strict", "--quiet", "-c", "SHA256SUMS"]
    assert run(check).stdout == b""
    changed = folder / generation / "parameters.h"
    changed.write_text(changed.read_text(encoding="utf-8") + "\n", encoding="utf-8")
    with pytest.raises(AssertionError, match="1 computed checksum did NOT match"):
        run(check)


def test_a_build_writes_a_copy_again_that_was_changed_and_no_file_of_somebody_else(
    tmp_path: Path,
) -> None:
    rules = Path(shutil.copy(HERE / "alarm.ross", tmp_path))
    package = tmp_path / "package"
    build_files(rules, "ros1", package)
    copy = package / "runtime" / "clock.h"
    text = copy.read_text(encoding="utf-8")
    copy.write_text(text.replace("LEAP_NS = 1", "LEAP_NS = 9"), encoding="utf-8")
    build_files(rules, "ros1", package)
    assert copy.read_text(encoding="utf-8") == text
    copy.write_text("// mine\n", encoding="utf-8")
    with pytest.raises(ForeignFileError, match=r"clock\.h is there, and was not generated"):
        build_files(rules, "ros1", package)


def test_the_settings_file_has_all_parameters_with_their_usual_values(generation: str) -> None:
    table = (RUNTIME / "settings.cpp").read_text(encoding="utf-8")
    numbers = re.findall(r'\{"(\w+)", ParameterText::NUMBER, ([\d.]+),', table)
    texts = re.findall(r'\{"(\w+)", ParameterText::TEXTS?,', table)
    yaml = generate(vehicle(generation), generation)["config/parameters.yaml"]
    assert dict(re.findall(r"^ *(\w+): ([\d.]+)$", yaml, re.MULTILINE)) == dict(numbers)
    given = re.findall(r"^ *# (\w+): \S", yaml, re.MULTILINE)
    assert given == [*texts, "heaviest"], "the rules of the vehicle have a parameter of their own"


@needs(CLANG_FORMAT)
def test_the_files_are_formatted() -> None:
    files = [
        *RUNTIME.parent.rglob("*.h"),
        *RUNTIME.parent.rglob("*.cpp"),
        *HERE.rglob("*.h"),
        *HERE.rglob("*.cpp"),
        *HERE.rglob("*.c"),
    ]
    run([CLANG_FORMAT_PROGRAM, "--dry-run", "-Werror", *files])


@pytest.fixture(params=GENERATIONS)
def generation(request: pytest.FixtureRequest) -> str:
    """Each generation."""
    return str(request.param)
