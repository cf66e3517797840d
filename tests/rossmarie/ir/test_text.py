"""The readable dump."""

from hypothesis import given, settings

from rossmarie import ir
from support.c99_cases import reacting
from support.depth import examples
from support.drafts import SECOND, Draft
from support.machines import machines
from support.reacting import reacting_machines


def test_dump() -> None:
    draft = Draft(texts=('say "x"',))
    x = draft.read(timeout_ns=SECOND // 4)
    element = draft.elements()
    least = draft.signal(ir.Fold(ir.Folding.MINIMUM, element), text="min(ranges)", unit="m")
    near = draft.proposition(
        ir.Compare(ir.Comparison.LESS, least, x), name="scan.near", text="min(ranges) < x"
    )
    draft.rule(draft.proposition(ir.Held(near, 3 * SECOND // 2)), latched=True)
    expected = (
        "machine scanner",
        "",
        "channel 0 = /topic_0 : std_msgs/Float64",
        "channel 1 = /topic_1 : std_msgs/Float64",
        "",
        "input 0 = input_0 of channel 0 timeout 0.25 s | draft.ross:1:1",
        "input 1 = input_1 of channel 1               | draft.ross:1:1",
        "",
        "slot 0 = real of input 0 .slot_0",
        "array 0 = of input 1 .array_0",
        "",
        'text 0 = "say \\"x\\""',
        "",
        "s0 = read slot 0                             | signal_0 | draft.ross:1:1",
        "s1 = element of array 0                      | signal_1 | draft.ross:1:1",
        "s2 = minimum over elements s1                | min(ranges) in m | draft.ross:1:1",
        "",
        "t0 = s2 < s0                                 "
        "| scan.near: min(ranges) < x | draft.ross:1:1",
        "t1 = t0 for 1.5 s                            | proposition_1 | draft.ross:1:1",
        "",
        "rule rule_1 = if t1, latched                 | clears by contract | draft.ross:1:1",
        "  actions stop",
        "  terms t0, t1; signals s0, s2",
        "",
    )
    assert ir.dump_text(draft.machine("scanner")).split("\n") == list(expected)


REACTIONS = """\
watch 0 = t2

command 0 = /cmd_vel : geometry_msgs/Twist   | rules/actions.ross:2:3
  field 0 = linear.x in m/s
  field 1 = angular.z in rad/s

resource 0 = parameter /cmd_vel
resource 1 = server /move_base
resource 2 = service /relay/off

action 0 = act                               | rules/actions.ross:1:1

k0 = limit command 0 to field 0 in [-0.2, 0.5] ramp 0.5 a second, action 0 | rules/actions.ross:2:3
k1 = scale command 0 by 0.5, action 0        | rules/actions.ross:3:3
k2 = set /planner.speed to 0.2 within 2 s, action 0, resource 0 | rules/actions.ross:4:10
"""


def test_dump_of_reactions() -> None:
    text = ir.dump_text(reacting())
    assert REACTIONS in text
    assert "k3 = cancel /move_base confirm by watch 0 then resend within 2 s" in text
    assert ", resource 1, otherwise k4 | rules/actions.ross:6:3\n" in text
    assert text.endswith(
        "plan of rule_1 = k0 k1, then k2\nplan of rule_2 = k3 k6\norder rule_2, rule_1\n"
    )


@given(reacting_machines())
def test_every_task_has_its_line(machine: ir.Machine) -> None:
    lines = ir.dump_text(machine).splitlines()
    tasks = [line for line in lines if line.startswith("k")]
    assert len(tasks) == len(machine.reactions.tasks)


@settings(max_examples=examples(2))
@given(machines())
def test_every_part_has_its_line(machine: ir.Machine) -> None:
    lines = ir.dump_text(machine).splitlines()
    for letter, parts in (("s", machine.signals), ("t", machine.propositions)):
        numbered = [line for line in lines if line.startswith(letter) and line[1].isdigit()]
        assert len(numbered) == len(parts)
