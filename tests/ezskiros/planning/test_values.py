"""Plans about data properties."""

from __future__ import annotations

from pathlib import Path

from support.planning import names, planned, skill, world

ROBOT = """\
cora:Robot-9 a cora:Robot ; skiros:at skiros:Location-1 .
skiros:Location-1 a skiros:Location . skiros:Product-5 a skiros:Product .
"""


def test_a_goal_can_be_that_a_property_has_a_value(tmp_path: Path) -> None:
    weigh = skill(
        "Weigh",
        "Robot: cora.Robot, Place: INFERRED[skiros.Location], Piece: skiros.Product",
        "pre Robot.at(Place)",
        "post Piece.Weight",
    )
    found, scene = world(tmp_path, ROBOT, weigh)
    plan, said = planned(found, "(skiros:Weight skiros:Product-5)", scene)
    assert list(said) == []
    assert plan is not None
    assert names(plan) == ["Weigh"]
