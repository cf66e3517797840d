"""Rules for the ROS 1 target: most effects, on a vehicle that tilts."""

from __future__ import annotations

from dataclasses import replace

from rossmarie import ir
from support.compiled import machine_of

RULES = """
action slow {
    limit /cmd_vel : geometry_msgs/Twist {
        linear.x in [-0.2, 0.2] m/s;
        angular.z in [-0.3, 0.3] rad/s;
    } ramp 0.5 m/s^2, 1 rad/s^2;
    log warning "it tilts";
    diagnose warning "too steep";
}
action halt {
    block /cmd_vel : geometry_msgs/Twist;
    publish /horn : std_msgs/Bool { data = true; } at 5 Hz;
    call /lamp : std_srvs/SetBool { data = true; } within 1 sec;
    hook flash;
}
action back {
    publish /cmd_vel : geometry_msgs/Twist { linear.x = -0.1 m/s; } at 10 Hz;
    scale /cmd_vel : geometry_msgs/Twist by 50 %;
}
action freeze { cancel /arm confirm by not moving within 1 sec then resend else cry; }
action cry { log error "the arm does not stop"; }
input moving = topic /arm/moving : std_msgs/Bool .data;
input orientation = topic /imu/data : sensor_msgs/Imu .orientation timeout 0.5 sec;
input ranges = topic /scan : sensor_msgs/LaserScan .ranges;
input mode = topic /mode : std_msgs/String;
rule tilted: if abs(orientation.pitch()) > 10 deg then { slow; };
rule fallen: if abs(orientation.pitch()) > 30 deg then { halt; } latched until reset;
rule near: if any(ranges < 0.3 m) and mode != "docking" then { back; };
rule paused: if mode == "paused" then { freeze; };
"""


def vehicle() -> ir.Machine:
    """Slows down where it is steep, halts until reset when it falls, backs off what is near."""
    return replace(machine_of(RULES), name="vehicle")
