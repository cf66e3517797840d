"""Rules as text, all the way to a machine."""

from rossmarie import ir
from rossmarie.lowering import lower
from support.programs import program_of

INPUTS = """
input imu = topic /imu/data : sensor_msgs/Imu timeout 0.2 sec;
input odom = topic /odom : nav_msgs/Odometry timeout 1 sec;
input scan = topic /scan : sensor_msgs/LaserScan timeout 1 sec;
input battery = topic /battery : std_msgs/Float32 in V;
input mode = topic /mode : std_msgs/String;
input estop = topic /estop : std_msgs/Bool;
action stop;
"""


def machine_of(text: str) -> ir.Machine:
    """The verified machine of a program that has no errors."""
    machine = lower(program_of(text))
    ir.verify(machine)
    return machine


def machine_of_rules(rules: str) -> ir.Machine:
    """The machine of rules, entities and constants over `INPUTS`."""
    return machine_of(INPUTS + rules)


def machine_of_condition(condition: str) -> ir.Machine:
    """The machine of one rule over `INPUTS`."""
    return machine_of_rules(f"rule it: if {condition} then {{ stop; }};")
