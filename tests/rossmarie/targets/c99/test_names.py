"""Public names of a monitor differ from those that it has inside, whatever its file is called."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest

from rossmarie.naming import public_prefix
from rossmarie.targets import c99
from rossmarie.targets.c99 import engine, generate_loadable
from support.c99_cases import CASES
from support.c_compiler import C_COMPILERS, STRICT, needs_c, run, write

_IGNORED = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\])*"', re.DOTALL)
_NAME = re.compile(r"(?<!\w)[A-Za-z]\w*")
_BLANK = re.compile(r"\w*\{\{.*?\}\}\w*")
_PUBLIC = re.compile(r"NAMED\(\w+\)")
_OWN = "zzz"
TEMPLATES = Path(c99.__file__).with_name("templates")


def generated(case: str) -> str:
    """The monitor and what loads it."""
    return "\n".join(generate_loadable(replace(CASES[case](), name=_OWN)).values())


def templates() -> str:
    files = sorted(TEMPLATES.glob("*.j2"))
    texts = [path.read_text(encoding="utf-8") for path in files]
    return "\n".join(_BLANK.sub("", text) for text in [*texts, *engine.files().values()])


def private_names(text: str) -> set[str]:
    found = _NAME.findall(_PUBLIC.sub("", _IGNORED.sub("", text)))
    return {name for name in found if "_" in name and not name.lower().startswith(_OWN)}


@pytest.mark.parametrize(
    "text", [templates(), *map(generated, sorted(CASES))], ids=["templates", *sorted(CASES)]
)
def test_no_file_can_be_called_like_the_beginning_of_a_private_name(text: str) -> None:
    beginnings = {name.split("_")[0].lower() for name in private_names(text)}
    assert beginnings
    missing = {word for word in beginnings if public_prefix(word) == word}
    assert not missing, f"add to naming.identifiers._PRIVATE: {sorted(missing)}"


@needs_c
@pytest.mark.parametrize("name", ["rule", "input", "host", "value", "guard", "text"])
def test_compiles_whatever_its_file_is_called(name: str, tmp_path: Path) -> None:
    machine = replace(CASES["timeouts"](), name=name)
    write(generate_loadable(machine), tmp_path)
    run([C_COMPILERS[0], "-std=c99", *STRICT, "-c", tmp_path / "host.c", "-o", tmp_path / "out.o"])
