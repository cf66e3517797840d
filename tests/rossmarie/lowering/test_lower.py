"""Lowering of the user's inputs, conditions and rules."""

import math

import pytest

from rossmarie import ir
from rossmarie.interpreter import Interpreter
from rossmarie.ir import Comparison
from support.compiled import (
    INPUTS,
    condition,
    constant,
    machine_of,
    machine_of_condition,
    machine_of_rules,
    proposition_node,
)

SECOND = 1_000_000_000


def names_of(machine: ir.Machine) -> list[str | None]:
    return [proposition.name for proposition in machine.propositions]


# --- inputs ----------------------------------------------------------------------------------


def test_only_what_rules_use_is_there() -> None:
    machine = machine_of_condition("imu.angular_velocity.z > 10 deg/s")
    assert machine.channels == (ir.Channel("/imu/data", "sensor_msgs/Imu"),)
    (used,) = machine.inputs
    assert (used.name, used.timeout_ns, used.span.text) == ("imu", SECOND // 5, "imu")
    (slot,) = machine.slots
    assert (slot.path, slot.kind) == (("angular_velocity", "z"), ir.FieldKind.REAL)
    assert (slot.unit, slot.scale, slot.offset) == ("rad/s", 1.0, 0.0)


def test_inputs_on_one_topic_share_its_channel() -> None:
    machine = machine_of("""
        input slow = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 2 sec;
        input fast = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 1 sec;
        action stop;
        if slow > 1 m/s or fast > 2 m/s then { stop; };
    """)
    assert len(machine.channels) == 1
    assert [used.timeout_ns for used in machine.inputs] == [2 * SECOND, SECOND]
    assert [slot.input for slot in machine.slots] == [0, 1]


@pytest.mark.parametrize(
    ("rate", "gaps_ns"),
    [
        ("10 Hz", (SECOND // 10, SECOND // 10)),
        ("[8, 12] Hz", (83_333_333, SECOND // 8)),
        ("0.02 kHz", (SECOND // 20, SECOND // 20)),
    ],
)
def test_a_channel_knows_how_far_apart_its_messages_are(
    rate: str, gaps_ns: tuple[int, int]
) -> None:
    machine = machine_of(f"""
        system base {{ topic odom = /odom : nav_msgs/Odometry at {rate}; }}
        input speed = topic odom.twist.twist.linear.x timeout 2 sec;
        action stop;
        if speed > 1 m/s then {{ stop; }};
    """)
    assert [channel.gaps_ns for channel in machine.channels] == [gaps_ns]


def test_units_of_inputs_are_converted_on_arrival() -> None:
    machine = machine_of("""
        input temperature = topic /t : std_msgs/Float64 in degC timeout 1 sec;
        input heading = topic /h : std_msgs/Float64 in deg timeout 1 sec;
        action stop;
        if temperature > 80 degC and heading > 1 rad then { stop; };
    """)
    first, second = machine.slots
    assert (first.path, first.unit, first.scale, first.offset) == (("data",), "degC", 1.0, 273.15)
    assert (second.unit, second.scale, second.offset) == ("deg", math.pi / 180, 0.0)
    limits = [s.node.value for s in machine.signals if isinstance(s.node, ir.Constant)]
    assert limits == [pytest.approx(353.15), 1.0]


def test_an_element_of_an_array_is_a_slot() -> None:
    machine = machine_of_condition("scan.ranges[3] < 1 m")
    assert machine.slots[0].path == ("ranges", 3)
    assert machine.arrays == ()


def test_arrays() -> None:
    machine, node = condition("min(scan.ranges) < 1 m", ir.Compare)
    assert [array.path for array in machine.arrays] == [("ranges",)]
    assert machine.signals[node.left].node == ir.Fold(ir.Folding.MINIMUM, 0)


def test_texts_and_flags() -> None:
    machine, node = condition('"docked" != mode and not estop', ir.And)
    text = proposition_node(machine, node.operands[0], ir.Compare)
    negation = proposition_node(machine, node.operands[1], ir.Not)
    assert machine.texts == ("docked",)
    assert [slot.kind for slot in machine.slots] == [ir.FieldKind.TEXT, ir.FieldKind.FLAG]
    assert text.comparison is Comparison.NOT_EQUAL
    assert machine.signals[text.left].node == ir.Read(0)
    assert constant(machine, text.right) == 0.0
    assert isinstance(machine.propositions[negation.operand].node, ir.Flag)


# --- conditions ------------------------------------------------------------------------------


def test_conditions_keep_their_names() -> None:
    machine = machine_of_rules(
        """
        entity power {
            low : battery < 11 V;
            bad : low and estop for 2 sec;
            unused : battery > 20 V;
        }
        rule it: if power.bad then { stop; };
    """.replace("low and estop for 2 sec", "(low and estop) for 2 sec")
    )
    assert [name for name in names_of(machine) if name] == ["power.low", "power.bad"]
    assert [machine.propositions[term].text for term in machine.rules[0].terms] == [
        "battery < 11 V",
        "estop",
        "(low and estop) for 2 sec",
    ]


def test_the_first_name_of_equal_conditions_stays() -> None:
    machine = machine_of_rules("""
        entity one { low : battery < 11 V; }
        entity two { weak : battery < 11 V; }
        rule it: if one.low then { stop; };
        rule that: if two.weak then { stop; };
    """)
    assert [name for name in names_of(machine) if name] == ["one.low"]
    assert machine.rules[0].condition == machine.rules[1].condition


def test_a_condition_may_have_the_name_of_an_entity() -> None:
    machine = machine_of_rules("""
        entity power { power : battery < 11 V; bad : power.power and estop; }
        rule it: if power.bad then { stop; };
    """)
    assert [name for name in names_of(machine) if name] == ["power.power", "power.bad"]


def test_a_long_chain_of_conditions_is_no_recursion() -> None:
    links = [f"c{i} : estop and c{i + 1};" for i in range(3000)]
    entity = f"entity e {{ {' '.join(links)} c3000 : battery > 1 V; }}"
    machine = machine_of_rules(f"{entity} rule it: if e.c0 then {{ stop; }};")
    assert sum(name is not None for name in names_of(machine)) == 3001


# --- rules -----------------------------------------------------------------------------------


def test_rules_have_names_by_position() -> None:
    machine = machine_of_rules("""
        if battery > 1 V then { stop; };
        rule rule_3: if battery > 2 V then { stop; };
        if battery > 3 V then { stop; };
        '''too much''' rule over: if battery > 4 V then { stop; };
    """)
    assert [rule.name for rule in machine.rules] == ["rule_1", "rule_3", "rule_3_", "over"]
    assert machine.rules[3].documentation is not None
    assert machine.rules[0].documentation is None


@pytest.mark.parametrize(
    ("contract", "text"),
    [
        ("", "clears when (battery > 1 V) is false"),
        ("clear when estop", "clears when (battery > 1 V) is false and estop is true"),
        ("clear for 2.0 sec", "clears when (battery > 1 V) has been false for 2.0 sec"),
        ("latched until reset", "clears on reset while (battery > 1 V) is false"),
    ],
)
def test_contracts(contract: str, text: str) -> None:
    machine = machine_of_rules(f"if battery > 1 V then {{ stop; }} {contract};")
    (rule,) = machine.rules
    release = None if rule.release is None else machine.propositions[rule.release].node
    match contract:
        case "":
            assert release == ir.Literal(True)
        case "clear when estop":
            assert isinstance(release, ir.Flag)
        case "clear for 2.0 sec":
            assert isinstance(release, ir.Held)
            assert release.duration_ns == 2 * SECOND
            assert machine.propositions[release.operand].node == ir.Not(rule.condition)
        case _:
            assert release is None
    assert rule.contract == text
    assert rule.actions == ("stop",)


def test_an_input_of_the_contract_alone_is_no_input_of_the_rule() -> None:
    machine = machine_of_rules("if battery > 1 V then { stop; } clear when estop;")
    assert [used.name for used in machine.inputs] == ["battery", "estop"]
    assert machine.rules[0].inputs == (0,)


def test_lowering_is_deterministic() -> None:
    rules = """
        entity it { steep : imu.orientation.roll() > 20 deg for 1 sec; slow : battery < 9 V; }
        if it.steep or it.slow and mode == "driving" then { stop; } clear for 1 sec;
    """
    assert ir.dump_text(machine_of_rules(rules)) == ir.dump_text(machine_of_rules(rules))


def changes(events: list[ir.Event]) -> list[ir.Change]:
    return [event.change for event in events if isinstance(event, ir.Verdict)]


def test_it_runs() -> None:
    machine = machine_of(
        INPUTS + "rule flat: if battery < 11 V for 2 sec then { stop; } clear for 1 sec;"
    )
    monitor = Interpreter(machine)

    def send(seconds: int, volts: float) -> list[ir.Change]:
        values = ir.ChannelValues(slots={0: volts})
        return changes(monitor.update(seconds * SECOND, {0: values}))

    assert [send(0, 10.0), send(1, 10.5), send(4, 12.0)] == [[], [], [ir.Change.ACTIVATED]]
    assert send(9, 12.5) == [ir.Change.CLEARED]
