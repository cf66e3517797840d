"""The page on semantics names the tests that pin each rule; they exist, and belong to the rule."""

from pathlib import Path

from support.rule_pages import RulePage

PAGE = RulePage("docs/explanation/semantics.md", "S")


def test_rules_are_numbered_in_order() -> None:
    assert list(PAGE.rules()) == list(range(1, len(PAGE.rules()) + 1))


def test_every_rule_names_tests_of_its_own() -> None:
    assert all(PAGE.rules().values())
    assert PAGE.misnamed() == set()


def test_every_named_test_exists_in_the_file_of_its_section() -> None:
    assert PAGE.missing() == set()


def test_every_test_of_a_rule_is_named() -> None:
    assert PAGE.named() == PAGE.defined(Path(__file__).parent)


def test_the_sources_cite_existing_rules() -> None:
    cited = PAGE.cited_in("interpreter", "ir")
    assert cited <= set(PAGE.rules())
    assert len(cited) > 25
