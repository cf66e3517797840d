"""Rules as text, all the way to a machine, and what stands in it."""

from __future__ import annotations

from pathlib import Path
from typing import TypeVar

from rossmarie import ir
from rossmarie.lowering import lower
from support.programs import program_of

Node = TypeVar("Node")

INPUTS = """
input imu = topic /imu/data : sensor_msgs/Imu timeout 0.2 sec;
input odom = topic /odom : nav_msgs/Odometry timeout 1 sec;
input scan = topic /scan : sensor_msgs/LaserScan timeout 1 sec;
input battery = topic /battery : std_msgs/Float32 in V;
input mode = topic /mode : std_msgs/String;
input estop = topic /estop : std_msgs/Bool;
action stop;
"""


def machine_of(text: str, *, message_folders: tuple[Path, ...] = ()) -> ir.Machine:
    """The verified machine of a program that has no errors."""
    machine = lower(program_of(text, message_folders=message_folders))
    ir.verify(machine)
    return machine


def machine_of_rules(rules: str) -> ir.Machine:
    """The machine of rules, entities and constants over `INPUTS`."""
    return machine_of(INPUTS + rules)


def machine_of_condition(condition: str) -> ir.Machine:
    """The machine of one rule over `INPUTS`."""
    return machine_of_rules(f"rule it: if {condition} then {{ stop; }};")


def condition(text: str, kind: type[Node]) -> tuple[ir.Machine, Node]:
    """The machine of one condition, and what stands at its top."""
    machine = machine_of_condition(text)
    return machine, proposition_node(machine, machine.rules[0].condition, kind)


def proposition_node(machine: ir.Machine, index: int, kind: type[Node]) -> Node:
    """A boolean, which is of this kind."""
    node = machine.propositions[index].node
    assert isinstance(node, kind)
    return node


def signal_node(machine: ir.Machine, index: int, kind: type[Node]) -> Node:
    """A signal, which is of this kind."""
    node = machine.signals[index].node
    assert isinstance(node, kind)
    return node


def constant(machine: ir.Machine, signal: int) -> float:
    """The value of a signal that is known when compiling."""
    return signal_node(machine, signal, ir.Constant).value
