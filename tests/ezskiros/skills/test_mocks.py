"""Mocks of calls that a check skips."""

from __future__ import annotations

from typing import Any

import pytest

from ezskiros.ontology.symbols import SYMBOL_IN_TEXT
from ezskiros.skills.mocks import Mock, MockInstance, members, mock_of


class State:
    name: str = ""


class Base:
    def __init__(self) -> None:
        self.port = 3


class Arm(Base):
    rate: int
    LIMIT = 5

    def move(self) -> None:
        self.is_moving = True

    def state(self) -> State:
        return State()

    @property
    def speed(self) -> float:
        return 0.0

    @property
    def other(self) -> Arm:
        return self

    @classmethod
    def made(cls) -> Arm:
        return cls()


class Open(Arm):
    def __getattr__(self, name: str) -> str:
        return name


class Filled:
    def __init__(self, **settings: object) -> None:
        self.__dict__.update(settings)


def test_a_mock_has_the_methods_and_accessors_of_the_class() -> None:
    names = ("move", "state", "speed", "made", "rate", "LIMIT", "port", "is_moving")
    assert set(names) <= (members(Arm) or set())
    arm = mock_of(Arm, "Arm")
    assert [repr(getattr(arm, name)) for name in names] == ["Arm"] * len(names)


def test_a_mock_has_nothing_else() -> None:
    with pytest.raises(AttributeError, match="'Arm' object has no attribute 'mvoe'"):
        _ = MockInstance("Arm", Arm).mvoe


@pytest.mark.parametrize("kind", [Open, Filled, OSError, memoryview])
def test_of_some_classes_not_all_is_known(kind: type) -> None:
    assert members(kind) is None
    assert isinstance(MockInstance("made()", kind).whatever, Mock)


def test_methods_give_what_they_are_declared_to() -> None:
    arm: Any = MockInstance("Arm", Arm)
    assert arm.move() is None
    assert isinstance(arm.state().name, Mock)
    assert isinstance(arm.speed, Mock)
    assert arm.other.move() is None
    assert isinstance(arm.made().state(), Mock)


def test_a_mock_is_of_the_class() -> None:
    assert isinstance(MockInstance("Arm", Arm), Arm)
    # A number would be taken for one that is known.
    assert not isinstance(MockInstance("int", int), int)


def test_what_is_made_of_a_mock_is_one() -> None:
    mock = Mock("read")
    with mock as inside:
        assert isinstance(inside, Mock)
    for made in (mock + 1, 1 - mock, -mock, mock["key"], mock.part, mock(3), mock < 3, mock == 3):
        assert repr(made) == "read"
    mock["key"] = 3
    assert [repr(each) for each in (mock.name, mock.source, mock.parts)] == ["read"] * 3


def test_a_mock_has_as_many_parts_as_are_asked_for() -> None:
    place, turn = Mock("look_up")
    assert (repr(place), repr(turn)) == ("look_up", "look_up")
    assert list(Mock("none")) == []
    one, *_more = Mock("several")
    assert repr(one) == "several"


def test_texts_that_are_made_of_mocks_can_be_reported() -> None:
    assert SYMBOL_IN_TEXT in f"a {Mock('read')}"
