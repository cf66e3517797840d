"""Skills files: what they say, and what is wrong with those that cannot be used."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dslkit.source import SourceFile
from rossmarie.skills import (
    LARGEST_FILE,
    Control,
    SourcePlace,
    UnreadableSkills,
    changed_source,
    parse_skills,
    read_text,
    span_at,
)
from support.depth import examples
from support.rule_skills import DIGEST, FILE, content

Change = Callable[[dict[str, Any]], None]


def parsed(found: object) -> object:
    return parse_skills(SourceFile("skills.json", json.dumps(found)))


def problem_of(change: Change) -> str:
    found = content()
    change(found)
    with pytest.raises(UnreadableSkills) as error:
        parsed(found)
    return error.value.problem


def test_all_that_rules_ask_for_is_read() -> None:
    found = parse_skills(read_text(FILE))
    assert (found.digest, found.topic, found.period_ns) == (DIGEST, "/skill_context", 100_000_000)
    assert found.skills["Drive"].parents == ("Move",)
    assert found.skills["Push"].parameters["Object"].type == "skiros.Product"
    assert [str(each) for each in found.skills["Push"].permits] == [
        "contact with skiros.Product up to 30 N"
    ]
    assert found.classes["skiros.Glass"].parents == ("skiros.Fragile",)
    assert found.properties["skiros.Weight"].unit == "kg"


def test_trees_have_their_limits() -> None:
    found = content()
    controls = [timed("timeout", seconds=2.5), timed("timeout", seconds="Speed"), timed("retry")]
    found["skills"][0]["trees"] = [*controls, timed("retry", tries=3)]
    found["skills"][0]["parameters"][0]["default"] = "0.5"
    skill = parse_skills(SourceFile("skills.json", json.dumps(found))).skills["Move"]
    nodes = [each for tree in skill.trees for each in tree.children]
    limits = [each.limit for each in nodes if isinstance(each, Control)]
    assert limits == [2.5, "Speed", None, 3.0]
    assert skill.parameters["Speed"].default == 0.5
    assert [each.is_retried for each in skill.children] == [False, False, True, True]


def put(*path: str | int, value: object) -> Change:
    """A change that puts a value at the end of a way."""

    def change(found: Any) -> None:
        for step in path[:-1]:
            found = found[step]
        found[path[-1]] = value

    return change


def without(*path: str | int) -> Change:
    """A change that removes a member."""

    def change(found: Any) -> None:
        for step in path[:-1]:
            found = found[step]
        del found[path[-1]]

    return change


STEP = {"skill": "Move", "arguments": {"Speed": "Speed"}, "place": None}


def timed(control: str, **limit: object) -> dict[str, Any]:
    """A tree of one skill below a node with a limit."""
    node = {"control": control, **limit, "children": [STEP], "place": None}
    return {"children": [node], "place": None}


def twice(key: str) -> Change:
    """A change that repeats the first element of a list."""

    def change(found: dict[str, Any]) -> None:
        found[key].append(found[key][0])

    return change


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        (put("format", value="other"), "`format` is `other`, and none of ezskiros/skills"),
        (put("version", value=2), "`version` is 2, and this program reads version 1"),
        (put("version", value=True), "`version` is a boolean, not a whole number"),
        (put("digest", value="5B" * 32), "`digest` is not 64 hexadecimal digits"),
        (
            put("skills", 2, "parameters", 1, "default", value=2),
            "`skills[2].parameters[1].default` is a number, not a text",
        ),
        (
            put("skills", 0, "trees", value=[timed("timeout", seconds=0)]),
            "`skills[0].trees[0].children[0].seconds` is not above 0",
        ),
        (
            put("skills", 0, "trees", value=[timed("timeout", seconds="Time")]),
            "`skills[0].trees[0].children[0].seconds` is no parameter of the skill that is a "
            "number",
        ),
        (
            put("skills", 1, "trees", value=[timed("timeout", seconds="Target")]),
            "`skills[1].trees[0].children[0].seconds` is no parameter of the skill that is a "
            "number",
        ),
        (
            put("skills", 0, "trees", value=[timed("timeout", seconds=[3])]),
            "`skills[0].trees[0].children[0].seconds` is a list, not a number",
        ),
        (
            put("skills", 0, "trees", value=[timed("retry", tries=None)]),
            "`skills[0].trees[0].children[0].tries` is null, not a number",
        ),
        (
            put("skills", 0, "trees", value=[{"children": [{**STEP, "arguments": []}]}]),
            "`skills[0].trees[0].children[0].arguments` is a list, not an object",
        ),
        (
            put("skills", 0, "trees", value=[{"children": [{**STEP, "arguments": {"Speed": 2}}]}]),
            "`skills[0].trees[0].children[0].arguments.Speed` is a number, not a text",
        ),
        (without("digest"), "`digest` is missing"),
        (put("classes", value=None), "`classes` is null, not a list"),
        (
            put("skills", 2, "parameters", value="none"),
            "`skills[2].parameters` is a text, not a list",
        ),
        (
            without("skills", 2, "parameters", 0, "type"),
            "`skills[2].parameters[0].type` is missing",
        ),
        (
            put("skills", 2, "parameters", 0, "kind", value="any"),
            "`skills[2].parameters[0].kind` is `any`, and none of given, inferred, optional",
        ),
        (
            put("skills", 2, "parameters", 0, "is_output", value=0),
            "`skills[2].parameters[0].is_output` is a number, not a boolean",
        ),
        (
            put("skills", 0, "name", value="Push"),
            "`skills[2].name` is `Push`, which stands in the list before",
        ),
        (twice("classes"), "`classes[14].name` is `sumo.Object`, which stands in the list before"),
        (
            twice("properties"),
            "`properties[3].name` is `skiros.Weight`, which stands in the list before",
        ),
        (put("skills", 0, "parents", value=["Drive"]), "`skills` derive `Move` from itself"),
        (put("skills", 0, "name", value="no name"), "`skills[0].name` is not a name"),
        (put("skills", 0, "name", value=""), "`skills[0].name` is empty"),
        (put("classes", 0, "name", value=3), "`classes[0].name` is a number, not a text"),
        (put("context", value=[]), "`context` is a list, not an object"),
        (
            put("context", "period", value=0),
            "`context.period` is 0, and no time up to 3600 seconds",
        ),
        (put("context", "period", value=10**400), "`context.period` is not a finite number"),
        (put("context", "period", value="0.1"), "`context.period` is a text, not a number"),
        (
            put("context", "topic", value="skills"),
            "`context.topic` is not a topic such as /skill_context",
        ),
        (
            put("context", "type", value="std_msgs/Bool"),
            "`context.type` is `std_msgs/Bool`, and none of skill_context_msgs/SkillContext",
        ),
        (
            put("skills", 2, "parameters", 0, "type", value="skiros.Zzz"),
            "`skills[2].parameters[0].type` is `skiros.Zzz`, which is no class of the file",
        ),
        (
            put("skills", 2, "permits", 0, "kind", value="harm"),
            "`skills[2].permits[0].kind` is `harm`, and none of contact, closeness, speed, force",
        ),
        (
            put("skills", 2, "permits", 0, "with", 0, "parameter", value="Zzz"),
            "`skills[2].permits[0].with[0].parameter` is no parameter of the skill",
        ),
        (
            put("sources", value=[{"path": "/etc/passwd", "sha256": DIGEST}]),
            "`sources[0].path` is not relative to the folder of the file",
        ),
        (
            put("sources", value=[{"path": "a.py", "sha256": "x"}]),
            "`sources[0].sha256` is not 64 hexadecimal digits",
        ),
        (
            put("skills", 0, "place", value={"path": "a.py", "line": 0}),
            "`skills[0].place.line` is below 1",
        ),
    ],
)
def test_what_is_wrong_is_reported_by_its_place(change: Change, problem: str) -> None:
    assert problem_of(change) == problem


@pytest.mark.parametrize(
    ("text", "problem", "offset"),
    [
        ("", "it is not JSON: expecting value", 0),
        ('{"format": }', "it is not JSON: expecting value", 11),
        ("[" * 100_000, "its brackets are nested too deeply", None),
        ("[1" + "0" * 5000 + "]", "it has a number with too many digits", None),
        ("NaN", "it contains `NaN`, which is not a finite number", None),
        ('{"a": -Infinity}', "it contains `-Infinity`, which is not a finite number", None),
        ('{"a": 1, "a": 2}', "an object has the key `a` twice", None),
        ("[]", "the file is a list, not an object", None),
    ],
)
def test_a_text_that_is_no_such_file(text: str, problem: str, offset: int | None) -> None:
    with pytest.raises(UnreadableSkills) as error:
        parse_skills(SourceFile("skills.json", text))
    assert (error.value.problem, error.value.offset) == (problem, offset)


_JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=4),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=4), inner),
    max_leaves=6,
)


@st.composite
def damaged(draw: st.DrawFn) -> object:
    """The contents of the file with other values at one place, or without it."""
    found: Any = content()
    node = found
    while True:
        places = list(node) if isinstance(node, dict) else list(range(len(node)))
        if not places:
            return found
        place = draw(st.sampled_from(places))
        if isinstance(node[place], dict | list) and node[place] and draw(st.booleans()):
            node = node[place]
            continue
        if draw(st.booleans()):
            del node[place]
        else:
            node[place] = draw(_JSON)
        return found


@settings(max_examples=examples(2))
@given(damaged())
def test_a_damaged_file_is_read_or_refused(found: object) -> None:
    try:
        read = parsed(found)
    except UnreadableSkills as error:
        read = error.problem
    assert read


@settings(max_examples=examples(2))
@given(st.binary(max_size=200))
def test_any_bytes_are_refused(found: bytes) -> None:
    text = found.decode("utf-8", errors="replace")
    with pytest.raises(UnreadableSkills):
        parse_skills(SourceFile("skills.json", text))


def refused(path: Path) -> str:
    with pytest.raises(UnreadableSkills) as error:
        read_text(path)
    return error.value.problem


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    ends = "its name, or that of the file it links to, does not end in .json"
    assert refused(tmp_path / "nowhere.json") == "there is no such file"
    assert refused(tmp_path / "skills.txt") == ends
    secret = tmp_path / "secret.txt"
    secret.write_text("{}", encoding="utf-8")
    link = tmp_path / "link.json"
    link.symlink_to(secret)
    assert refused(link) == ends
    folder = tmp_path / "folder.json"
    folder.mkdir()
    assert refused(folder) == "is a directory"
    latin = tmp_path / "latin.json"
    latin.write_bytes(b"\xe4")
    assert refused(latin) == "it is not UTF-8 text"
    large = tmp_path / "large.json"
    with large.open("wb") as file:
        os.truncate(file.fileno(), LARGEST_FILE + 1)
    assert refused(large) == "it is larger than 16 MiB"
    assert refused(tmp_path / "a\0b.json")


def with_source(tmp_path: Path, text: str) -> Path:
    """A skills file from one module."""
    module = tmp_path / "push.py"
    module.write_text(text, encoding="utf-8")
    found = content()
    digest = hashlib.sha256(text.encode()).hexdigest()
    found["sources"] = [{"path": "push.py", "sha256": digest}]
    path = tmp_path / "skills.json"
    path.write_text(json.dumps(found), encoding="utf-8")
    return path


def test_a_source_that_changes_is_noticed(tmp_path: Path) -> None:
    skills = parse_skills(read_text(with_source(tmp_path, "a = 1\n")))
    assert changed_source(skills, tmp_path) is None
    (tmp_path / "push.py").write_text("a = 2\n", encoding="utf-8")
    changed = changed_source(skills, tmp_path)
    assert changed is not None
    assert (changed.path, changed.problem) == ("push.py", "has changed since")
    (tmp_path / "push.py").unlink()
    missing = changed_source(skills, tmp_path)
    assert missing is not None
    assert missing.problem == "is not there"
    (tmp_path / "push.py").mkdir()
    assert changed_source(skills, tmp_path) == missing


def test_places_in_modules_are_shown(tmp_path: Path) -> None:
    (tmp_path / "push.py").write_text("class Push:\n    pass\n", encoding="utf-8")
    span = span_at(SourcePlace("push.py", 1, 7, 1, 11), tmp_path)
    assert span is not None
    assert span.text == "Push"
    for place in (
        SourcePlace("push.py", 9, 1, 9, 2),
        SourcePlace("push.py", 2, 1, 1, 1),
        SourcePlace("push.py", 1, 1, 3, 99),
        SourcePlace("nowhere.py", 1, 1, 1, 1),
    ):
        assert span_at(place, tmp_path) is None


def test_no_text_is_shown_of_other_files(tmp_path: Path) -> None:
    (tmp_path / "secret.txt").write_text("secret\n", encoding="utf-8")
    (tmp_path / "link.py").symlink_to(tmp_path / "secret.txt")
    assert span_at(SourcePlace("secret.txt", 1, 1, 1, 7), tmp_path) is None
    assert span_at(SourcePlace("link.py", 1, 1, 1, 7), tmp_path) is None
