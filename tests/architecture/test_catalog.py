"""Every diagnostic is in the catalog, has a code of its own, valid texts and a page."""

from __future__ import annotations

import importlib
import inspect
import pkgutil
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Set
from dataclasses import dataclass
from importlib.resources import files

import pytest

import crosscheck.catalog
import ezskiros.catalog
import rossmarie.catalog
from dslkit.catalog import Catalog, UnknownCodeError
from dslkit.diagnostics import Severity, Template


@dataclass(frozen=True)
class Tool:
    """A tool, with the beginning of its codes, and which of their hundreds each stage may use."""

    catalog: Catalog
    prefix: str
    hundreds: Mapping[str, Set[int]]

    def declared(self) -> Iterator[type[Template]]:
        """Every diagnostic class of the package, found by importing all of it but the command.

        Those that others are made of are none themselves.
        """
        package = importlib.import_module(self.catalog.tool)
        for module in pkgutil.walk_packages(package.__path__, f"{self.catalog.tool}."):
            if module.name.endswith(".__main__"):
                continue
            members = vars(importlib.import_module(module.name)).values()
            for member in members:
                is_class = inspect.isclass(member) and issubclass(member, Template)
                if is_class and not member.__subclasses__():
                    yield member


# 0 syntax, 1 names and declarations, 2 types, 3 units and time, 4 meaning, 5 targets, 6 recordings,
# 7 what rules mean together, tests, coverage, reports and proofs, 8 files and configuration,
# 9 defects of the tool.
ROSSMARIE = Tool(
    rossmarie.catalog.CATALOG,
    "ROSS",
    {
        "syntax": {0},
        "check": {1, 2, 3, 4, 8},
        "lowering": {4},
        "targets": {5},
        "native": {5},
        "recordings": {6},
        "starter": {6},
        "testing": {7},
        "analysis": {7},
        "report": {7},
        "verification": {7},
        "driver": {8},
        "catalog": {9},
    },
)
# 0 skills files, 1 ontologies, 2 descriptions, 3 what is said about individuals, 4 meaning,
# 5 behavior trees, 6 scenes, 7 migration, 8 running, drawing, planning and learning, 9 defects of
# the tool.
EZSKIROS = Tool(
    ezskiros.catalog.CATALOG,
    "EZS",
    {
        "skills": {0, 2, 5},
        "confinement": {2},
        "ontology": {1, 3},
        "trees": {5},
        "check": {3, 4, 5, 6},
        "migrate": {7},
        "context": {8},
        "contracts": {5},
        "drawing": {8},
        "engine": {8},
        "export": {8},
        "hosts": {8},
        "locations": {6},
        "planning": {8},
        "learning": {8},
        "catalog": {9},
    },
)
# 0 files, 1 exemptions and permissions, 2 rules against skills, 3 topics and scenes, 4 a robot that
# runs, 9 defects of the tool.
CROSSCHECK = Tool(
    crosscheck.catalog.CATALOG,
    "CHK",
    {"errors": {0, 1, 2, 3}, "recovery_errors": {2}, "live": {4}, "catalog": {9}},
)
TOOLS = (ROSSMARIE, EZSKIROS, CROSSCHECK)
SECTIONS = ["What it means", "Example", "Write instead"]

each_tool = pytest.mark.parametrize("tool", TOOLS, ids=lambda tool: tool.catalog.tool)
each_diagnostic = pytest.mark.parametrize(
    ("tool", "found"),
    [
        pytest.param(tool, found, id=found.code)
        for tool in TOOLS
        for found in tool.catalog.diagnostics
    ],
)


@each_tool
def test_the_catalog_names_every_diagnostic_once(tool: Tool) -> None:
    known = tool.catalog.diagnostics
    assert [count for count in Counter(known).values() if count > 1] == []
    missing = {found.__qualname__ for found in set(tool.declared()) - set(known)}
    assert missing == set()


@each_tool
@pytest.mark.parametrize("attribute", ["code", "name"])
def test_codes_and_names_are_unique(tool: Tool, attribute: str) -> None:
    counts = Counter(getattr(found, attribute) for found in tool.catalog.diagnostics)
    assert [name for name, count in counts.items() if count > 1] == []


@each_diagnostic
def test_a_diagnostic_is_declared_properly(tool: Tool, found: type[Template]) -> None:
    assert re.fullmatch(rf"{tool.prefix}\d{{3}}", found.code)
    assert re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", found.name)
    found.check_placeholders()
    stage = found.__module__.split(".")[1]
    assert int(found.code[-3]) in tool.hundreds[stage]


@each_diagnostic
def test_a_diagnostic_has_a_page(tool: Tool, found: type[Template]) -> None:
    text = tool.catalog.page(found.code)
    assert text.split("\n")[0] == f"# {found.code} {found.name}"
    article = "an" if found.severity is Severity.ERROR else "a"
    reason = f"{article} {found.severity.value}"
    headings = re.findall(r"^## (.*)$", text, flags=re.MULTILINE)
    assert headings == [*SECTIONS, f"Why it is {reason}"]
    assert text.endswith("\n")


@each_tool
def test_there_is_no_page_without_a_diagnostic(tool: Tool) -> None:
    pages = {entry.name for entry in files(tool.catalog.package).joinpath("pages").iterdir()}
    assert pages == {f"{found.code}.md" for found in tool.catalog.diagnostics}


def test_a_page_is_found_by_code_and_name_in_any_case() -> None:
    expected = ROSSMARIE.catalog.page("ROSS900")
    for spelling in ("ross900", " Ross900 ", "internal-error", "Internal-Error"):
        assert ROSSMARIE.catalog.page(spelling) == expected


@pytest.mark.parametrize(("asked", "meant"), [("ROSS9000", "ROSS900"), ("Intern-Err", "internal")])
def test_an_unknown_code_is_answered_with_a_suggestion(asked: str, meant: str) -> None:
    with pytest.raises(UnknownCodeError, match=f"did you mean.*{meant}"):
        ROSSMARIE.catalog.page(asked)


def test_nothing_is_suggested_for_something_else() -> None:
    with pytest.raises(UnknownCodeError, match=r"`zzzz`$"):
        ROSSMARIE.catalog.page("zzzz")


@each_tool
def test_sarif_has_a_rule_with_a_summary_for_every_diagnostic(tool: Tool) -> None:
    known = tool.catalog.diagnostics
    rules = tool.catalog.sarif_tool("1.0").rules
    assert [rule.code for rule in rules] == [found.code for found in known]
    assert [rule.code for rule in rules if not rule.summary] == []
