"""Skills in rules: rules S58 to S62 of docs/explanation/semantics.md."""

from __future__ import annotations

import pytest

from rossmarie import ir
from rossmarie.ir.skills import RunningSkill, SkillArgument
from support.compiled import machine_of
from support.programs import errors_of
from support.rule_skills import HEAD, Robot, ahead, running

PUSH = running("Push", Object="skiros.Box")
FRAGILE = running("Push", Object="skiros.Glass")
CONTACT = "rule contact: if force > 5 N then { stop; }"


def doing(rules: str, skill: str = "") -> list[ir.Doing]:
    """The queries of rules, in the order of the machine."""
    steps = (slot.path[0] for slot in machine_of(HEAD + rules).slots)
    return [step for step in steps if isinstance(step, ir.Doing) and skill in step.written]


# --- S58 ---------------------------------------------------------------------------------------


def test_s58_a_query_asks_for_all_that_is_derived() -> None:
    rule = "rule it: if doing Move and doing Push(Object: Fragile) then { stop; };"
    move, push = doing(rule)
    assert (move.skills, move.arguments) == (("Drive", "Move"), ())
    assert push.skills == ("Push",)
    assert push.arguments == (("Object", ("skiros.Fragile", "skiros.Glass")),)
    assert str(push) == "doing Push(Object: Fragile)"


def test_s58_the_flag_is_one_boolean_of_all_skills_that_run() -> None:
    robot = Robot("rule it: if doing Push(Object: Fragile) then { stop; };")
    robot.tell(0, PUSH, running("Drive"))
    assert robot.active() == set()
    robot.tell(0.1, PUSH, FRAGILE)
    assert robot.active() == {"it"}
    robot.tell(0.2)
    assert robot.active() == set()


def test_s58_another_export_answers_nothing() -> None:
    robot = Robot("rule it: if doing Push then { stop; };")
    robot.tell(0)
    assert robot.active() == set()
    robot.tell(0.1, digest="00" * 32)
    assert robot.active() == {"it"}


def test_s58_a_number_is_that_of_the_one_skill_that_runs() -> None:
    rules = """
    input weight = doing Push.Object.Weight;
    rule heavy: if weight > 3 kg then { stop; };
    """
    (slot,) = machine_of(HEAD + rules).slots
    (step,) = slot.path
    assert isinstance(step, ir.Quantity)
    assert (step.skills, step.parameter, step.property) == (("Push",), "Object", "skiros.Weight")
    assert (slot.kind, slot.scale, slot.unit) == (ir.FieldKind.REAL, 1.0, "kg")
    machine = machine_of(HEAD + rules)
    assert [(used.name, used.timeout_ns) for used in machine.inputs] == [("weight", 10**9)]


@pytest.mark.parametrize(
    ("number", "active"),
    [(1.0, {"it"}), (0.0, {"no"}), (-0.0, {"no"}), (0.25, {"it", "no"}), (-1.0, {"it", "no"})],
)
def test_s58_a_boolean_of_a_skill_is_0_or_1(number: float, active: set[str]) -> None:
    robot = Robot("""
    input gently = doing Push.Gently;
    rule it: if gently then { stop; };
    rule no: if not gently then { stop; };
    """)
    robot.tell(0, RunningSkill("Push", (SkillArgument("Gently", number=number),)))
    assert robot.active() == active


# --- S67 ---------------------------------------------------------------------------------------


def test_s67_a_query_about_what_can_start_next() -> None:
    robot = Robot("rule it: if ahead Push(Object: Fragile) then { stop; };")
    robot.tell(0, FRAGILE, ahead("Drive"), ahead("Push", Object="skiros.Box"))
    assert robot.active() == set()
    robot.tell(0.1, ahead("Push", Object="skiros.Glass"))
    assert robot.active() == {"it"}
    robot.tell(0.2, PUSH)
    assert robot.active() == set()


def test_s67_a_value_that_nobody_knows_fits_every_class() -> None:
    robot = Robot("rule it: if ahead Push(Object: Fragile) then { stop; };")
    robot.tell(0, ahead("Push"))
    assert robot.active() == {"it"}


def test_s67_nobody_knows_what_is_ahead() -> None:
    """It is stale for as long as that, and what runs is known."""
    robot = Robot("""
    rule next: if ahead Push then { stop; };
    rule now: if doing Push then { stop; };
    """)
    robot.tell(0)
    assert robot.active() == set()
    robot.tell(0.1, is_ahead_known=False)
    assert robot.active() == {"next"}
    robot.tell(0.2)
    assert robot.active() == set()


# --- S59 ---------------------------------------------------------------------------------------


def test_s59_the_context_is_stale_after_five_periods() -> None:
    head = HEAD.replace(" timeout 1 sec", "")
    machine = machine_of(head + "rule it: if doing Push then { stop; };")
    assert [(used.name, used.timeout_ns) for used in machine.inputs] == [
        ("skill_context", 500_000_000)
    ]


def test_s59_what_rules_ask_is_stale_when_the_context_is_late() -> None:
    robot = Robot("rule it: if doing Push then { stop; };")
    robot.tell(0)
    robot.wait(0.999)
    assert robot.active() == set()
    robot.wait(1)
    assert robot.active() == {"it"}


def test_s59_what_exemptions_rest_on_is_false_when_the_context_is_late() -> None:
    robot = Robot(f"{CONTACT} unless doing Push then {{ slow; }};")
    robot.tell(0, PUSH, force=9)
    assert robot.active() == {"contact_doing_Push"}
    robot.wait(0.999)
    assert robot.active() == {"contact_doing_Push"}
    robot.wait(1)
    assert robot.active() == {"contact"}
    robot.tell(2, PUSH)
    assert robot.active() == {"contact_doing_Push"}


def test_s59_names_of_inputs_make_way_for_those_of_users() -> None:
    rules = """
    input skill_context = topic /c : std_msgs/Bool timeout 1 sec;
    rule it: if doing Push and skill_context then { stop; } unless doing Insert;
    """
    names = [used.name for used in machine_of(HEAD + rules).inputs]
    assert sorted(names) == ["skill_context", "skill_context_", "skill_context_kept"]


# --- S60 ---------------------------------------------------------------------------------------


def test_s60_an_exempted_rule_is_not_applied_while_the_skill_runs() -> None:
    robot = Robot(f"{CONTACT} unless doing Push(Object: Fragile);")
    robot.tell(0, force=9)
    assert robot.active() == {"contact"}
    robot.tell(0.1, FRAGILE)
    assert robot.active() == {"contact_doing_Push"}
    robot.tell(0.2, PUSH)
    assert robot.active() == {"contact"}
    robot.feel(0.3, 1)
    assert robot.active() == set()


def test_s60_the_exempted_rule_holds_when_nobody_knows_what_runs() -> None:
    robot = Robot(f"{CONTACT} unless doing Push then {{ slow; }};")
    robot.feel(0, 9)
    assert robot.active() == {"contact"}
    robot.tell(0.1, PUSH)
    assert robot.active() == {"contact_doing_Push"}
    robot.tell(0.2, PUSH, digest="00" * 32)
    assert "contact" in robot.active()
    robot.tell(0.3, PUSH)
    assert robot.active() == {"contact_doing_Push"}


def test_s60_no_exemption_begins_without_a_context() -> None:
    robot = Robot(f"{CONTACT} unless doing Push then {{ slow; }};")
    robot.tell(0, PUSH, digest="00" * 32, force=9)
    robot.wait(5)
    assert robot.active() == {"contact"}


def test_s60_a_scope_holds_when_nobody_knows_what_runs() -> None:
    robot = Robot("rule it: if force > 5 N while doing Drive, doing Insert then { stop; };")
    robot.tell(0, force=9)
    assert robot.active() == set()
    robot.tell(0.1, running("Insert"))
    assert robot.active() == {"it"}
    robot.tell(0.2, PUSH)
    assert robot.active() == set()
    robot.wait(2)
    assert robot.active() == {"it"}
    robot.feel(2.1, 1)
    assert robot.active() == set()


def test_s60_exemptions_count_within_the_scope() -> None:
    rules = "rule it: if force > 5 N while doing Push then { stop; } unless doing Insert;"
    robot = Robot(rules)
    robot.tell(0, running("Insert"), force=9)
    assert robot.active() == set()
    robot.tell(0.1, running("Insert"), PUSH)
    assert robot.active() == {"it_doing_Insert"}
    robot.tell(0.2, PUSH)
    assert robot.active() == {"it"}


def test_s60_names_orders_and_what_reports_need() -> None:
    rules = f"""
    hazard H "crushing";
    rule first: if force > 1 N then {{ slow; }};
    {CONTACT}
        unless doing Push(Object: Fragile) then {{ slow; }}
        unless doing Insert then if force > 9 N then {{ slow; }}
        unless doing Push
            then {{ slow; }}
        clear for 1 sec
        category human
        feedback 1 per activation
        mitigates H;
    priority contact over first;
    """
    machine = machine_of(HEAD + rules)
    names = [rule.name for rule in machine.rules]
    made = ["contact_doing_Push", "contact_doing_Insert", "contact_while_Insert"]
    assert names == ["first", "contact", *made, "contact_doing_Push_2"]
    by_name = {rule.name: rule for rule in machine.rules}
    contact = "contact with skiros.Product"
    assert {name: rule.exempts for name, rule in by_name.items() if rule.exempts} == {
        made[0]: ir.Exemption("contact", "doing Push(Object: Fragile)", (f"{contact} up to 30 N",)),
        made[1]: ir.Exemption("contact", "doing Insert", (contact,)),
        made[2]: ir.Exemption("contact", "doing Insert", (contact,)),
        "contact_doing_Push_2": ir.Exemption("contact", "doing Push", (f"{contact} up to 30 N",)),
    }
    mitigating = [rule.name for rule in machine.rules if rule.hazards]
    assert mitigating == ["contact", made[0], made[2], "contact_doing_Push_2"]
    assert {rule.categories for rule in machine.rules[1:]} == {(ir.Category.HUMAN,)}
    assert [rule.name for rule in machine.rules if rule.feedback.per_activation] == ["contact"]
    again = ir.machine_from_json(ir.machine_to_json(machine))
    assert [rule.exempts for rule in again.rules] == [rule.exempts for rule in machine.rules]
    assert again.calls == machine.calls


def test_s60_an_exempted_rule_comes_before_its_exemptions() -> None:
    rules = """
    action lamp { publish /lamp : std_msgs/Bool { data = true; } at 2 Hz; }
    rule contact: if force > 5 N then { lamp; } unless doing Push then { lamp; };
    rule other: if force > 1 N then { lamp; };
    priority other over contact;
    """
    machine = machine_of(HEAD + rules)
    order = [machine.rules[index].name for index in machine.reactions.order]
    assert order == ["other", "contact", "contact_doing_Push"]
    turned = rules + "priority contact_doing_Push over contact;"
    assert errors_of(HEAD + turned) == [("ROSS123", "contact")]


def test_s60_rules_without_a_name_keep_their_numbers() -> None:
    rules = """
    if force > 5 N then { stop; } unless doing Push;
    if force > 6 N then { stop; } unless doing Push;
    """
    names = [rule.name for rule in machine_of(HEAD + rules).rules]
    assert names == ["rule_1", "rule_1_doing_Push", "rule_2", "rule_2_doing_Push"]


def test_s60_always_is_kept_for_operators() -> None:
    machine = machine_of(HEAD + "rule it: always if force > 5 N then { stop; };")
    assert [rule.always for rule in machine.rules] == [True]


# --- S61 ---------------------------------------------------------------------------------------


def test_s61_another_condition_holds_while_the_skill_runs() -> None:
    robot = Robot(f"{CONTACT} unless doing Push then if force > 20 N then {{ slow; }};")
    robot.tell(0, PUSH, force=9)
    assert robot.active() == {"contact_doing_Push"}
    robot.feel(0.1, 30)
    assert robot.active() == {"contact_doing_Push", "contact_while_Push"}
    robot.tell(0.2)
    assert robot.active() == {"contact"}
    by_name = {rule.name: rule for rule in robot.machine.rules}
    assert by_name["contact_doing_Push"].actions == ()
    assert by_name["contact_while_Push"].actions == ("slow",)


def test_s61_several_exemptions_hold_side_by_side() -> None:
    robot = Robot(
        f"{CONTACT} unless doing Push then {{ slow; }} unless doing Insert then {{ stop; }};"
    )
    robot.tell(0, PUSH, running("Insert"), force=9)
    assert robot.active() == {"contact_doing_Push", "contact_doing_Insert"}


# --- S62 ---------------------------------------------------------------------------------------


def test_s62_the_contract_is_that_of_the_exempted_rule_alone() -> None:
    robot = Robot(f"{CONTACT} unless doing Push then {{ slow; }} clear for 2 sec;")
    robot.tell(0, force=9)
    robot.tell(1, PUSH)
    assert robot.active() == {"contact", "contact_doing_Push"}
    robot.tell(1.9, PUSH)
    robot.tell(2.8, PUSH)
    robot.wait(2.999)
    assert robot.active() == {"contact", "contact_doing_Push"}
    robot.wait(3)
    assert robot.active() == {"contact_doing_Push"}
    robot.feel(3.1, 1)
    assert robot.active() == set()


@pytest.mark.parametrize("contract", ["latched until reset", ""])
def test_s62_an_exemption_does_not_reset(contract: str) -> None:
    robot = Robot(f"{CONTACT} unless doing Push then {{ slow; }} {contract};")
    robot.tell(0, force=9)
    robot.tell(0.1, PUSH)
    assert ("contact" in robot.active()) is bool(contract)
    robot.monitor.reset(200_000_000)
    assert robot.active() == {"contact_doing_Push"}


def test_s62_a_latched_action_instead_outlasts_the_skill() -> None:
    rules = f"""
    action halt latched until reset;
    {CONTACT} unless doing Push then {{ halt; }};
    """
    robot = Robot(rules)
    robot.tell(0, PUSH, force=9)
    robot.tell(0.1)
    assert robot.active() == {"contact", "contact_doing_Push"}
    robot.monitor.reset(200_000_000)
    assert robot.active() == {"contact"}


def test_the_margin_of_an_exempted_rule_is_that_of_its_own_condition() -> None:
    rule = CONTACT + " unless doing Push feedback margin in N;"
    machine = machine_of(HEAD + rule)
    assert machine.rules[0].feedback.margin is not None
    assert machine.rules[1].feedback.margin is None
