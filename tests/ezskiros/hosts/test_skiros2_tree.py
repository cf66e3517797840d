"""Behavior trees in SkiROS2's terms."""
# ruff: noqa: N801, N802, N803
# mypy: disable-error-code="call-arg"
# A type checker takes calls of descriptions for instances of them.

from __future__ import annotations

import enum
from collections.abc import Mapping
from typing import Annotated, Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ezskiros import OPTIONAL, Key, SkillDescription
from ezskiros.hosts.skiros2_tree import HostedCall, HostedNode, Scope, hosted, lowered, raised
from ezskiros.ontology import load
from ezskiros.trees.build import build
from ezskiros.trees.library import Library
from support.ontologies import HALL

world = load(HALL)
skiros = world.skiros


class Mode(enum.Enum):
    SLOW = 1
    FAST = 2


class Move(SkillDescription):
    def description(
        self,
        Start: Annotated[skiros.Location, Key("Start Place")],  # type: ignore[name-defined]
        Target: skiros.Location,  # type: ignore[name-defined]
        Speed: float = 0.1,
        Mode: Mode = Mode.SLOW,
        Loud: OPTIONAL[bool] = False,
    ) -> None:
        pass


class move(Move.SkillBase):
    def execute(self) -> Any:
        self.params.Loud = True
        return self.success()


class Task(SkillDescription):
    def description(
        self,
        Start: skiros.Location,  # type: ignore[name-defined]
        Goal: Annotated[skiros.Location, Key("Target")],  # type: ignore[name-defined]
        Speed: float = 0.5,
        Loud: bool = False,
    ) -> None:
        pass


LIBRARY = Library({})


def translated(
    expandBT: Any, known: Mapping[str, object] | None = None, outer: Mapping[str, str] | None = None
) -> Any:
    task = type("task", (Task.SkillBase,), {"expandBT": expandBT})
    skill = LIBRARY.skill(Task)
    assert skill is not None
    root = build(task, skill, known or {"Speed": 0.5, "Loud": False})
    return hosted(root, Scope(skill, 7, outer or {}), LIBRARY)


def only(expandBT: Any, **rest: Any) -> HostedCall:
    root = translated(expandBT, **rest)
    assert isinstance(root, HostedCall)
    return root


def test_passed_parameters_get_the_keys_of_the_compound() -> None:
    call = only(lambda _, params: Move.move(Start=params.Goal, Target=params.Start))
    assert (call.type, call.label, call.known) == ("Move", "move", ("move",))
    assert call.keys["Start Place"] == "Target"
    assert call.keys["Target"] == "Start"


def test_what_is_not_passed_shares_its_name_not_its_key() -> None:
    call = only(lambda _, params: Move(Target=params.Goal))
    assert call.label is None
    assert call.keys["Start Place"] == "Start"


def test_a_name_that_the_compound_does_not_have_is_shared_by_its_children_only() -> None:
    call = only(lambda _, params: Move(Start=params.Start))
    assert call.keys["Target"] == "Target@7"


def test_values_and_defaults_have_keys_that_nobody_shares() -> None:
    root = translated(
        lambda self, params: self.serial(
            Move(Start=params.Start, Target=params.Goal, Speed=2),
            Move(Start=params.Start, Target=params.Goal, Mode=Mode.FAST),
        )
    )
    first, second = root.children
    assert first.values == {"Speed": 2.0}
    assert type(first.values["Speed"]) is float
    assert second.values == {"Mode": "FAST"}
    own = [call.keys[key] for call in (first, second) for key in ("Speed", "Mode")]
    assert len({*own, "Speed", "Mode"}) == 6


def test_a_default_that_the_child_sets_gets_to_the_key_of_the_compound() -> None:
    found = only(lambda _, _params: Move())
    assert found.keys["Loud"] != "Loud"
    assert found.found_out == {"Loud": "Loud"}
    given = only(lambda _, _params: Move(Loud=True))
    assert given.keys["Loud"] != "Loud"
    assert given.values == {"Loud": True}
    assert given.found_out == {}


def test_keys_are_those_that_the_compound_has_on_the_blackboard() -> None:
    outer = {"Start": "Start@1", "Target": "Somewhere", "Robot": "Robot@3"}
    call = only(lambda _, params: Move(Target=params.Goal), outer=outer)
    assert call.keys["Target"] == "Somewhere"
    assert call.keys["Start Place"] == "Start@1"
    assert call.keys["Robot"] == "Robot@3"


def test_branches_and_computed_values_know_the_values() -> None:
    def expandBT(self: Any, params: Any) -> None:
        self.serialstar(Move(Target=params.Goal, Speed=params.Speed * 2 if params.Loud else 9.0))

    quiet, loud = (
        translated(expandBT, {"Speed": 0.5, "Loud": each}).children[0].values
        for each in (False, True)
    )
    assert (quiet, loud) == ({"Speed": 9.0}, {"Speed": 1.0})


def test_processors_and_decorators_are_nodes() -> None:
    root = translated(
        lambda self, params: self.selector(
            self.retry(Move(Target=params.Goal), 3), self.nofail(Move(Target=params.Goal))
        )
    )
    assert (root.processor, root.limit) == ("Selector", None)
    retry, nofail = root.children
    assert (retry.processor, retry.limit) == ("Retry", 3)
    assert nofail.processor == "NoFail"
    assert all(isinstance(each, HostedNode) for each in root.children)


@pytest.mark.parametrize("name", ["Speed", "Mode"])
@given(number=st.integers(-1000, 1000), mode=st.sampled_from(Mode))
def test_values_come_back_as_they_were(name: str, number: int, mode: Mode) -> None:
    skill = LIBRARY.skill(Move)
    assert skill is not None
    parameter = skill.parameter(name)
    assert parameter is not None
    value: object = mode if name == "Mode" else number
    assert raised(lowered(value, parameter), parameter) == value


def test_a_name_that_is_no_member_says_which_there_are() -> None:
    skill = LIBRARY.skill(Move)
    assert skill is not None
    parameter = skill.parameter("Mode")
    assert parameter is not None
    with pytest.raises(ValueError, match=r"`Mode` is 'FASTER', but should be one of SLOW, FAST"):
        raised("FASTER", parameter)
