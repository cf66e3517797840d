"""Elements by declared names become slots whose path has the place and the length (S55)."""

from __future__ import annotations

import pytest

from rossmarie import ir
from rossmarie.ir import Listed
from rossmarie.ir.path import path_text
from support.compiled import machine_of

EFFORTS = """
action stop;
input efforts = topic /effort_states : std_msgs/Float64MultiArray .data
    names ["shoulder", "elbow", "wrist"] in Nm timeout 0.1 sec;
"""
ELBOW = Listed(1, 3, "elbow")


def test_a_name_is_a_place_in_an_array_of_as_many_elements() -> None:
    machine = machine_of(EFFORTS + 'rule it: if efforts["elbow"] > 1 Nm then { stop; };')
    assert [(slot.path, slot.unit) for slot in machine.slots] == [(("data", ELBOW), "N*m")]
    again = ir.machine_from_json(ir.machine_to_json(machine))
    assert again.slots == machine.slots


def test_a_place_beside_declared_names_is_a_slot_of_its_own() -> None:
    rule = 'rule it: if efforts["elbow"] > 1 Nm or efforts[1] > 1 Nm then { stop; };'
    paths = [slot.path for slot in machine_of(EFFORTS + rule).slots]
    assert paths == [("data", ELBOW), ("data", 1)]


def test_a_path_is_shown_as_it_is_written() -> None:
    assert path_text(("data", ELBOW)) == '.data["elbow"]'


@pytest.mark.parametrize(("length", "place"), [(3, 1), (2, None), (4, None), (0, None)])
def test_s55_an_array_of_another_length_has_no_such_element(length: int, place: int | None) -> None:
    assert ELBOW.place_among(length) == place
