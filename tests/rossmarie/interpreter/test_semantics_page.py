"""The page on semantics names the tests that pin each rule; they exist, and belong to the rule."""

import re
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[3]
PAGE = ROOT / "docs/explanation/semantics.md"

SECTION = re.compile(r"^## .*?(?=^## |\Z)", re.MULTILINE | re.DOTALL)
FILE = re.compile(r"^Tests: `(tests/\S+\.py)`$", re.MULTILINE)
RULE = re.compile(r"^\*\*S(\d+)\. .*?(?=^\*\*S|^#|\Z)", re.MULTILINE | re.DOTALL)


def sections() -> Iterator[str]:
    """The sections of the page that have rules."""
    for section in SECTION.findall(PAGE.read_text(encoding="utf-8")):
        if RULE.search(section):
            yield section


def rules_of(text: str) -> dict[int, list[str]]:
    """The tests that each rule names."""
    return {
        int(rule[1]): re.findall(r"`(test_\w+)`", rule[0].partition("Tests:")[2])
        for rule in RULE.finditer(text)
    }


def rules() -> dict[int, list[str]]:
    return rules_of(PAGE.read_text(encoding="utf-8"))


def defined_in(file: Path) -> set[str]:
    text = file.read_text(encoding="utf-8")
    return set(re.findall(r"^def (test_s\d+_\w+)", text, re.MULTILINE))


def test_rules_are_numbered_in_order() -> None:
    assert list(rules()) == list(range(1, len(rules()) + 1))


def test_every_rule_names_tests_of_its_own() -> None:
    for number, names in rules().items():
        assert names, f"S{number} names no test"
        assert all(name.startswith(f"test_s{number}_") for name in names)


def test_every_named_test_exists_in_the_file_of_its_section() -> None:
    for section in sections():
        (file,) = FILE.findall(section)
        named = {name for names in rules_of(section).values() for name in names}
        assert named - defined_in(ROOT / file) == set()


def test_every_test_of_a_rule_is_named() -> None:
    named = [name for names in rules().values() for name in names]
    folder = Path(__file__).parent
    defined = [name for file in folder.glob("*.py") for name in defined_in(file)]
    assert sorted(named) == sorted(defined)


def test_the_sources_cite_existing_rules() -> None:
    package = ROOT / "src/rossmarie"
    texts = [
        path.read_text(encoding="utf-8")
        for folder in ("interpreter", "ir")
        for path in sorted((package / folder).glob("*.py"))
    ]
    cited = {int(number) for text in texts for number in re.findall(r"\bS(\d+)\b", text)}
    assert cited <= set(rules())
    assert len(cited) > 25
