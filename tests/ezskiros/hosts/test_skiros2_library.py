"""The skills of a library that SkiROS2 may load."""

from __future__ import annotations

import importlib
from typing import Any

import pytest

from dslkit.diagnostics import Collector
from ezskiros import session
from ezskiros.hosts.skiros2_library import CheckedLibrary, check_library

WAIT = """
class Wait(SkillDescription):
    def description(self, Duration: float):
        pass


class wait(Wait.SkillBase):
    def execute(self):
        return self.success("done")
"""
COMPOUND = """
class {upper}(SkillDescription):
    def description(self):
        pass


class {lower}({upper}.SkillBase):
    def expandBT(self, params):
        self.serialstar({call})
"""


def compound(name: str, call: str) -> str:
    return COMPOUND.format(upper=name.capitalize(), lower=name, call=call)


def checked(name: str, *modules: str) -> CheckedLibrary:
    found = Collector()
    with session.collecting(found):
        loaded = [importlib.import_module(f"{name}.{each}") for each in modules or ("skills",)]
    return check_library(loaded, found)


def refused(library: CheckedLibrary) -> list[str]:
    return sorted(each.__name__ for each in library.refused)


def codes(library: CheckedLibrary) -> list[str]:
    return [each.code for each in library.diagnostics]


def test_what_is_fine_is_accepted(package: Any) -> None:
    library = checked(package("one", WAIT + compound("rest", "Wait(Duration=1.0)"), ""))
    assert (refused(library), codes(library)) == ([], [])
    assert [each.__name__ for each in library.implementations] == ["wait", "rest"]


def test_only_the_class_with_the_error_is_refused(package: Any) -> None:
    text = WAIT + compound("rest", "Wait(Duration=1)") + compound("bad", "Wait(Duraton=1)")
    library = checked(package("two", text, ""))
    assert refused(library) == ["bad"]


def test_an_error_in_a_description_refuses_what_implements_and_what_calls_it(package: Any) -> None:
    text = WAIT.replace("pass", "self.pre_conditions += 5") + compound("rest", "Wait(Duration=1.0)")
    library = checked(package("three", text, ""))
    assert refused(library) == ["Wait", "rest", "wait"]
    assert {"EZS880", "EZS882"} < set(codes(library))


def test_what_calls_a_refused_skill_is_refused_to_the_top(package: Any) -> None:
    text = WAIT + compound("bad", "Wait(Duraton=1)") + compound("middle", "Bad()")
    text += compound("top", "Wait(Duration=1.0), Middle()") + compound("other", "Wait(Duration=1)")
    library = checked(package("four", text, ""))
    assert refused(library) == ["bad", "middle", "top"]
    assert codes(library).count("EZS880") == 2


def test_a_mistake_outside_of_skills_refuses_the_file(package: Any) -> None:
    wrong = compound("late", "Wait(Duration=1.0)") + "\nworld.skyros\n"
    others = {"wrong": "from .skills import Wait\n" + wrong}
    library = checked(package("five", WAIT, "", **others), "skills", "wrong")
    assert refused(library) == ["Late", "late"]


def test_a_misspelt_base_is_reported_with_all_else(package: Any) -> None:
    text = WAIT.replace("Wait.SkillBase", "Wait.SkilBase")
    library = checked(package("sixth", text, ""))
    assert refused(library) == ["wait"]


def test_a_skill_of_a_library_that_is_not_hosted_is_not_called(package: Any) -> None:
    package("seven", WAIT, "")
    caller = "from seven.skills import Wait\n" + compound("rest", "Wait(Duration=1.0)")
    assert codes(checked(package("eight", caller, ""))) == ["EZS880"]
    assert codes(checked("seven")) == []
    assert codes(checked("eight")) == []


@pytest.mark.parametrize("name", ["wait", "Wait"])
def test_names_that_skiros2_cannot_tell_apart(package: Any, name: str) -> None:
    other = "from . import skills\n" + WAIT.partition("class wait")[2].join(
        (f"\nclass {name}", "")
    ).replace("(Wait.", "(skills.Wait.")
    library = checked(package("nine" + name, WAIT, "", other=other), "skills", "other")
    assert codes(library) == ["EZS230"]
    assert refused(library) == [name]


def test_an_implementation_that_hides_its_description(package: Any) -> None:
    library = checked(package("ten", WAIT.replace("class wait", "class Wait"), ""))
    assert refused(library) == ["Wait"]
    assert "EZS882" in codes(library)
