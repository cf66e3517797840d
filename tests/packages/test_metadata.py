"""The projects of `packages/` agree with each other, the sources, and advice for users."""

from __future__ import annotations

import re
from collections.abc import Iterator
from importlib import import_module
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from dslkit.extras import Extras
from support.packages import ROOT, Project, closure, projects

WITH_EXTRAS = {"rossmarie": "rossmarie", "ezskiros": "ezskiros", "heron": "heron-robot"}
"""The packages that have a module `extras`, and the distributions that it is about."""
ADVICE = re.compile(r"pip install +[\\'\"`]*([A-Za-z][\w-]*)(?:\\?\[([\w,]+)\\?\])?")
CALL = re.compile(r"(?:\.advice|output\.require)\(([^()]*)\)")
TEXTS = [
    path
    for folder in ("src", "docs", "packages", "README.md", "CONTRIBUTING.md")
    for path in sorted([(ROOT / folder), *(ROOT / folder).rglob("*")])
    if path.suffix in (".py", ".md", ".j2", ".toml")
    and path.is_file()
    and "decisions" not in path.parts
]


def extras_of(package: str) -> Extras:
    found = import_module(f"{package}.extras").EXTRAS
    assert isinstance(found, Extras)
    return found


def advice() -> Iterator[tuple[Path, str, str]]:
    """The advised distributions of ours, each with an extra, or with an empty text."""
    for path in TEXTS:
        for name, extras in ADVICE.findall(path.read_text(encoding="utf-8")):
            if canonicalize_name(name) in projects():
                yield from ((path, name, extra) for extra in extras.split(","))


def test_each_package_of_the_sources_is_in_one_project() -> None:
    modules = sorted(each.module for each in projects().values())
    assert modules == sorted(path.parent.name for path in ROOT.glob("src/*/__init__.py"))


@pytest.mark.parametrize("project", projects().values(), ids=lambda each: each.name)
def test_a_project_says_what_a_user_looks_for(project: Project) -> None:
    table, source = project.table, ROOT / "src" / project.module
    assert {"Homepage", "Documentation", "Issues", "Changelog"} <= table["urls"].keys()
    home = table["urls"]["Homepage"]
    assert all(url.startswith(home) for url in table["urls"].values())
    assert "Typing :: Typed" in table["classifiers"]
    assert (source / "py.typed").is_file()
    assert (source / "__main__.py").is_file() == bool(table.get("scripts"))
    assert [(project.folder / name).resolve() for name in table["license-files"]] == [
        ROOT / "LICENSE",
        ROOT / "NOTICE",
    ]


@pytest.mark.parametrize("project", projects().values(), ids=lambda each: each.name)
def test_links_of_a_readme_are_absolute_and_lead_to_files(project: Project) -> None:
    text = (project.folder / "README.md").read_text(encoding="utf-8")
    home = project.table["urls"]["Homepage"]
    for link in re.findall(r"\]\(([^)]+)\)", text):
        assert link.startswith("https://"), link
        found = re.fullmatch(rf"{home}/(.+)", link)
        assert found is None or (ROOT / found[1]).exists(), link


def test_versions_are_the_same_and_pinned() -> None:
    versions = {each.table["version"] for each in projects().values()}
    assert len(versions) == 1
    for project in projects().values():
        ours = [each for each in project.requirements if each.name in projects()]
        for each in ours:
            known = projects()[each.name].extras
            assert set(each.extras) <= set(known), f"{project.name}: {each}"
            is_itself = each.name == project.name
            assert str(each.specifier) == ("" if is_itself else f"=={versions.copy().pop()}")


def test_the_extra_all_has_all() -> None:
    for project in projects().values():
        if project.extras.keys() - {"ray"}:
            (required,) = map(Requirement, project.extras["all"])
            assert required.name == project.name
            assert {*required.extras, "all"} == set(project.extras)


@pytest.mark.parametrize("package", WITH_EXTRAS)
def test_an_extra_brings_the_modules_that_its_table_names(package: str) -> None:
    owners, project = packages_distributions(), projects()[WITH_EXTRAS[package]]
    extras = extras_of(package)
    assert extras.distribution == project.name
    assert set(extras.modules) == set(project.extras) - {"all"}
    for extra, modules in extras.modules.items():
        if extra == "ray":  # not installed for development
            continue
        brought = closure(f"{project.name}[{extra}]") - closure(project.name)
        for module in modules:
            known = {canonicalize_name(each) for each in owners.get(module, ())}
            # Where Python is too old for a package, its marker leaves it out.
            assert known & brought or module not in owners, f"{project.name}[{extra}]: {module}"


def test_advice_in_texts_is_true() -> None:
    found = list(advice())
    assert {name for _, name, _ in found} >= {"rossmarie", "ezskiros", "heron-robot"}
    wrong = [each for each in found if each[2] and each[2] not in projects()[each[1]].extras]
    assert wrong == []


def test_advice_in_code_comes_from_one_place() -> None:
    texts = {path for path, _, _ in advice() if path.suffix == ".py"}
    assert texts == set(), "write EXTRAS.advice(...), which knows the extras"


@pytest.mark.parametrize("package", WITH_EXTRAS)
def test_extras_that_code_names_exist(package: str) -> None:
    known = projects()[WITH_EXTRAS[package]].extras
    sources = (ROOT / "src" / package).rglob("*.py")
    calls = [call for path in sources for call in CALL.findall(path.read_text(encoding="utf-8"))]
    assert calls
    named = {name for call in calls for name in re.findall(r"['\"](\w+)['\"]", call)}
    assert named <= set(known)


def test_an_extra_that_does_not_exist_is_not_advised() -> None:
    with pytest.raises(LookupError, match="rossmarie has no extra fast"):
        extras_of("rossmarie").advice("fast")


def test_the_example_of_rules_and_skills_has_the_ontology_of_the_other() -> None:
    pick_place, whiteboard = (
        ROOT / "examples" / name / "ontology" for name in ("pick_place", "whiteboard")
    )
    for path in pick_place.iterdir():
        assert (whiteboard / path.name).read_bytes() == path.read_bytes()
