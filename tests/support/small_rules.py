"""Rules small enough to be proved in moments: of a monitor, and of a reactor."""

TILTED = """\
input tilt = topic /tilt : std_msgs/Float64 .data timeout 0.2 sec;
input speed = topic /speed : std_msgs/Float64 .data;
action stop;
rule tilted: if (abs(tilt) > 10 and not speed == 0) for 2 sec then { stop; };
rule gone: if speed > 3 then { stop; } latched until reset;
"""

BOUNDED = """\
input speed = topic /speed : std_msgs/Float64 .data;
action slow {
    limit /cmd_vel : geometry_msgs/Twist { linear.x in [-0.2, 0.5] m/s; } ramp 0.3 m/s^2;
}
action half { scale /cmd_vel : geometry_msgs/Twist by 50 %; }
action ask { call /ask : std_srvs/Trigger within 1 sec else beep; }
action beep { publish /horn : std_msgs/Bool { data = true; } at 5 Hz; }
rule fast: if speed > 3 then { slow; ask; };
rule wild: if speed > 5 unless fast then { half; };
rule loud: if speed > 4 then { beep; };
"""

OVERRULED = """\
input speed = topic /speed : std_msgs/Float64 .data;
input moving = topic /moving : std_msgs/Bool .data;
action free {
    cancel /arm within 1 sec;
    publish /horn : std_msgs/Bool { data = true; } at 5 Hz;
}
action halt { cancel /arm confirm by not moving within 0.5 sec; }
action quit { cancel /arm within 0.5 sec; }
action beep { publish /horn : std_msgs/Bool { data = true; } at 2 Hz; }
action stop { block /cmd_vel : geometry_msgs/Twist; }
rule fast: if speed > 3 then { free; };
rule wild: if speed > 4 then { halt; };
rule loud: if speed > 5 then { quit; beep else stop; };
"""
"""Rules of which the first keeps the others from what they need."""

AT_ONCE = """\
input speed = topic /speed : std_msgs/Float64 .data;
action free {
    call /ask : std_srvs/Trigger within 1 sec;
    publish /horn : std_msgs/Bool { data = true; } at 5 Hz;
}
action ask { call /ask : std_srvs/Trigger within 1 sec; }
action beep { publish /horn : std_msgs/Bool { data = true; } at 2 Hz; }
action stop { block /cmd_vel : geometry_msgs/Twist; }
rule fast: if speed > 3 then { free; };
rule wild: if speed > 4 then { ask; };
rule loud: if speed > 5 then { beep else stop; };
"""
"""Rules of which the first keeps the others from what they need, so that they fail at once."""

LATE = """\
input speed = topic /speed : std_msgs/Float64 .data;
action free { cancel /arm within 1 sec; }
action quit { cancel /arm within 0.5 sec else stop; }
action stop { block /cmd_vel : geometry_msgs/Twist; }
rule fast: if speed > 3 then { free; };
rule wild: if speed > 4 then { quit; };
"""
"""Rules of which the first keeps the other waiting until its time is over and it fails."""

RETRACED = """\
input tip = topic /tip : geometry_msgs/Point timeout 1 sec;
action back {
    retrace tip on /back : geometry_msgs/Point up to 3 apart 1 cm, 0.1 sec at 2 Hz;
}
action again { retrace tip on /again : geometry_msgs/Point up to 3 apart 1 cm, 0.1 sec at 1 Hz; }
rule far: if tip.x > 1 m then { back; };
rule low: if tip.z < 0 m then { again; };
"""
"""Rules of which two send the poses of one memory."""
