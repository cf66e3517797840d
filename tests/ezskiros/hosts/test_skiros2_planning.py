"""SkiROS2 hears which implementations its task planner must not use."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from ezskiros.hosts.skiros2_skills import Hosted
from ezskiros.skills.implementation import SkillImplementation


class Planned(SkillImplementation):
    pass


class Unplanned(SkillImplementation):
    available_for_planning = False


def reported(
    implementation: type[SkillImplementation], *, has_switch: bool = False
) -> list[object]:
    """The calls of SkiROS2, in order, when it loads an implementation."""
    heard: list[object] = []

    def switch(_self: object, is_available: bool) -> None:
        heard.append(is_available)

    hosted = SimpleNamespace(description=lambda: "description")
    host = SimpleNamespace(implementation=implementation, hosted=hosted)
    parts = {
        "host": host,
        "setDescription": lambda _self, description, _label: heard.append(description),
        **({"setAvailableForPlanning": switch} if has_switch else {}),
    }
    type("Loaded", (Hosted,), parts)().createDescription()
    return heard


@pytest.mark.parametrize("has_switch", [True, False])
def test_planners_use_what_says_nothing(has_switch: bool) -> None:
    assert reported(Planned, has_switch=has_switch) == ["description"]


def test_planners_do_not_use_what_says_so() -> None:
    assert reported(Unplanned, has_switch=True) == ["description", False]


def test_skiros2_without_the_switch() -> None:
    assert reported(Unplanned) == ["description"]
