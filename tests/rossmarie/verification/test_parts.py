"""The parts of the generated C, proved by CBMC against what the rules mean."""

from __future__ import annotations

import pytest

from rossmarie import ir
from rossmarie.driver import compile_file
from rossmarie.verification.prover import ProofVerdict, Prover, ProverError
from support.depth import deep
from support.provers import NO_CHANGE, asked, real_prover
from support.small_rules import TILTED

SECONDS = 120

MORE_RULES = """\
input turning = topic /spin : std_msgs/Float64 .data timeout 0.2 sec;
input orientation = topic /imu : sensor_msgs/Imu .orientation timeout 0.2 sec;
input ranges = topic /scan : sensor_msgs/LaserScan .ranges timeout 0.2 sec;
action stop;
rule rocking: if oscillates(turning, 2 times, within 2.0 sec, by 0.2) then { stop; };
rule steep: if orientation.pitch() > 10 deg then { stop; };
rule near: if any(ranges < 0.5 m) then { stop; };
rule far: if min(ranges) > 20 m then { stop; };
rule often: if count(edges of turning > 1 within 2 sec) > 1 then { stop; };
rule smooth: if low_pass(turning, 0.3 sec) > 2 then { stop; };
"""
"""Rules with counts, angles, and elements of arrays."""

FLAGS = """\
input ready = topic /ready : std_msgs/Bool .data timeout 1 sec;
input mode = topic /mode : std_msgs/String .data timeout 1 sec;
action stop;
rule waits: if not ready or mode == "manual" then { stop; };
"""

OVER_TIME = """\
input ready = topic /ready : std_msgs/Bool .data timeout 1 sec;
input reported = topic /reported : std_msgs/Bool .data;
action stop;
rule ever: if ready since reported then { stop; };
rule recent: if once reported within 2 sec then { stop; };
rule late: if not after reported, ready within 2 sec then { stop; };
"""

PREVIOUS = """\
input turning = topic /spin : std_msgs/Float64 .data timeout 0.2 sec;
action stop;
rule turned: if previous(turning) > 1 then { stop; };
"""
"""A sample before, without a quotient: to find one that refutes something takes solvers minutes."""

WIDE = """\
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec;
action stop;
"""


@pytest.fixture(scope="module")
def prover() -> Prover:
    return real_prover()


@pytest.fixture(scope="module")
def machine(tmp_path_factory: pytest.TempPathFactory) -> ir.Machine:
    return compiled(TILTED, tmp_path_factory)


@pytest.fixture(scope="module")
def counting(tmp_path_factory: pytest.TempPathFactory) -> ir.Machine:
    return compiled(MORE_RULES, tmp_path_factory)


@pytest.fixture(scope="module")
def flagged(tmp_path_factory: pytest.TempPathFactory) -> ir.Machine:
    return compiled(FLAGS, tmp_path_factory)


@pytest.fixture(scope="module")
def over_time(tmp_path_factory: pytest.TempPathFactory) -> ir.Machine:
    return compiled(OVER_TIME, tmp_path_factory)


def compiled(rules: str, folders: pytest.TempPathFactory) -> ir.Machine:
    path = folders.mktemp("rules") / "small.ross"
    path.write_text(rules)
    return compile_file(path).machine


def outcomes(prover: Prover, machine: ir.Machine, change: tuple[str, str], *parts: str) -> set[str]:
    """The sentences that do not hold after a change of the generated C."""
    wrong: set[str] = set()
    for outcome in asked(prover, machine, change, parts, SECONDS):
        assert outcome.verdict is not ProofVerdict.UNDECIDED, (outcome.check, outcome.reasons)
        wrong.update(outcome.reasons)
    return wrong


@pytest.mark.parametrize(
    "parts",
    ["inside", *deep(["numbers", "visit", "tick", "cross", "update_ready", "update_mode"])],
)
def test_flags_and_texts_are_what_they_mean(
    prover: Prover, flagged: ir.Machine, parts: str
) -> None:
    assert outcomes(prover, flagged, NO_CHANGE, parts) == set()


def test_a_fault_about_a_flag_is_refuted(prover: Prover, flagged: ir.Machine) -> None:
    change = ("{0.5, ", "{1.5, ")
    assert outcomes(prover, flagged, change, "inside_0") == {"`ready` has its defined value"}


@pytest.mark.parametrize(
    "parts", ["init", *deep(["visit_3", "restart", "visit", "tick", "earl", "set_wake", "waiting"])]
)
def test_what_looks_back_is_what_it_means(
    prover: Prover, over_time: ir.Machine, parts: str
) -> None:
    assert outcomes(prover, over_time, NO_CHANGE, parts) == set()


@pytest.mark.deep
@pytest.mark.parametrize(
    ("change", "part", "expected"),
    [
        (("(unsigned char)UNKNOWN : held_initially[k];", "(unsigned char)UNKNOWN : FALSE;"),
         "restart", "`held_before` has its expected value"),
        (("either(m->truth_value[begun], m->since_before[k]);", "m->since_before[k];"), "visit_3",
         "`ready since reported` remembers its value (S44)"),
        (("        m->held_due_ns[k] = NEVER;\n",
          "        m->held_due_ns[k] = NEVER;\n        m->since_before[0] = FALSE;\n"),
         "restart", "`since_before` has its expected value"),
    ],
)  # fmt: skip
def test_a_fault_about_what_looks_back_is_refuted(
    prover: Prover, over_time: ir.Machine, change: tuple[str, str], part: str, expected: str
) -> None:
    assert expected in outcomes(prover, over_time, change, part)


def test_a_fault_about_the_instant_of_the_sample_before_is_refuted(
    prover: Prover, tmp_path_factory: pytest.TempPathFactory
) -> None:
    change = ("        m->before_ns[k] = m->latest_ns[k];\n", "")
    expected = {"the instant of the sample of `turning` before is kept (S18)"}
    machine = compiled(PREVIOUS, tmp_path_factory)
    assert outcomes(prover, machine, change, "numbers_spin") == expected


@pytest.mark.deep
def test_marks_of_more_than_64_nodes(
    prover: Prover, tmp_path_factory: pytest.TempPathFactory
) -> None:
    """They lie in several words, beside a flag that says that there are some."""
    rules = [f"rule r{n}: if speed > {n} m/s then {{ stop; }};" for n in range(1, 41)]
    machine = compiled("\n".join([WIDE, *rules]), tmp_path_factory)
    assert outcomes(prover, machine, NO_CHANGE, "visit_70") == set()
    judged = "    if (node >= PROPOSITIONS)\n        return judge"
    change = (judged, f"    m->pending = false;\n{judged}")
    wrong = {"only `evaluate` clears `pending`", "each marked node can be evaluated"}
    assert outcomes(prover, machine, change, "visit_70") == wrong


@pytest.mark.deep
def test_evaluation_is_what_the_rules_mean(prover: Prover, machine: ir.Machine) -> None:
    assert outcomes(prover, machine, NO_CHANGE, "visit", "evaluate") == set()


@pytest.mark.parametrize(
    "parts",
    [
        "earl",
        "init",
        "latch",
        "numbers",
        *deep(["advance", "catch_up", "handed", "inside", "queries", "reset", "restart",
               "resting", "set_wake", "step", "tick", "update_tilt", "waiting"]),
    ],
)  # fmt: skip
def test_numbers_and_timers_are_what_they_mean(
    prover: Prover, machine: ir.Machine, parts: str
) -> None:
    assert outcomes(prover, machine, NO_CHANGE, parts) == set()


@pytest.mark.parametrize(
    "change",
    [
        ("#define LATEST (INT64_C(1) << 62)", "#define LATEST (INT64_C(1) << 61)"),
        (
            "enum { FALSE, TRUE, UNKNOWN, STALE, UNSET };",
            "enum { FALSE, TRUE, STALE, UNKNOWN, UNSET };",
        ),
    ],
)
def test_a_constant_that_means_something_else_is_refused(
    prover: Prover, machine: ir.Machine, change: tuple[str, str]
) -> None:
    with pytest.raises(ProverError, match="static assertion"):
        outcomes(prover, machine, change, "init")


QUICK_FAULTS = (
    (("{ return a < b ? a : b; }", "{ return a < b ? b : a; }"), "earlier",
     "the result is not later than either"),
    (("    set_wake(m);\n    return before",
      "    set_wake(m);\n    m->now_ns--;\n    return before"),
     "update_tilt_late_after", "the clock is set"),
    (("        m->active[rule / 8] = ", "        (void)"), "latch",
     "rule gone is active according to S38"),
    (("        events += visit(m, node, t_ns);", "        ;"), "evaluate",
     "each marked node is visited exactly once, and no other node is visited"),
    ((" && !UNLIKELY(x > m->high[g])", ""), "inside_0", "the number lies within the guard"),
)  # fmt: skip
FAULTS = (
    (("m->held_due_ns[k] > m->now_ns &&", "m->held_due_ns[k] > m->now_ns + 1 &&"),
     "earliest_timer", "for 2 sec` lies ahead"),
    (("    m->stamp_ns[INPUT_TILT] = t_ns;\n", ""), "numbers_tilt",
     "`stamp_ns` has its expected value"),
    (("            look(m, channel, t_ns);", "            ;"),
     "update_tilt_late_between", "the guard of `abs(tilt)`"),
    (("t_ns >= due_ns", "t_ns > due_ns"), "visit", "for 2 sec` has its defined value"),
    (("condition == STALE", "condition == UNKNOWN"), "visit", "is active according to S35 to S37"),
    (("return TRUE;\n    return a == TRUE", "return FALSE;\n    return a == TRUE"), "visit",
     "has its defined value"),
    (("fabs(m->", "-(m->"), "numbers", "`abs(tilt)` has its defined value"),
    (("fabs(m->", "-(m->"), "step_numbers_tilt", "`abs(tilt)` has its defined value"),
    (("m->value[stale_values[i]] = NAN;", "m->value[stale_values[input]] = NAN;"), "tick",
     "`abs(tilt)` is unknown if an input that it needs is not fresh"),
    (("wake_ns < LATEST ? wake_ns : LATEST", "wake_ns"), "set_wake",
     "the next wake lies in range"),
    (("    set_wake(m);\n    return before", "    m->wake_ns++;\n    return before"),
     "step_late_after", "`wake_ns` has its expected value"),
    (("        return -1;\n    if (!m->started", "        return 0;\n    if (!m->started"),
     "catch_up_refused", "an instant out of range is refused"),
    (("if (t_ns <= EARLIEST || t_ns >= LATEST)\n", "if (t_ns <= EARLIEST)\n"),
     "catch_up_refused", "the function searches for no timer"),
    (("        tick(m, wake_ns);\n", "        tick(m, wake_ns);\n        m->stamp_ns[0]++;\n"),
     "catch_up_ticked", "the stamp of tilt is in the past"),
    (("evaluate(m, wake_ns);\n", "evaluate(m, wake_ns);\n        m->now_ns--;\n"),
     "catch_up_pass", "`now_ns` has its expected value"),
    (("(advance)(m, t_ns);\n    if (events < 0)\n        return events;",
      "(advance)(m, t_ns);\n    if (events < 0)\n        return 0;"), "reset_refused",
     "an instant out of range is refused"),
    (("    if (is_pending(m))\n        events += evaluate(m, t_ns);\n    m->now_ns = t_ns;\n"
      "    set_wake(m);\n",
      "    const bool idle = !is_pending(m);\n    if (!idle)\n        evaluate(m, t_ns);"
      "\n    m->now_ns = t_ns;\n    set_wake(m);\n    m->now_ns -= idle;\n"),
     "advance_after", "the clock is set"),
    (("    int events = 0;\n    m->now_ns = t_ns;\n",
      "    int events = 0;\n    m->now_ns = t_ns;\n    m->stamp_ns[0]--;\n"), "evaluate",
     "`stamp_ns` has its expected value"),
    (("        m->state[i] = FRESH;\n", ""), "update_tilt_late_before",
     "a message makes tilt fresh; nothing else changes it"),
    (("    tick(m, t_ns);\n    return events;",
      "    tick(m, t_ns);\n    m->value[VALUE_SPEED] = 0.0;\n    return events;"),
     "update_tilt_late_between", "no other message changes `speed`"),
    (("    m->state[input] = EXPIRED;\n", "    m->state[input] = NEVER_RECEIVED;\n"), "tick",
     "`state` has its expected value"),
    (("(age_ns < LONGEST ? age_ns : LONGEST)", "age_ns / 2"), "restart",
     "`stamp_ns` has its expected value"),
    (("            m->truth_value[rule_condition[i]] == FALSE)\n", "            true)\n"), "reset",
     "rule gone is active according to S38"),
    (("        events += visit(", "        (void)visit("), "evaluate", "changes are counted"),
    (("        events += evaluate(m, wake_ns);", "        (void)evaluate(m, wake_ns);"),
     "catch_up_pass", "changes are counted"),
    (("            report_jump(m, t_ns);", "            (void)report_jump;"),
     "catch_up_anew", "a time jump is reported once"),
    (("    event.from_ns = m->now_ns;", "    event.from_ns = t_ns;"), "catch_up_anew",
     "the report of a time jump has both instants"),
    (("        report(m, rule, change, t_ns);", "        (void)report;"), "visit",
     "each change of rule tilted is reported once"),
    (("= m->since_ns[terms[i]];", "= m->since_ns[terms[n]];"), "visit",
     "the report of rule gone"),
    (("m->value[shown_values[i]]", "m->value[shown_values[n]]"), "visit",
     "the report of rule gone"),
    (("    m->on_event(m->user, &event);\n}\n\nstatic int change_rule",
      "    m->on_event(m, &event);\n}\n\nstatic int change_rule"), "visit",
     "the listener receives its own `user` pointer"),
    (("(CLEARED), t_ns);\n    return events;", "(ACTIVATED), t_ns);\n    return events;"),
     "reset", "the report of rule gone"),
    (("    m->on_event = on_event;\n", ""), "init", "the monitor has its listener"),
    (("        const unsigned g = watching[i];\n",
      "        const unsigned g = GUARD_SPEED;\n"),
     "update_tilt_late_between", "the guard of `abs(tilt)`"),
    (("/* tilt */ GUARD_ABS_TILT", "/* tilt */ GUARD_SPEED"),
     "update_tilt_calm_left", "the guard of `abs(tilt)`"),
    (("    return settle(m, arrived, t_ns, before);", "    return 0;"),
     "update_tilt_calm_left", "the guard of `abs(tilt)`"),
    (("is_inside(m, GUARD_ABS_TILT, m->value[VALUE_ABS_TILT])", "true"),
     "update_tilt_calm_inside", "the guard of `abs(tilt)`"),
)  # fmt: skip


@pytest.mark.parametrize(("change", "part", "expected"), [*QUICK_FAULTS, *deep(FAULTS)])
def test_a_mutant_is_refuted(
    prover: Prover, machine: ir.Machine, change: tuple[str, str], part: str, expected: str
) -> None:
    assert any(expected in wrong for wrong in outcomes(prover, machine, change, part))


@pytest.mark.deep
@pytest.mark.parametrize(
    "parts",
    ["visit", "cross", "tick", "numbers", "update_scan", "update_spin_late_after",
     "update_spin_counts"],
)  # fmt: skip
def test_what_counts_and_elements_are_what_they_mean(
    prover: Prover, counting: ir.Machine, parts: str
) -> None:
    assert outcomes(prover, counting, NO_CHANGE, parts) == set()


@pytest.mark.deep
@pytest.mark.parametrize(
    ("change", "part", "expected"),
    [
        (("    if (value == TRUE)\n        wake_by(m, recent_end(m, k));\n", ""),
         "tick", "the monitor wakes before the window of"),
        (("    receive_imu(m, t_ns, orientation_x, orientation_y,",
          "    receive_imu(m, t_ns, orientation_y, orientation_x,"), "handed_imu",
         "orientation_x is passed on unchanged"),
        (("return take_scan(m, t_ns, ranges,", "return take_scan(m, t_ns, ranges + 1,"),
         "handed_scan", "ranges is passed on unchanged"),
        (("    receive_spin(m, t_ns, data);\n    compute", "    compute"), "handed_spin",
         "an accepted message is passed on once, a refused one never"),
        (("x > extreme + swing", "x >= extreme + swing"), "numbers_spin", "the turning points of"),
        (("    m->recent_next[k] = ", "    (void)"), "numbers_spin", "the turning points of"),
        (("    m->recent_next[k] = ", "    (void)"), "visit_7",
         "`recent_next` has its expected value"),
        (("operand == TRUE && before == FALSE", "operand == TRUE && before != TRUE"), "visit_7",
         "has its expected value"),
        (("    m->edge_before[k] = operand;", ""), "visit_7", "has its defined value"),
        (("        m->edge_before[k] = m->started ? UNKNOWN : FALSE;", "        ;"), "restart",
         "`edge_before` has its expected value"),
        (("recent_due(m, k) <= t_ns", "recent_due(m, k) < t_ns"), "tick",
         "edges of turning > 1 within 2 sec) > 1` has its defined value"),
        (("        forget_turns(m, k);\n        return", "        return"), "tick",
         "`recent_count` has its expected value"),
        (("unknowns != 0 || count == 0", "count == 0"), "numbers_scan",
         "`any(ranges < 0.5 m)` has its defined value"),
        (("{ return m->value[guard_value[g]]; }", "{ return (void)m, (void)g, NAN; }"), "cross_2",
         "the guard of `min(ranges)`"),
    ],
)  # fmt: skip
def test_a_mutant_in_them_is_refuted(
    prover: Prover, counting: ir.Machine, change: tuple[str, str], part: str, expected: str
) -> None:
    assert any(expected in wrong for wrong in outcomes(prover, counting, change, part))


@pytest.mark.deep
def test_arc_sines_are_the_formulas_of_the_core(prover: Prover, counting: ir.Machine) -> None:
    assert outcomes(prover, counting, NO_CHANGE, "arcsine") == set()


@pytest.mark.deep
def test_an_arc_sine_of_what_is_unknown_is_refuted(prover: Prover, counting: ir.Machine) -> None:
    change = ("return size < 0.5 ?", "return isnan(x) ? 0.0 : size < 0.5 ?")
    expected = {"the result is unknown if an operand is unknown"}
    assert outcomes(prover, counting, change, "arcsine_unknown") == expected


@pytest.mark.deep
def test_another_formula_of_an_arc_sine_is_not_proved(prover: Prover, counting: ir.Machine) -> None:
    change = ("0.02237217294214989", "0.02237217294214988")
    found = [each.verdict for each in asked(prover, counting, change, ["arcsine"], 15)]
    assert found == [ProofVerdict.UNDECIDED, ProofVerdict.PROVED]


@pytest.mark.deep
def test_an_angle_of_another_number_is_not_proved(prover: Prover, counting: ir.Machine) -> None:
    """To find the numbers that refute it takes the solvers minutes."""
    change = ("n == 0.0 ? NAN :", "n == 0.0 ? 0.0 :")
    found = [each.verdict for each in asked(prover, counting, change, ["numbers_imu"], 15)]
    assert found
    assert ProofVerdict.PROVED not in found
