"""Reports that go into a safety file: what is read, and what is refused."""

from __future__ import annotations

import contextlib
import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rossmarie.report.safety.errors import EvidenceError
from rossmarie.report.safety.evidence import EvidenceKind, Hashed, parse_evidence

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
    ],
)  # fmt: skip
def test_what_is_wrong_with_a_report_is_said(change: dict[str, Any], reason: str) -> None:
    assert refusal(json.dumps({**GOOD, **change}).encode()) == reason


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
