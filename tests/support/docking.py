"""A replay of rules that do something: a dock comes near, and two rules want the same lamp."""

from __future__ import annotations

from rossmarie.interpreter import Interpreter
from rossmarie.ir import ChannelValues
from rossmarie.report.model import Replay
from rossmarie.report.rehearsal import rehearse
from support.compiled import machine_of
from support.drafts import SECOND

RULES = """
action creep {
    limit /cmd_vel : geometry_msgs/Twist { linear.x in [-0.1, 0.1] m/s; };
    publish /lamp : std_msgs/Bool { data = true; } at 2 Hz;
}
action alarm {
    publish /lamp : std_msgs/Bool { data = true; } at 10 Hz;
    call /horn : std_srvs/Trigger within 1 sec;
}
action stop { block /cmd_vel : geometry_msgs/Twist; }
input range = topic /dock_range : std_msgs/Float32 in m timeout 5 sec;
rule docking: if range < 0.8 m then { creep; };
rule touching: if range < 0.3 m then { alarm; stop; };
priority touching over docking;
"""


def docking() -> Replay:
    """Near from 1 s on, at the dock from 2 s to 3 s, away from 4 s on."""
    machine = machine_of(RULES)
    monitor = Interpreter(machine)
    events = [
        event
        for at_s, range_m in ((0, 1.0), (1, 0.5), (2, 0.2), (3, 0.5), (4, 1.0))
        for event in monitor.update(at_s * SECOND, {0: ChannelValues({0: range_m})})
    ]
    return Replay(machine, "dock.ross", "dock.csv", "native", 0, 4 * SECOND, tuple(events), (), (),
                  rehearse(machine, events))  # fmt: skip
