"""The page on semantics names the tests that pin each rule; they exist, and belong to the rule."""

import re
from pathlib import Path

PAGE = Path(__file__).parents[3] / "docs/explanation/semantics.md"
TESTS = Path(__file__).with_name("test_semantics.py")

RULE = re.compile(r"^\*\*S(\d+)\. .*?(?=^\*\*S|^#|\Z)", re.MULTILINE | re.DOTALL)


def rules() -> dict[int, list[str]]:
    """The tests that each rule names."""
    text = PAGE.read_text(encoding="utf-8")
    return {
        int(rule[1]): re.findall(r"`(test_\w+)`", rule[0].partition("Tests:")[2])
        for rule in RULE.finditer(text)
    }


def defined() -> set[str]:
    return set(re.findall(r"^def (test_\w+)", TESTS.read_text(encoding="utf-8"), re.MULTILINE))


def test_rules_are_numbered_in_order():
    assert list(rules()) == list(range(1, len(rules()) + 1))


def test_every_rule_names_tests_of_its_own():
    for number, names in rules().items():
        assert names, f"S{number} names no test"
        assert all(name.startswith(f"test_s{number}_") for name in names)


def test_every_named_test_exists_and_every_test_is_named():
    named = {name for names in rules().values() for name in names}
    assert named == {name for name in defined() if re.match(r"test_s\d+_", name)}


def test_the_sources_cite_existing_rules():
    package = PAGE.parents[2] / "src/rossmarie"
    texts = [
        path.read_text(encoding="utf-8")
        for folder in ("interpreter", "ir")
        for path in sorted((package / folder).glob("*.py"))
    ]
    cited = {int(number) for text in texts for number in re.findall(r"\bS(\d+)\b", text)}
    assert cited <= set(rules())
    assert len(cited) > 25
