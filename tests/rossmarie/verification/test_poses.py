"""Memories of poses in the generated reactor, proved by CBMC against R16 and R17, and faults."""

from __future__ import annotations

import pytest

from rossmarie.driver.verifying import VerificationQueries, queries_of
from rossmarie.verification.prover import ProofVerdict, Prover
from support.depth import deep
from support.provers import NO_CHANGE, proofs_of_reactor, real_prover, refuted
from support.small_rules import RETRACED


@pytest.fixture(scope="module")
def queries(tmp_path_factory: pytest.TempPathFactory) -> VerificationQueries:
    path = tmp_path_factory.mktemp("rules") / "small.ross"
    path.write_text(RETRACED)
    return queries_of(path)


@pytest.fixture(scope="module")
def prover() -> Prover:
    return real_prover()


@pytest.mark.parametrize(
    "name",
    ["poses_due", "poses_forget",
     *deep(["poses_apart", "poses_new", "poses_record", "poses_look", "poses_wake", "poses_sen",
            "poses_begin", "poses_set_back", "poses_retraced", "set_clock", "next_wake", "init",
            "settle", "react", "start"])],
)  # fmt: skip
def test_memories_of_poses_are_what_they_mean(
    prover: Prover, queries: VerificationQueries, name: str
) -> None:
    found = proofs_of_reactor(prover, queries, *NO_CHANGE, f"reactor_{name}")
    assert [each for each in found.outcomes if each.verdict is not ProofVerdict.PROVED] == []


QUICK_FAULTS = (
    (
        "r->poses_kept[k] == 0 || !r->poses_known[k]",
        "r->poses_kept[k] == 0",
        "due",
        "one pose a period",
    ),
)
FAULTS = (
    ("z * z >= memories", "z * z > memories", "apart", "apart from the pose before"),
    ("y * y + z * z", "y * y", "apart", "apart from the pose before"),
    ("r->poses_kept[k] - 1u);\n", "0);\n", "new", "a pose is compared with the newest pose"),
    ("pose, last, r->now_ns - ", "pose, last, ", "new", "the age of the newest pose counts"),
    ("if (is_used || ", "if (", "record", "a new pose is kept"),
    ("if (r->poses_kept[k] == memories[k].most)", "if (false)", "record", "a new pose is kept"),
    ("(r->poses_oldest[k] + 1u)", "(r->poses_oldest[k] + 2u)", "record", "the oldest is dropped"),
    ("r->poses[place + i] = pose[i];", "r->poses[place] = pose[i];", "record", "is the newest"),
    ("r->pose_recorded_ns[k] = r->now_ns;", "", "record", "the instant is kept"),
    ("r->poses_known[k] = is_known_pose(k, pose);", "r->poses_known[k] = true;", "record", "known"),
    (
        "        r->poses_kept[k]++;\n",
        "        r->poses_kept[k]++;\n        r->opened = false;\n",
        "look",
        "nothing else changes",
    ),
    ("pose_due(r, i) < wake_ns", "true", "wake", "no pose is missed (R13)"),
    ("r->poses[place + n];", "r->poses[place];", "send", "the newest pose is sent first"),
    ("r->pose_sent_ns[i] = r->now_ns;", "", "send", "the instant is kept"),
    ("decide(r, retraces[i].task, NAMED(RETRACE), -1);", "", "send", "the pose is sent"),
    ("if (retraces[i].task == task)", "if (true)", "begin", "a starting task has sent"),
    ("age_ns = now_ns - since_ns;", "age_ns = t_ns - since_ns;", "set_back", "ages are unchanged"),
    ("r->pose_sent_ns[i] = NEVER;\n    for", "r->pose_sent_ns[i] = 0;\n    for", "forget", "sent"),
    ("(int)retraces[i].task == task", "true", "retraced", "other tasks have none"),
)


@pytest.mark.parametrize(("old", "new", "name", "expected"), [*QUICK_FAULTS, *deep(FAULTS)])
def test_a_mutant_is_refuted(
    prover: Prover, queries: VerificationQueries, old: str, new: str, name: str, expected: str
) -> None:
    found = proofs_of_reactor(prover, queries, old, new, f"reactor_poses_{name}")
    assert any(expected in reason for reason in refuted(found)), found.outcomes


@pytest.mark.parametrize("member", ["poses[5]", "poses_sent[0][2]"])
def test_a_clock_that_changes_a_pose_is_refuted(
    prover: Prover, queries: VerificationQueries, member: str
) -> None:
    old = "    r->now_ns = t_ns;\n    return true;"
    new = f"    r->now_ns = t_ns;\n    r->{member} = 0.5;\n    return true;"
    found = proofs_of_reactor(prover, queries, old, new, "reactor_set_clock")
    assert "nothing else changes" in refuted(found)
