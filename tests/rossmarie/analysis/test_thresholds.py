"""Leaves that compare one number with many constants: few queries, and the same answers."""

from __future__ import annotations

import pytest

from rossmarie.analysis.decided import find_decided
from rossmarie.analysis.inquiry import Inquiry
from rossmarie.analysis.solver import Answer, ask
from support.compiled import machine_of
from support.testing import INPUTS


def rules(*conditions: str) -> str:
    return INPUTS + "\n".join(
        f"rule r{index}: if {condition} then {{ stop; }};"
        for index, condition in enumerate(conditions)
    )


def constant(text: str) -> list[str]:
    found = find_decided(Inquiry(machine_of(text)), thorough=False)
    return [finding.diagnostic.title for finding in found]


@pytest.mark.parametrize(
    ("leaf", "constants", "titles"),
    [
        ("orientation.pitch() > {} deg", (10, 89, 90, 120), [
            "rule `r2` is never active", "rule `r3` is never active",
        ]),
        ("orientation.pitch() >= {} deg", (-90, -91, 90), [
            "rule `r0` is always active", "rule `r1` is always active",
        ]),
        ("{} deg < orientation.pitch()", (10, 90), ["rule `r1` is never active"]),
        ("norm(acceleration) < {} m/s^2", (-1, 0, 3, 9), [
            "rule `r0` is never active", "rule `r1` is never active",
        ]),
        ("any(abs(ranges) < {} m)", (1, 0, 2), ["rule `r1` is never active"]),
        ("all(abs(ranges) >= {} m)", (1, 0, 2), ["rule `r1` is always active"]),
    ],
)  # fmt: skip
def test_the_outermost_thresholds_speak_for_the_others(
    leaf: str, constants: tuple[int, ...], titles: list[str]
) -> None:
    found = constant(rules(*(leaf.format(each) for each in constants)))
    assert [title.split(":")[0] for title in found] == titles


def test_many_thresholds_cost_as_many_queries_as_two(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[object] = []

    def counted(*query: object) -> Answer:
        asked.append(query)
        return ask(*query)  # type: ignore[arg-type]

    monkeypatch.setattr("rossmarie.analysis.inquiry.ask", counted)
    assert constant(rules(*(f"norm(acceleration) > {each} m/s^2" for each in range(1, 60)))) == []
    assert len(asked) == 2
