"""Rules for live tests: nearly all effects, on a vehicle that tilts."""

from __future__ import annotations

import re
import shutil
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

from rossmarie import ir
from rossmarie.driver import compile_file
from support.compiled import machine_of
from support.rule_skills import FILE

PACKAGES = {
    "ros1": Path(__file__).with_name("ros1_packages"),
    "ros2": Path(__file__).with_name("ros2_packages"),
}
"""Packages that the robots need."""

ACTIONS = {"ros1": "actionlib/Test", "ros2": "arm_msgs/Move"}
_RULES = (
    f'skills "{FILE}";'
    + """
action alarm { publish /siren : std_msgs/Bool { data = true; }; }
action slow {
    limit /cmd_vel : geometry_msgs/Twist {
        linear.x in [-0.2, 0.2] m/s;
        angular.z in [-0.3, 0.3] rad/s;
    } ramp 0.5 m/s^2, 1 rad/s^2;
    limit /arm_vel : geometry_msgs/TwistStamped { twist.linear.x in [-0.1, 0.1] m/s; };
    log warning "it tilts";
    diagnose warning "too steep";
}
action halt {
    block /cmd_vel : geometry_msgs/Twist;
    publish /horn : std_msgs/Bool { data = true; } at 5 Hz;
    call /lamp : std_srvs/SetBool { data = true; } within 5 sec;
    hook flash;
}
action back {
    publish /cmd_vel : geometry_msgs/Twist { linear.x = -0.1 m/s; } at 10 Hz;
    scale /cmd_vel : geometry_msgs/Twist by 50 %;
}
action freeze { cancel /arm confirm by not moving within 2 sec then resend else cry; }
action seize { cancel /arm confirm by not moving within 1 sec then resend else stand; }
action stand { block /cmd_vel : geometry_msgs/Twist; }
action cry { log error "the arm does not stop"; }
action retract { send ACTION { goal = 99; } to /arm within 4 sec then resend else cry; }
action grasp { send ACTION { goal = 1; } to /gripper within 1 sec else cry; }
action grip { send ACTION { goal = 2; } to /hand within 60 sec; }
action loosen { cancel /hand then resend; }
action careful { set /planner.double_ to 0.5 else cry; }
action creep { set /planner.double_ to 0.1; }
action name { set /planner.double_ to "slow"; }
action exceed { set /planner.int_ to 100; }
action soften { switch /controller_manager { stop position; start effort, gravity; } else cry; }
input moving = topic /arm/moving : std_msgs/Bool .data;
input orientation = topic /imu/data : sensor_msgs/Imu .orientation timeout 3 sec;
input ranges = topic /scan : sensor_msgs/LaserScan .ranges;
input bypassed = topic /vehicle_safety/bypassed : std_msgs/Bool .data;
input effort = topic /joint_states : sensor_msgs/JointState .effort in Nm;
input torques = topic /effort_states : std_msgs/Float64MultiArray .data
    names ["shoulder", "elbow", "wrist"] in Nm;
input parts = topic /parts : diagnostic_msgs/DiagnosticArray .status up to 3;
input cloud = topic /cloud : sensor_msgs/PointCloud2 .points up to 9;
input laser = topic /laser : sensor_msgs/LaserScan up to 360;
input mode = topic /mode : std_msgs/String;
input place = topic /place : geometry_msgs/PoseStamped .pose;
rule tilted: if abs(orientation.pitch()) > 10 deg then { slow; };
rule fallen: if abs(orientation.pitch()) > 30 deg then { halt; } latched until reset;
rule passed_by: if bypassed then { alarm; };
rule heavy: if effort["elbow"] > 30 Nm then { alarm; };
rule driven: if torques["elbow"] > 30 Nm then { alarm; };
rule failing: if any(part in parts: part.level >= DiagnosticStatus.ERROR and part.name == "motor")
    then { alarm; };
rule crowded: if any(p in cloud: norm(p) < 1 m and p.intensity > 100) then { alarm; };
rule ahead: if min(laser.ranges[-30 deg .. 30 deg]) < 0.5 m then { alarm; };
rule beside_it: if any(p in laser.points: p.x < -0.2 m and p.y > 0.1 m and p.intensity > 5)
    then { alarm; };
rule blind: if count(b in laser.invalid: b.angle in [-30, 30] deg) > 20 then { alarm; };
rule inside: if mode == "placed" and place in SchoolCorridor then { alarm; };
rule beside: if mode == "placed" and distance(place, SchoolCorridor) < 1 m then { alarm; };
rule near: if any(ranges < 0.3 m) and mode != "docking" then { back; };
rule touched: if mode == "touched" or mode == "both" then { retract; };
rule paused: if mode == "paused" or mode == "both" or mode == "seized" then { freeze; };
rule seized: if mode == "seized" then { seize; };
rule stuck: if mode == "stuck" then { freeze; retract; };
rule open: if mode == "open" then { grasp; };
rule gripping: if mode == "gripping" then { grip; };
rule loose: if mode == "loose" then { loosen; };
rule icy: if mode == "icy" then { creep; };
rule slippery: if mode == "slippery" or mode == "icy" then { careful; };
rule named: if mode == "named" then { name; };
rule exceeded: if mode == "exceeded" then { exceed; };
rule held: if mode == "held" then { soften; };
"""
)


def rules(generation: str = "ros1") -> str:
    """The rules of the vehicle, with the action that its arm has in a generation of ROS."""
    return _RULES.replace("ACTION", ACTIONS[generation])


def vehicle(generation: str = "ros1") -> ir.Machine:
    """Slows down where it is steep, halts until reset when it falls, backs off what is near."""
    machine = machine_of(rules(generation), message_folders=(PACKAGES[generation],))
    return replace(machine, name="vehicle")


def patient(rules: Path) -> ir.Machine:
    """The machine of rules in which inputs and actions have longer than a busy machine pauses."""
    short = re.compile(r"(timeout|within) (0\.\d+|1) sec")
    with TemporaryDirectory() as folder:
        copied = shutil.copytree(rules.parent, Path(folder) / "rules") / rules.name
        text, count = short.subn(r"\1 2 sec", copied.read_text(encoding="utf-8"))
        assert count, "all of them have long already"
        copied.write_text(text, encoding="utf-8")
        return compile_file(copied).machine


def acting(effects: str) -> ir.Machine:
    """The machine of a rule with these effects."""
    return machine_of(
        "input force = topic /ft : geometry_msgs/Wrench .force timeout 0.1 sec\n"
        f"action act {{ {effects}; }}\n"
        "rule touched: if norm(force) > 10 N then { act; };"
    )


def sensors(count: int) -> str:
    """A rule on each topic of `ros1_talker` or `ros2_talker`, and commands that they bound."""
    return "".join(
        f"""
action slow_{i} {{
    limit /cmd_vel : geometry_msgs/Twist {{ linear.x in [-0.{i + 1:02}, 0.{i + 1:02}] m/s; }};
}}
input sensor_{i} = topic /sensor_{i} : geometry_msgs/Vector3Stamped .vector.x timeout 5 sec;
rule rule_{i}: if sensor_{i} > 1 for 0.1 sec then {{ slow_{i}; }} clear for 0.1 sec;
"""
        for i in range(count)
    )
