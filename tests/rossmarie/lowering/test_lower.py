"""What becomes of the user's expressions."""

import math

import pytest

from rossmarie import ir
from rossmarie.interpreter import Interpreter
from rossmarie.ir import Comparison, Function
from support.compiled import INPUTS, machine_of, machine_of_condition, machine_of_rules

SECOND = 1_000_000_000


def condition(text: str) -> tuple[ir.Machine, ir.TruthNode]:
    """The machine of one condition, and what stands at its top."""
    machine = machine_of_condition(text)
    return machine, machine.truths[machine.rules[0].condition].node


def constant(machine: ir.Machine, signal: int) -> float:
    node = machine.signals[signal].node
    assert isinstance(node, ir.Constant)
    return node.value


def names_of(machine: ir.Machine) -> list[str | None]:
    return [truth.name for truth in machine.truths]


# --- inputs ----------------------------------------------------------------------------------


def test_only_what_rules_use_is_there():
    machine = machine_of_condition("imu.angular_velocity.z > 10 deg/s")
    assert machine.channels == (ir.Channel("/imu/data", "sensor_msgs/Imu"),)
    (used,) = machine.inputs
    assert (used.name, used.timeout_ns, used.span.text) == ("imu", SECOND // 5, "imu")
    (slot,) = machine.slots
    assert (slot.path, slot.kind) == (("angular_velocity", "z"), ir.Kind.REAL)
    assert (slot.unit, slot.scale, slot.offset) == ("rad/s", 1.0, 0.0)


def test_inputs_on_one_topic_share_its_channel():
    machine = machine_of("""
        input slow = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 2 sec;
        input fast = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 1 sec;
        action stop;
        if slow > 1 m/s or fast > 2 m/s then { stop; };
    """)
    assert len(machine.channels) == 1
    assert [used.timeout_ns for used in machine.inputs] == [2 * SECOND, SECOND]
    assert [slot.input for slot in machine.slots] == [0, 1]


def test_units_of_inputs_are_converted_on_arrival():
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


def test_an_element_of_an_array_is_a_slot():
    machine = machine_of_condition("scan.ranges[3] < 1 m")
    assert machine.slots[0].path == ("ranges", 3)
    assert machine.arrays == ()


def test_arrays():
    machine, node = condition("min(scan.ranges) < 1 m")
    assert [array.path for array in machine.arrays] == [("ranges",)]
    assert machine.signals[node.left].node == ir.Fold(ir.Folding.MINIMUM, 0)


def test_texts_and_flags():
    machine, node = condition('"docked" != mode and not estop')
    text, flag = (machine.truths[operand].node for operand in node.operands)
    assert machine.texts == ("docked",)
    assert [slot.kind for slot in machine.slots] == [ir.Kind.TEXT, ir.Kind.FLAG]
    assert text.comparison is Comparison.NOT_EQUAL
    assert machine.signals[text.left].node == ir.Read(0)
    assert constant(machine, text.right) == 0.0
    assert isinstance(machine.truths[flag.operand].node, ir.Flag)


# --- expressions -----------------------------------------------------------------------------


def test_constants_are_folded_and_converted():
    machine = machine_of_rules("""
        const fast = 36 km/h;
        rule it: if battery - 2 V > 3 * 5 V and odom.twist.twist.linear.x > fast / 2
            then { stop; };
    """)
    values = {s.node.value for s in machine.signals if isinstance(s.node, ir.Constant)}
    assert sorted(values) == [2.0, pytest.approx(5.0), 15.0]


def test_functions_of_constants_are_folded():
    machine, node = condition("battery > min(abs(-4 V), 5 V, 9 V)")
    assert constant(machine, node.right) == 4.0


def test_a_comparison_of_constants_is_a_literal():
    machine = machine_of_rules("""
        const limit = 3 V;
        rule it: if limit > 2 V or battery > limit then { stop; };
    """)
    assert machine.truths[machine.rules[0].condition].node == ir.Literal(True)


def test_what_is_true_goes_without_saying():
    machine = machine_of_rules("""
        const on = true;
        rule one: if on and battery > 3 V then { stop; };
        rule two: if battery > 3 V or not on then { stop; };
    """)
    first, second = machine.rules
    assert first.condition == second.condition
    assert isinstance(machine.truths[first.condition].node, ir.Compare)


def test_chains_are_flat_and_equal_parts_once():
    machine, node = condition(
        "battery > 1 V and (battery > 2 V and estop) and battery > 1 V and battery < 9 V"
    )
    assert isinstance(node, ir.And)
    assert [machine.truths[operand].text for operand in node.operands] == [
        "battery > 1 V",
        "battery > 2 V",
        "estop",
        "battery < 9 V",
    ]


def test_equal_expressions_are_computed_once():
    machine = machine_of_condition(
        "norm(imu.angular_velocity) > 1 rad/s or 2 rad/s < norm(imu.angular_velocity)"
    )
    functions = [s.node.function for s in machine.signals if isinstance(s.node, ir.Apply)]
    assert functions == [Function.NORM]
    assert len(machine.slots) == 3


def test_arithmetic_keeps_its_order():
    machine, node = condition("battery - 1 V - battery / 2 > 0 V")
    outer = machine.signals[node.left].node
    assert outer.function is Function.SUBTRACT
    left, right = (machine.signals[operand].node for operand in outer.operands)
    assert (left.function, right.function) == (Function.SUBTRACT, Function.DIVIDE)


def test_a_long_chain_is_no_recursion():
    machine = machine_of_condition(" + ".join(["battery"] * 240) + " > 5 V")
    assert sum(isinstance(s.node, ir.Apply) for s in machine.signals) == 239


def test_orientation():
    machine, node = condition("imu.orientation.pitch() > 10 deg")
    pitch = machine.signals[node.left]
    assert pitch.node == ir.Apply(Function.PITCH, (0, 1, 2, 3))
    assert [slot.path[-1] for slot in machine.slots] == ["x", "y", "z", "w"]
    assert constant(machine, node.right) == math.radians(10)
    # Shown in the unit that the user compares it with.
    assert (pitch.unit, pitch.scale) == ("deg", pytest.approx(180 / math.pi))


def test_previous_and_rate():
    machine, node = condition(
        "distance(odom.pose.pose.position, previous(odom.pose.pose.position)) > 1 m"
        " or rate(imu.linear_acceleration.x) > 3 m/s^3"
    )
    kinds = [type(signal.node).__name__ for signal in machine.signals]
    assert (kinds.count("Previous"), kinds.count("Rate")) == (3, 1)
    far = machine.truths[node.operands[0]].node
    norm = machine.signals[far.left].node
    assert norm.function is Function.NORM
    assert {machine.signals[part].node.function for part in norm.operands} == {Function.SUBTRACT}


def test_elementwise_conditions():
    machine, node = condition("any(abs(scan.ranges - 2 m) < 0.5 m) or count(scan.ranges < 1 m) > 3")
    some, many = (machine.truths[operand].node for operand in node.operands)
    assert some.quantifier is ir.Quantifier.ANY
    arrays = ir.element_arrays(machine)
    count = machine.signals[many.left].node
    assert (arrays.truths[some.element], arrays.truths[count.element]) == (0, 0)


def test_interval():
    machine, node = condition("battery not in [10, 14] V")
    inside = machine.truths[node.operand]
    assert inside.text == "battery in [10, 14] V"
    assert (constant(machine, inside.node.low), constant(machine, inside.node.high)) == (10.0, 14.0)


def test_box():
    machine, node = condition("odom.pose.pose.position in [-80, 10, 65, -20, 50, 130] cm")
    sides = [machine.truths[operand] for operand in node.operands]
    ends = [[constant(machine, end) for end in (s.node.low, s.node.high)] for s in sides]
    assert ends == [[-0.8, 0.1], [-0.2, 0.65], [0.5, 1.3]]
    assert sides[1].text == "odom.pose.pose.position.y in [-20, 65] cm"


@pytest.mark.parametrize(
    ("text", "negated", "age_ns", "inner"),
    [
        ("age(imu) > 1 sec", False, SECOND + 1, "age(imu) > 1 sec"),
        ("age(imu) >= 1 sec", False, SECOND, "age(imu) >= 1 sec"),
        ("age(imu) < 1 sec", True, SECOND, "age(imu) >= 1 sec"),
        ("age(imu) <= 1 sec", True, SECOND + 1, "age(imu) > 1 sec"),
        ("1 sec < age(imu)", False, SECOND + 1, "age(imu) > 1 sec"),
    ],
)
def test_age(text, negated, age_ns, inner):
    machine, node = condition(text)
    assert isinstance(node, ir.Not) == negated
    reached = machine.truths[node.operand] if isinstance(node, ir.Not) else machine.truths[0]
    assert reached.node == ir.AgeReaches(0, age_ns)
    assert reached.text == inner


def test_oscillates():
    shaking = "oscillates(imu.angular_velocity.x, 3 times, within 0.25 sec, by 180 deg/s)"
    assert condition(shaking)[1] == ir.Oscillates(0, 3, SECOND // 4, math.pi)
    _, node = condition("oscillates(battery, 2 times, within 1 sec)")
    assert node.swing == 0.0


def test_words_stand_on_one_line_without_comments():
    machine, _ = condition('battery // the main one\n   > 3 V and mode == "a  // b"')
    assert machine.truths[-2].text == 'battery > 3 V and mode == "a  // b"'


def test_a_backslash_is_no_escape_in_a_text():
    condition = r"""mode == "C:\" or mode == "b // \""""
    machine = machine_of_condition(f"{condition}  // a comment\n")
    assert machine.truths[machine.rules[0].condition].text == condition


def test_truths_of_constants_are_folded():
    rules = """
        const docked = "docked"
        const guarded = not (1 < 2 and docked != "away")
        if guarded or estop then { stop; };
    """
    machine = machine_of_rules(rules)
    assert machine.truths[machine.rules[0].condition].node == ir.Flag(0)


def test_constants_stay_apart_by_unit_and_sign_of_zero():
    machine = machine_of_condition(
        "battery > 3 V or odom.twist.twist.linear.x > 3 m/s or battery < 0 V or battery < -(0 V)"
    )
    constants = [s for s in machine.signals if isinstance(s.node, ir.Constant)]
    found = [(s.unit, repr(s.node.value)) for s in constants]
    assert found == [("V", "3.0"), ("m/s", "3.0"), ("V", "0.0"), ("V", "-0.0")]


def test_a_signal_is_shown_in_the_unit_that_it_is_first_compared_with():
    machine = machine_of_condition(
        "imu.orientation.yaw() > 90 deg and imu.orientation.yaw() < 3 rad"
    )
    units = [s.unit for s in machine.signals if isinstance(s.node, ir.Apply)]
    assert units == ["deg"]


def test_what_is_always_false_never_holds():
    assert condition("false for 2 sec or estop")[1] == ir.Flag(0)


# --- conditions ------------------------------------------------------------------------------


def test_conditions_keep_their_names():
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
    assert [machine.truths[term].text for term in machine.rules[0].terms] == [
        "battery < 11 V",
        "estop",
        "(low and estop) for 2 sec",
    ]


def test_the_first_name_of_equal_conditions_stays():
    machine = machine_of_rules("""
        entity one { low : battery < 11 V; }
        entity two { weak : battery < 11 V; }
        rule it: if one.low then { stop; };
        rule that: if two.weak then { stop; };
    """)
    assert [name for name in names_of(machine) if name] == ["one.low"]
    assert machine.rules[0].condition == machine.rules[1].condition


def test_a_condition_may_have_the_name_of_an_entity():
    machine = machine_of_rules("""
        entity power { power : battery < 11 V; bad : power.power and estop; }
        rule it: if power.bad then { stop; };
    """)
    assert [name for name in names_of(machine) if name] == ["power.power", "power.bad"]


def test_a_long_chain_of_conditions_is_no_recursion():
    links = [f"c{i} : estop and c{i + 1};" for i in range(3000)]
    entity = f"entity e {{ {' '.join(links)} c3000 : battery > 1 V; }}"
    machine = machine_of_rules(f"{entity} rule it: if e.c0 then {{ stop; }};")
    assert sum(name is not None for name in names_of(machine)) == 3001


# --- rules -----------------------------------------------------------------------------------


def test_rules_have_names_by_position():
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
def test_contracts(contract, text):
    machine = machine_of_rules(f"if battery > 1 V then {{ stop; }} {contract};")
    (rule,) = machine.rules
    release = None if rule.release is None else machine.truths[rule.release].node
    match contract:
        case "":
            assert release == ir.Literal(True)
        case "clear when estop":
            assert isinstance(release, ir.Flag)
        case "clear for 2.0 sec":
            assert release.duration_ns == 2 * SECOND
            assert machine.truths[release.operand].node == ir.Not(rule.condition)
        case _:
            assert release is None
    assert rule.contract == text
    assert rule.actions == ("stop",)


def test_an_input_of_the_contract_alone_is_no_input_of_the_rule():
    machine = machine_of_rules("if battery > 1 V then { stop; } clear when estop;")
    assert [used.name for used in machine.inputs] == ["battery", "estop"]
    assert machine.rules[0].inputs == (0,)


def test_lowering_is_deterministic():
    rules = """
        entity it { steep : imu.orientation.roll() > 20 deg for 1 sec; slow : battery < 9 V; }
        if it.steep or it.slow and mode == "driving" then { stop; } clear for 1 sec;
    """
    assert ir.dump_text(machine_of_rules(rules)) == ir.dump_text(machine_of_rules(rules))


def test_it_runs():
    machine = machine_of(
        INPUTS + "rule flat: if battery < 11 V for 2 sec then { stop; } clear for 1 sec;"
    )
    monitor = Interpreter(machine)

    def send(seconds: int, volts: float) -> list[ir.Change]:
        values = ir.ChannelValues(slots={0: volts})
        return [event.change for event in monitor.update(seconds * SECOND, {0: values})]

    assert [send(0, 10.0), send(1, 10.5), send(4, 12.0)] == [[], [], [ir.Change.ACTIVATED]]
    assert send(9, 12.5) == [ir.Change.CLEARED]
