"""Experiment VII: a robot plans with what earlier runs have taught."""

from __future__ import annotations

import hashlib
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from support.parts import MUJOCO, require

require(MUJOCO)

from dslkit.diagnostics import Diagnostic
from ezskiros.cli.main import app as ezskiros
from ezskiros.learning.knowledge import Knowledge, read_knowledge
from heron.cli.main import app, evaluate
from heron.experiments import BlockedEpisode, run_second
from heron.experiments.obstacles import OFTEN, troubled
from heron.experiments.second import TEACHING_SEEDS, knowledge_of, learned
from heron.rules import FOLDER as RULES
from heron.scene import PathsParameters
from heron.skills import FOLDER as SKILLS
from heron.tasks import TaskStatus
from heron.variants import ExperimentArm, Trouble
from rossmarie.cli.main import app as rossmarie

FREE_SEED = 1001
"""Nothing stands in the way, as in one of five runs: its episodes are short."""
ONTOLOGY, SCENE = SKILLS / "heron.ttl", SKILLS / "blocked.turtle"


@cache
def episode(arm: ExperimentArm) -> BlockedEpisode:
    """Each is run once for all tests."""
    return run_second(arm, Trouble.LASTING, FREE_SEED)


def goes_by_the_yard(found: BlockedEpisode) -> bool:
    return float(found.trace.columns["y"].min()) < PathsParameters().yard[1] / 2


def knowledge(trouble: Trouble) -> Knowledge:
    found = read_knowledge(knowledge_of(trouble))
    assert not isinstance(found, Diagnostic)
    return found


def test_without_knowledge_the_fewest_skills_lead_straight_on() -> None:
    found = episode(ExperimentArm.TREES)
    assert found.obstacles == ()
    assert found.outcome is TaskStatus.COMPLETED
    assert not goes_by_the_yard(found)
    assert [each.label for each in found.tree if each.depth == 0] == ["deliver"]


def test_with_knowledge_another_way_leads_to_the_goal() -> None:
    found, first = episode(ExperimentArm.LEARNED), episode(ExperimentArm.TREES)
    assert found.outcome is TaskStatus.COMPLETED
    assert goes_by_the_yard(found)
    assert found.measures.replanned == found.measures.activations == 0
    assert all(each.spans for each in found.tree), "its own tree is none of those that ran"
    assert found.measures.duration > 1.4 * first.measures.duration, "nothing was in its way"


@pytest.mark.parametrize("trouble", Trouble)
def test_the_next_plan_avoids_what_costs_time(
    trouble: Trouble, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(SKILLS)
    files = ["--ontology", ONTOLOGY, "--scene", SCENE, "--knowledge", knowledge_of(trouble)]
    command = ["plan", SKILLS, *files, "--goal", "(heron:at heron hall)"]
    found = CliRunner().invoke(ezskiros, [str(each) for each in command])
    assert found.exit_code == 0, found.output
    is_avoided = "heron:Place-5" in found.output
    assert is_avoided is (trouble is not Trouble.NONE)
    assert "expected to lose 0.0 s to rules, after 12 runs" in found.output


def test_a_rule_costs_time_on_the_way_straight_on_and_nowhere_else() -> None:
    assert [each for each in learned(Trouble.NONE) if each.lost_s] == []
    for trouble in (Trouble.LASTING, Trouble.PASSING):
        ends = {
            (each.skill, *(iri.partition("#")[2] for _, iri in each.places))
            for each in learned(trouble)
            if each.lost_s
        }
        assert ends == {
            ("Deliver", "Place-2", "Place-3", "Place-4"),
            ("Drive", "Place-3", "Place-4"),
        }


def test_no_run_that_taught_is_evaluated() -> None:
    assert evaluate.__defaults__ is not None
    assert min(TEACHING_SEEDS) >= evaluate.__defaults__[0]
    for trouble in Trouble:
        names = {each.path for each in knowledge(trouble).sources if "/" not in each.path}
        assert names == {f"{seed}.jsonl" for seed in TEACHING_SEEDS}


def test_trouble_differs_from_seed_to_seed() -> None:
    paths = PathsParameters()
    for trouble, name in ((Trouble.LASTING, "pallet"), (Trouble.PASSING, "trolley")):
        draws = [troubled(trouble, paths, np.random.default_rng(seed)) for seed in range(500)]
        assert sum(map(len, draws)) / 500 == pytest.approx(OFTEN, abs=0.05)
        assert {each.name for draw in draws for each in draw} == {name}
    assert troubled(Trouble.NONE, paths, np.random.default_rng(0)) == ()


@pytest.mark.deep
def test_a_run_that_taught_is_recorded_again(tmp_path: Path) -> None:
    """Its trace is the same, byte for byte; with what its rules found it can be learned from."""
    recording, trace, out = tmp_path / "100.mcap", tmp_path / "100.jsonl", tmp_path / "verdicts"
    what = ["record", "second", "--arm", "trees", "--variant", "passing", "--seed", "100"]
    files = ["--begin", "100000", "--out", recording, "--trace", trace]
    found = CliRunner().invoke(app, [str(each) for each in (*what, *files)])
    assert found.exit_code == 0, found.output
    (source,) = (e for e in knowledge(Trouble.PASSING).sources if e.path == trace.name)
    assert hashlib.sha256(trace.read_bytes()).hexdigest() == source.sha256
    replay = ["replay", RULES / "blocked_trees.ross", recording, "--out", out]
    found = CliRunner().invoke(rossmarie, [str(each) for each in replay])
    assert found.exit_code == 0, found.output
    files = [trace, out / "verdicts.jsonl", "--ontology", ONTOLOGY, "--scene", SCENE]
    found = CliRunner().invoke(ezskiros, [str(each) for each in ("learn", *files)])
    assert found.exit_code == 0, found.output
    assert "give_way_to_obstacle  Drive  Deliver" in found.output
