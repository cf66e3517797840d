"""The processors do what SkiROS2's do; where that is a defect, only if they are asked to.

`../shared/data/skiros2_processor_traces.json` has traces of the real SkiROS2; those in this file
are a few of each kind, for where that file is not.
"""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from ezskiros.skills.nodes import Flow
from support.parts import TRACES, require
from support.scripted import processor, traced, traces
from support.shared import SKIROS2_TRACES

ROOT = Path(__file__).parents[3]
PAGE = ROOT / "docs" / "reference" / "engine-and-skiros2.md"

AS_SKIROS2 = {
    "Serial S,S": ["a^aSa$b^bSb$=S"],
    "Serial RRS,RS": [
        *("a^aR=R", "aR=R", "aSa$b^bR=R", "a^aRb!b$=R", "aR=R", "aSa$b^bR=R", "a^aRb!b$=R"),
        "aR=R",
    ],
    "Serial S,F,S": ["a^aSa$b^bFb$=F"],
    "SerialStar S,RRS,S": ["a^aSa$b^bR=R", "bR=R", "bSb$c^cSc$=S"],
    "SerialStar RF,S": ["a^aR=R", "aFa$=F"],
    "Selector F,RS": ["a^aFa$b^bR=R", "a^aFa$bSb$=S"],
    "Selector F,F": ["a^aFa$b^bFb$=F"],
    "SelectorStar F,RS": ["a^aFa$b^bR=R", "bSb$=S"],
    "ParallelFf RS,RF,R": ["a^aRb^bRc^cR=R", "aSa$bFb$c!c$=F"],
    "ParallelFf F,S": ["a^aFa$=F"],
    "ParallelFs RS,S": ["a^aRb^bSb$a!a$=S"],
    "ParallelFs R,F": ["a^aRb^bFb$a!a$=F"],
    "NoFail(SerialStar) S,RF": ["a^aSa$b^bR=R", "bFb$=S"],
    "NoFail(Serial) S,RS": ["a^aSa$b^bR=R", "a^aSa$bSb$=S"],
    "Serial>ParallelFs RS,S,RS": ["a^aRb^bSb$a!a$c^cR=R", "a^aRb^bSb$a!a$cSc$=S"],
}
PARALLEL = {
    "ParallelFf S,RS": (["a^aSa$b^bR=R", "a^aSa$bSb$=S"], ["a^aSa$b^bR=R", "bSb$=S"]),
    "ParallelFf RS,S": (["a^aRb^bSb$=R", "aSa$b^bSb$=S"], ["a^aRb^bSb$=R", "aSa$=S"]),
    "SerialStar>ParallelFf": (
        ["a^aSa$b^bR=R", "a^aSa$bSb$c^cR=R", "cSc$=S"],
        ["a^aSa$b^bR=R", "bSb$c^cR=R", "cSc$=S"],
    ),
}


@pytest.mark.parametrize("compatible", [False, True])
def test_as_in_skiros2(compatible: bool) -> None:
    assert traces([*AS_SKIROS2], compatible=compatible) == AS_SKIROS2


def test_a_parallel_starts_children_that_have_succeeded_again_only_if_it_is_asked_to() -> None:
    theirs = {described: there for described, (there, _) in PARALLEL.items()}
    ours = {described: here for described, (_, here) in PARALLEL.items()}
    assert traces([*PARALLEL], compatible=True) == theirs
    assert traces([*PARALLEL], compatible=False) == ours


@pytest.mark.parametrize("flow", Flow)
def test_only_there_a_processor_without_children_runs_forever(flow: Flow) -> None:
    assert traced(processor(flow), compatible=True) == ["=R"] * 8
    assert traced(processor(flow), compatible=False)[-1] in ("=S", "=F")


def test_a_parallel_that_starts_again_ticks_all() -> None:
    root = processor(Flow.SERIAL, processor(Flow.PARALLEL_FF))
    assert traced(root, compatible=False) == ["=S"]


@pytest.fixture(scope="module")
def recorded() -> dict[str, list[str]]:
    require(TRACES)
    found: dict[str, list[str]] = json.loads(SKIROS2_TRACES.read_text(encoding="utf-8"))
    return found


def test_all_recorded_traces_are_reproduced(recorded: dict[str, list[str]]) -> None:
    assert len(recorded) == 130
    assert traces([*recorded], compatible=True) == recorded


def test_the_page_lists_the_traces_that_are_others_by_default(
    recorded: dict[str, list[str]],
) -> None:
    here = traces([*recorded], compatible=False)
    others = {each for each in recorded if here[each] != recorded[each]}
    listed = re.findall(
        r"^\| `([^`|]+)` \| `([^`]+)` \| `([^`]+)` \|$", PAGE.read_text(), re.MULTILINE
    )
    assert {name for name, _, _ in listed} == others
    for name, theirs, ours in listed:
        assert (theirs.split(" "), ours.split(" ")) == (recorded[name], here[name])
