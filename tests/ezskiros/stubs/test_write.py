"""The content of stubs."""

from __future__ import annotations

import ast
import os
import subprocess
import sys
from pathlib import Path

import pytest

from ezskiros.ontology import Ontology, load
from ezskiros.ontology.symbols import Thing
from ezskiros.stubs import write_stub
from support.golden import assert_golden

HERE = Path(__file__).parent
ODD = HERE / "odd"
EXAMPLE = HERE.parents[2] / "examples" / "pick_place"


def test_the_stub_of_the_example(bless: bool) -> None:
    stub = write_stub(load(EXAMPLE / "ontology"))
    assert_golden(EXAMPLE / "skills" / "world.pyi", stub, bless=bless)


def test_the_stub_of_an_odd_ontology(bless: bool) -> None:
    assert_golden(HERE / "golden" / "odd.pyi.txt", write_stub(load(ODD)), bless=bless)


@pytest.fixture(scope="module")
def world() -> Ontology:
    return load(ODD)


@pytest.fixture(scope="module")
def stub(world: Ontology) -> dict[str, ast.ClassDef]:
    """The classes of the stub that stand for namespaces, by their names."""
    parsed = ast.parse(write_stub(world)).body
    found = {each.name: each for each in parsed if isinstance(each, ast.ClassDef)}
    return {name: each for name, each in found.items() if name in world.namespaces}


def test_it_has_the_names_that_the_namespaces_have(
    world: Ontology, stub: dict[str, ast.ClassDef]
) -> None:
    for name, namespace in world.namespaces.items():
        assert {_name(each) for each in stub[name].body} - {None} == set(dir(namespace))


def test_its_classes_have_the_bases_that_they_have(
    world: Ontology, stub: dict[str, ast.ClassDef]
) -> None:
    there: dict[str, object] = {"_Thing": Thing, "_lab": world.lab, "_shop": world.shop}
    there["_elsewhere"] = type("Elsewhere", (), {"Machine": world.shop.Stray.__bases__[0]})
    count = 0
    for name in world.namespaces:
        for each in stub[name].body:
            if isinstance(each, ast.ClassDef):
                bases = tuple(eval(ast.unparse(base), there) for base in each.bases)
                assert bases == getattr(getattr(world, name), each.name).__bases__
                count += 1
    assert count > 10


def _name(statement: ast.stmt) -> str | None:
    if isinstance(statement, (ast.ClassDef, ast.FunctionDef)):
        return statement.name
    target = statement.target if isinstance(statement, ast.AnnAssign) else None
    return target.id if isinstance(target, ast.Name) else None


def test_it_is_always_the_same() -> None:
    program = (
        "import sys; from ezskiros.ontology import load; from ezskiros.stubs import write_stub;"
        "sys.stdout.reconfigure(encoding='utf-8'); print(write_stub(load(*sys.argv[1:])), end='')"
    )
    files = [ODD / "lab.ttl", ODD / "shop.ttl"]
    printed = [
        subprocess.run(
            [sys.executable, "-c", program, *order],
            env={**os.environ, "PYTHONHASHSEED": seed},
            capture_output=True,
            encoding="utf-8",
            check=True,
        ).stdout
        for order, seed in ((files, "1"), (files, "2"), (files[::-1], "3"))
    ]
    assert printed == [write_stub(load(ODD))] * 3


def test_without_what_ezskiros_knows_of_relations_the_ontology_alone_counts() -> None:
    stub = write_stub(load(EXAMPLE / "ontology", relations=False))
    assert "    def at(self, other: _Thing, /) -> _Condition:" in stub


def test_a_namespace_called_world_is_the_one_that_is_meant(tmp_path: Path) -> None:
    (tmp_path / "world.ttl").write_text(
        "@prefix owl: <http://www.w3.org/2002/07/owl#> .\n"
        "<http://example.org/world.owl#Thing> a owl:Class .\n"
    )
    parsed = ast.parse(write_stub(load(tmp_path))).body
    named = [each for each in parsed if isinstance(each, ast.ClassDef) and each.name == "world"]
    assert [_name(statement) for each in named for statement in each.body] == ["Thing"]
