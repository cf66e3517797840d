"""The proofs' model of a machine: its dependencies are complete."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from rossmarie import ir
from rossmarie.driver import compile_file
from rossmarie.targets.c99 import types
from rossmarie.verification import layout, supports
from rossmarie.verification.fields import fields_of
from rossmarie.verification.layout import MisplacedError, layout_of
from rossmarie.verification.places import MachinePlaces, places_of

EXAMPLES = Path(__file__).parents[3] / "examples"
PROVED = ("thesis/mobile_base", "thesis/arm", "thesis/peg_in_hole", "husky/husky", "demo/demo")

RULES = """\
input turning = topic /spin : std_msgs/Float64 .data timeout 0.2 sec;
input other = topic /other : std_msgs/Float64 .data timeout 0.2 sec;
input orientation = topic /imu : sensor_msgs/Imu .orientation timeout 0.2 sec;
input ranges = topic /scan : sensor_msgs/LaserScan .ranges timeout 0.2 sec;
input path = topic /plan : nav_msgs/Path .poses up to 2 timeout 1 sec;
input pace = topic /pace : std_msgs/Float64 .data in m timeout 0.3 sec;
action stop;
rule rocking: if oscillates(turning, 2 times, within 2.0 sec, by 0.2) then { stop; };
rule wide: if count(ranges < 0.5 m) > 3 or any(ranges < 0.1 m) then { stop; };
rule quick: if (rate(turning) > 3 and age(other) > 0.1 sec) for 1 sec then { stop; };
rule steep: if orientation.pitch() > 10 deg then { stop; };
rule apart: if turning > other then { stop; };
rule median: if median(other, 2 sec) > 1 then { stop; };
rule ever: if (turning > 1 since other > 1) or once turning > 2 within 1 sec then { stop; };
rule late: if not after turning > 3, other > 3 within 1 sec then { stop; };
rule again: if not after not (other > 3), other > 3 within 1 sec then { stop; };
rule often: if count(edges of turning > other within 1 sec) > 2 then { stop; };
rule smooth: if low_pass(turning, 2 sec) > 1 then { stop; };
rule beside: if any(ranges < 0.5 m + abs(pace)) then { stop; };
rule slope: if rate(min(p in path: p.pose.position.x - pace)) < 1 m/s then { stop; };
rule counted: if count(p in path: p.pose.position.x < pace) > 3 then { stop; };
"""


@pytest.fixture(scope="module")
def machine(tmp_path_factory: pytest.TempPathFactory) -> ir.Machine:
    path = tmp_path_factory.mktemp("rules") / "small.ross"
    path.write_text(RULES)
    return compile_file(path).machine


def machines(machine: ir.Machine) -> Iterator[ir.Machine]:
    yield machine
    for name in PROVED:
        yield compile_file(EXAMPLES / f"{name}.ross").machine


def test_what_rests_on_what_is_what_all_targets_go_by(machine: ir.Machine) -> None:
    """Both were written by themselves; where they differ, one of them is wrong."""
    for each in machines(machine):
        wanted = ir.supports(each)
        for index, expected in enumerate(wanted.signals):
            assert_same(supports.support(each, (index,), ()), expected)
        for index, expected in enumerate(wanted.propositions):
            assert_same(supports.support(each, (), (index,)), expected)
        arrays = ir.element_arrays(each)
        assert supports.elements(each) == supports.SupportArrays(
            arrays.signals, arrays.propositions
        )
        for rule in each.rules:
            reported = supports.reported(each, rule.condition)
            assert (reported.terms, reported.signals, reported.inputs) == (
                rule.terms, rule.signals, rule.inputs,
            )  # fmt: skip


def assert_same(found: supports.Support, expected: ir.Support) -> None:
    assert found.slots == expected.slots
    assert found.folds == expected.folds
    assert found.waiting == expected.samples
    assert found.inputs == expected.inputs
    assert found.channels == expected.channels


def test_the_places_of_the_generator_are_taken(machine: ir.Machine) -> None:
    for each in machines(machine):
        found = layout_of(each)
        for channel in range(len(each.channels)):
            wanted = types.fields_of(each, channel)
            fields = [(field.name, field.slot, field.array) for field in fields_of(found, channel)]
            assert fields == [(field.name, field.slot, field.array) for field in wanted]


def _without_last_leaf(places: MachinePlaces) -> MachinePlaces:
    *others, last = places.guards
    return replace(places, guards=(*others, replace(last, leaves=last.leaves[:-1])))


def _two_in_one_node(places: MachinePlaces) -> MachinePlaces:
    first, second, *_ = places.node_of_proposition
    nodes = {**places.node_of_proposition, second: places.node_of_proposition[first]}
    return replace(places, node_of_proposition=nodes)


def _without_last_signal(places: MachinePlaces) -> MachinePlaces:
    return replace(places, value_of_signal=dict(list(places.value_of_signal.items())[:-1]))


def _two_in_one_value(places: MachinePlaces) -> MachinePlaces:
    others = places.value_of_slot[1:]
    return replace(places, value_of_slot=(others[0], *others))


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        (_without_last_leaf, "leaves of guards are misplaced"),
        (_two_in_one_node, "places of propositions are misplaced"),
        (_without_last_signal, "a number has no place"),
        (_two_in_one_value, "a place stands for no number"),
        (lambda places: replace(places, held=()), "durations are misplaced"),
        (lambda places: replace(places, oscillations=()), "oscillations are misplaced"),
        (lambda places: replace(places, recurring=()), "counts of edges are misplaced"),
        (lambda places: replace(places, windows=()), "windows are misplaced"),
        (lambda places: replace(places, sampled=()), "are remembered are misplaced"),
        (lambda places: replace(places, channel_names=("spin",) * 4), "have the same name"),
    ],
)
def test_places_that_leave_something_out_are_refused(
    machine: ir.Machine,
    monkeypatch: pytest.MonkeyPatch,
    damage: Callable[[MachinePlaces], MachinePlaces],
    message: str,
) -> None:
    monkeypatch.setattr(layout, "places_of", lambda machine: damage(places_of(machine)))
    with pytest.raises(MisplacedError, match=message):
        layout_of(machine)


def test_a_field_that_is_called_after_another_is_refused(machine: ir.Machine) -> None:
    found = layout_of(machine)
    swapped = {"orientation_x": "orientation_y", "orientation_y": "orientation_x"}
    names = {slot: swapped.get(name, name) for slot, name in found.places.slot_names.items()}
    assert names != found.places.slot_names
    wrong = replace(found, places=replace(found.places, slot_names=names))
    channel = next(i for i, each in enumerate(machine.channels) if each.topic == "/imu")
    with pytest.raises(MisplacedError, match="a field at orientation_x is called orientation_y"):
        fields_of(wrong, channel)
