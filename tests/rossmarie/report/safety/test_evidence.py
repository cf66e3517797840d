"""Reports that go into a safety file: what is read, and what is refused."""

from __future__ import annotations

import contextlib
import json
import math
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rossmarie.report.safety.errors import EvidenceError
from rossmarie.report.safety.evidence import (
    AnsweredQuery,
    EvidenceKind,
    Hashed,
    evidence_text,
    parse_evidence,
)
from rossmarie.report.spare import Spare

GOOD: dict[str, Any] = {
    "format": "rossmarie-verification",
    "version": 1,
    "tools": {"cbmc": "6.6.0"},
    "sources": [{"path": "rules.ross", "sha256": "AB"}],
    "bound": "3 events",
    "results": [
        {"name": "no overflow", "status": "proved"},
        {"name": "termination", "status": "undecided", "detail": "out of time"},
    ],
}

SPARE = {"name": "limit", "unit": "deg", "value": 10, "same": [8.5, None], "as_often": [8, None]}


def parse(whole: object) -> Any:
    content = json.dumps(whole).encode()
    return parse_evidence(content, EvidenceKind.VERIFICATION, Path("out/v.json"))


def refusal(content: bytes) -> str:
    with pytest.raises(EvidenceError) as caught:
        parse_evidence(content, EvidenceKind.VERIFICATION, Path("v.json"))
    assert caught.value.diagnostic.code == "ROSS781"
    return caught.value.diagnostic.title.split(": ", 1)[1]


def test_a_report_is_read() -> None:
    found = parse(GOOD)
    assert found.path == "v.json"
    assert found.tools == (("cbmc", "6.6.0"),)
    assert [each.name for each in found.open_results] == ["termination"]
    assert found.missing([Hashed("rules.ross", "ab")]) == ()
    assert found.missing([Hashed("rules.ross", "cd")]) == ("rules.ross",)


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"format": "rossmarie-coverage"}, "its `format` is not `rossmarie-verification`"),
        ({"version": 2}, "its `version` is not 1"),
        ({"tools": []}, "a member is not of the kind that it should be"),
        ({"tools": {"cbmc": 6}}, "6 stands where a string should"),
        ({"sources": [{"path": "rules.ross"}]}, "it has no `sha256`"),
        ({"results": [{"name": "x", "status": "fine"}]},
         "`fine` is none of proved, refuted, undecided, not proved"),
        ({"margins": {"name": "x"}}, "a member is not of the kind that it should be"),
        ({"margins": [{**SPARE, "unit": 1}]},
         "a margin has something else where a string should be"),
        ({"margins": [{**SPARE, "value": True}]},
         "a margin has something else where a number should be"),
        ({"margins": [{**SPARE, "same": [math.nan, 1]}]},
         "a margin has something else where a number should be"),
        ({"margins": [{**SPARE, "as_often": [1]}]}, "a margin has no two ends"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_a_report_is_said(change: dict[str, Any], reason: str) -> None:
    assert refusal(json.dumps({**GOOD, **change}).encode()) == reason


words = st.text(max_size=8)
numbers = st.floats(allow_nan=False, allow_infinity=False)
ranges = st.tuples(*[st.none() | numbers] * 2)
margins = st.lists(st.builds(Spare, words, words, numbers, ranges, ranges), max_size=3)
hashes = st.lists(st.builds(Hashed, words, words), max_size=3)


@given(
    kind=st.sampled_from(EvidenceKind),
    tools=st.dictionaries(words, words, max_size=3),
    sources=hashes,
    outputs=hashes,
    bound=words,
    spares=margins,
    data=st.data(),
)
def test_what_is_written_is_read_again(
    kind: EvidenceKind,
    tools: dict[str, str],
    sources: list[Hashed],
    outputs: list[Hashed],
    bound: str,
    spares: list[Spare],
    data: st.DataObject,
) -> None:
    statuses = st.sampled_from(kind.statuses)
    results = data.draw(st.lists(st.builds(AnsweredQuery, words, statuses, words), max_size=3))
    text = evidence_text(
        kind,
        tools=tools,
        sources=sources,
        outputs=outputs,
        bound=bound,
        results=results,
        margins=spares,
    )
    found = parse_evidence(text.encode(), kind, Path("v.json"))
    assert dict(found.tools) == tools
    assert (found.sources, found.outputs) == (tuple(sources), tuple(outputs))
    assert (found.bound, found.results) == (bound, tuple(results))
    assert found.margins == tuple(spares)


def test_what_a_report_is_about_beside_the_rules_is_known() -> None:
    drive = Hashed.of("drive.csv", b"time")
    text = evidence_text(
        EvidenceKind.COVERAGE,
        tools={},
        sources=[Hashed("rules.ross", "ab"), drive],
        bound="",
        results=[],
    )
    found = parse_evidence(text.encode(), EvidenceKind.COVERAGE, Path("c.json"))
    assert found.others([Hashed("rules.ross", "ab")]) == (drive,)


def test_what_is_no_json_is_refused() -> None:
    assert refusal(b"<html>") == "line 1: expecting value"
    assert refusal(b"\xff\xfe{") == "it is not text in UTF-8"
    assert refusal(b"[]") == "it holds no object"
    assert refusal(b"[" * 100_000) == "a member is not of the kind that it should be"


json_values = st.recursive(
    st.none() | st.booleans() | st.floats() | st.text(max_size=5),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(st.sampled_from(sorted(GOOD)) | st.text(max_size=3), inner, max_size=4)
    ),
)


@given(st.dictionaries(st.sampled_from(sorted(GOOD)), json_values))
def test_any_other_object_is_read_or_refused(change: dict[str, Any]) -> None:
    content = json.dumps({**GOOD, **change}).encode()
    with contextlib.suppress(EvidenceError):
        parse_evidence(content, EvidenceKind.VERIFICATION, Path("v.json"))
