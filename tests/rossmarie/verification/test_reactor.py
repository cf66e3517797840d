"""The generated reactor, proved by CBMC against what the reactions mean, and mutants."""

from __future__ import annotations

import pytest

from rossmarie.driver.verifying import VerificationQueries, queries_of
from rossmarie.verification.prover import ProofVerdict, Prover
from support.depth import deep
from support.provers import NO_CHANGE, proofs_of_reactor, real_prover, refuted
from support.rule_skills import FILE
from support.small_rules import AT_ONCE, BOUNDED, LATE, OVERRULED


@pytest.fixture(scope="module")
def queries(tmp_path_factory: pytest.TempPathFactory) -> VerificationQueries:
    path = tmp_path_factory.mktemp("rules") / "small.ross"
    path.write_text(BOUNDED)
    return queries_of(path)


@pytest.fixture(scope="module")
def waiting(tmp_path_factory: pytest.TempPathFactory) -> VerificationQueries:
    """About rules of which some wait for what others have."""
    path = tmp_path_factory.mktemp("waiting") / "small.ross"
    path.write_text(OVERRULED)
    return queries_of(path)


@pytest.fixture(scope="module")
def late(tmp_path_factory: pytest.TempPathFactory) -> VerificationQueries:
    """The same, so few that faults of what takes long to prove are found soon."""
    path = tmp_path_factory.mktemp("late") / "small.ross"
    path.write_text(LATE)
    return queries_of(path)


@pytest.fixture(scope="module")
def failing(tmp_path_factory: pytest.TempPathFactory) -> VerificationQueries:
    """About rules of which some fail at once, as another has what they need."""
    path = tmp_path_factory.mktemp("failing") / "small.ross"
    path.write_text(AT_ONCE)
    return queries_of(path)


@pytest.fixture(scope="module")
def exempted(tmp_path_factory: pytest.TempPathFactory) -> VerificationQueries:
    """About rules with scopes and exemptions, one of which does nothing."""
    path = tmp_path_factory.mktemp("exempted") / "small.ross"
    path.write_text(f'''
        skills "{FILE}";
        action stop {{ block /cmd_vel : geometry_msgs/Twist; }}
        input force = topic /force : std_msgs/Float32 in N timeout 0.5 sec;
        rule contact: if force > 5 N then {{ stop; }}
            unless doing Push(Object: Fragile) then if force > 20 N then {{ stop; }};
        rule near: if force > 3 N while doing Drive then {{ stop; }};
    ''')
    return queries_of(path)


@pytest.fixture(scope="module")
def prover() -> Prover:
    return real_prover()


@pytest.mark.parametrize(
    "name",
    ["bounded",
     *deep(["init", "shut", "scaled", "moved", "bounds_0_0", "bounds_0_5", "set_clock",
            "release", "engaged", "next_wake", "stage_over", "decide", "give_task_commands",
            "start", "append_started", "escalate", "pass_on", "settle", "react", "report"])],
)  # fmt: skip
def test_the_reactor_is_what_reactions_mean(
    prover: Prover, queries: VerificationQueries, name: str
) -> None:
    found = proofs_of_reactor(prover, queries, *NO_CHANGE, f"reactor_{name}")
    assert [each for each in found.outcomes if each.verdict is not ProofVerdict.PROVED] == []


@pytest.mark.parametrize(
    "name", ["next_wake", *deep(["start", "settle", "react", "append_started", "report"])]
)
def test_exemptions_are_what_reactions_mean(
    prover: Prover, exempted: VerificationQueries, name: str
) -> None:
    found = proofs_of_reactor(prover, exempted, *NO_CHANGE, f"reactor_{name}")
    assert [each for each in found.outcomes if each.verdict is not ProofVerdict.PROVED] == []


@pytest.mark.parametrize(
    "name",
    ["next_wake", *deep(["set_clock", "stage_over", "start", "escalate", "pass_on", "settle"])],
)
def test_what_waits_is_what_reactions_mean(
    prover: Prover, waiting: VerificationQueries, name: str
) -> None:
    found = proofs_of_reactor(prover, waiting, *NO_CHANGE, f"reactor_{name}")
    assert [each for each in found.outcomes if each.verdict is not ProofVerdict.PROVED] == []


@pytest.mark.parametrize("name", deep(["start", "escalate", "pass_on"]))
def test_what_fails_at_once_is_what_reactions_mean(
    prover: Prover, failing: VerificationQueries, name: str
) -> None:
    found = proofs_of_reactor(prover, failing, *NO_CHANGE, f"reactor_{name}")
    assert [each for each in found.outcomes if each.verdict is not ProofVerdict.PROVED] == []


QUICK_FAULTS = (
    ("isfinite(value) ?", "!isnan(value) ?", "bounded", "the result is finite"),
    ("r->decided = 0;", "", "give_task_commands", "no task command is left"),
)
FAULTS = (
    ("lesser(greater(", "greater(lesser(", "bounded", "the result lies within the bounds"),
    ("due_ns < wake_ns ?", "due_ns > wake_ns ?", "next_wake", "the end of no task is missed (R13)"),
    ("value * b.factor", "value", "scaled", "the result is the scaled, then bounded number (R11)"),
    ("? ramp *", "? -ramp *", "moved", "a bound moves by a distance of 0 or more"),
    ("b < a ? b : a", "b < a ? a : b", "bounds_0_0", "the bounds respect each limit in force"),
    ("= r->opened && ", "= ", "shut", "the bounds let no command pass (R12)"),
    (
        "(r->since_ns[task] != NEVER)",
        "(true)",
        "set_clock",
        "no task begins, and begun tasks stay begun",
    ),
    ("r->started_count[rule] = 0;", "", "release", "has started no task"),
    ("exempted && exempted[rule]", "false", "engaged", "a rule is engaged if it is active"),
    ("&& !yields(m, exempted, rule)", "", "engaged", "a rule is engaged if it is active"),
    (
        "    r->now_ns = t_ns;\n",
        "    r->now_ns = t_ns;\n    r->stage[0]++;\n",
        "set_clock",
        "nothing else changes",
    ),
    (
        "        return false;\n    for (unsigned task = 0; task != TASKS && t_ns",
        "        return r->opened = false;\n    for (unsigned task = 0; task != TASKS && t_ns",
        "set_clock",
        "a refused instant changes nothing",
    ),
    (
        "r->engaged[rule] = false;",
        "r->engaged[rule] = r->opened = false;",
        "release",
        "nothing else changes (R9)",
    ),
    (
        "r->decided++;",
        "r->decided++;\n    r->opened = false;",
        "decide",
        "nothing else changes",
    ),
    ("r->decided++;", "", "decide", "the list has one more decision"),
    ("decide(r, task, NAMED(STOP), -1);", "", "release_0", "the tasks of the rule become idle"),
    ("decide(r, task, NAMED(START), -1);", "", "start_0_0", "has the task command to start"),
    ("append_started(r, task);", "", "start_1_0", "a task in force has started"),
    (
        "r->started[first + count] = (index_t)task;",
        "",
        "append_started",
        "the new task is the last",
    ),
    (
        "if (r->started[first + i] != task)",
        "",
        "append_started",
        "a started task is recorded once",
    ),
    (
        "r->started[first + count++] = r->started[first + i];",
        ";",
        "append_started",
        "only the new task is added",
    ),
    (
        "r->started_count[rule] = (index_t)(count + 1);",
        "r->started_count[rule] = (index_t)(count + 1);\n    r->opened = false;",
        "append_started",
        "nothing else changes",
    ),
    ("decide(r, task, NAMED(FAILED), -1);", "", "escalate", "leaves force by a task command"),
    ("tasks[task].rule || is_shared", "tasks[task].rule", "pass_on", "the overruling rule owns"),
    ("r->failed_count++;", "", "settle_ends", "leaves force by a task command"),
    ("now_ns >= due_ns)", "now_ns > due_ns)", "settle_ends", "a task fails at its timeout (R4)"),
    ("HOLDING && state != WAITING", "HOLDING", "stage_over", "a stage is over if all its"),
    ("r->stage[rule_order[i]]++;", "", "settle_0", "a stage starts once"),
    ("r->stage[rule_order[i]]++;", "", "settle_passes", "unwinding assertion"),
    ("r->engaged[rule] && !goes_on", "!goes_on", "react", "an engaged rule is released"),
    ("if (starts[rule_order[i]])", "if (false)", "react_0", "each engaged rule has started (R3)"),
    ("r->reported[task] = true;", ";", "report", "a reported success is kept"),
    ("fail(r, (unsigned)task, FAILED);", ";", "report", "a reported failure counts"),
)


FAULTS_OF_WAITING = (
    (
        "if (due_ns > r->now_ns)\n            wake_ns",
        "if (due_ns > r->now_ns && r->state[task] == RUNNING)\n            wake_ns",
        "next_wake",
        "the end of no task is missed (R13)",
    ),
    (
        "== WAITING && r->now_ns >= due(r, task)",
        "== IDLE",
        "settle_ends",
        "waits until its timeout fails",
    ),
    (
        "r->now_ns >= due(r, task)",
        "r->now_ns > due(r, task)",
        "settle_ends",
        "waits until its timeout fails",
    ),
    ("r->state[other] == HOLDING && ", "", "settle_ends", "waits until its timeout fails"),
    (
        "if (is_late && !is_answered(r, m, task))",
        "if (is_late)",
        "settle_ends",
        "otherwise the task goes on",
    ),
    (
        "return is_confirmed(m, task);",
        "return true;",
        "settle_ends",
        "waits until its timeout fails",
    ),
)
FAULTS_OF_WHAT_IS_LATE = (
    ("give_up(r, task);", "", "pass_on", "a task in force has the task command to start"),
    ("|| r->state[task] == OVERDUE)", ")", "pass_on", "a waiting task waits for another rule (R8)"),
    (
        "is_same && tasks[task].timeout_ns == 0",
        "is_same",
        "pass_on",
        "no other rule owns the resource",
    ),
    (
        "        if (r->state[*task] != IDLE)\n            continue;\n",
        "",
        "escalate",
        "a task that follows from no failure stays as it is",
    ),
)


@pytest.mark.parametrize(("old", "new", "name", "expected"), deep(FAULTS_OF_WAITING))
def test_a_mutant_of_waiting_is_refuted(
    prover: Prover, waiting: VerificationQueries, old: str, new: str, name: str, expected: str
) -> None:
    found = proofs_of_reactor(prover, waiting, old, new, f"reactor_{name}")
    assert any(expected in reason for reason in refuted(found)), found.outcomes


@pytest.mark.deep
def test_a_mutant_of_what_fails_at_once_is_refuted(
    prover: Prover, failing: VerificationQueries
) -> None:
    fault = "if (tasks[task].fails_at_once)"
    found = proofs_of_reactor(prover, failing, fault, "if (false)", "reactor_start_2_0")
    assert any("a task is in a state" in reason for reason in refuted(found)), found.outcomes


@pytest.mark.parametrize(("old", "new", "name", "expected"), deep(FAULTS_OF_WHAT_IS_LATE))
def test_a_mutant_of_what_is_late_is_refuted(
    prover: Prover, late: VerificationQueries, old: str, new: str, name: str, expected: str
) -> None:
    found = proofs_of_reactor(prover, late, old, new, f"reactor_{name}")
    assert any(expected in reason for reason in refuted(found)), found.outcomes


@pytest.mark.parametrize(("old", "new", "name", "expected"), [*QUICK_FAULTS, *deep(FAULTS)])
def test_a_mutant_is_refuted(
    prover: Prover, queries: VerificationQueries, old: str, new: str, name: str, expected: str
) -> None:
    found = proofs_of_reactor(prover, queries, old, new, f"reactor_{name}")
    assert any(expected in reason for reason in refuted(found)), found.outcomes
