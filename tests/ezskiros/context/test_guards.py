"""Guards files, what is known of their rules, and `ezskiros run --guards` without ROS."""

from __future__ import annotations

import json
import re
from pathlib import Path
from types import SimpleNamespace as Message
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dslkit.diagnostics import Diagnostic
from ezskiros.catalog import CATALOG
from ezskiros.context.guards import (
    PATIENCE,
    ActiveRules,
    Guards,
    of_other_skills,
    read_guards,
)
from ezskiros.context.guards_ros import is_connected, signs
from ezskiros.export import Export, read_export
from support import command_line, expectations
from support.engine import Clock
from support.exports import export
from support.markdown import blocks

RIGHT: dict[str, Any] = {
    "format": "crosscheck/guards",
    "version": 1,
    "digest": "5a" * 32,
    "node": "robot_safety",
    "topic": "robot_safety/state",
    "type": "robot_safety/State",
    "rules": ["stop", "slow", "other"],
    "guards": {"Drive": ["stop", "slow"], "Wait": [], "Push": ["slow"]},
}
UNKNOWN = "the active rules are unknown"
SKILLS = """
from ezskiros import SkillDescription

class Drive(SkillDescription):
    def description(self):
        pass

class drive(Drive.SkillBase):
    def execute(self):
        return self.success("there")
"""


def guards(folder: Path) -> Guards:
    path = folder / "guards.json"
    path.write_text(json.dumps(RIGHT))
    found = read_guards(path)
    assert isinstance(found, Guards)
    return found


def state(*active: str, exempted: tuple[str, ...] = (), is_open: bool = True) -> Message:
    return Message(active=list(active), exempted=list(exempted), open=is_open)


# --- files ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("change", "why"),
    [
        ({"format": "ezskiros/skills"}, "its `format` is not `crosscheck/guards`"),
        ({"version": True}, "its `version` is not 1"),
        ({"version": 2}, "its `version` is not 1"),
        ({"digest": "5A" * 32}, "its `digest`"),
        ({"node": "../x"}, "its `node`"),
        ({"topic": "/absolute"}, "its `topic`"),
        ({"type": "os.path"}, "its `type`"),
        ({"type": None}, "its `type`"),
        ({"rules": "stop"}, "its `rules` are not a list of names"),
        ({"rules": [1]}, "its `rules` are not a list of names"),
        ({"guards": []}, "its `guards` is not an object"),
        ({"guards": {"Drive": "stop"}}, "the rules of `Drive` are not names"),
        (
            {"guards": {"Drive": ["stop", "nothing"]}},
            "`Drive` waits for `nothing`, which is not in `rules`",
        ),
        ({"guards": {"Drive": [[]]}}, "the rules of `Drive` are not names"),
    ],
    ids=str,
)
def test_a_file_that_is_wrong_is_refused(
    tmp_path: Path, change: dict[str, object], why: str
) -> None:
    path = tmp_path / "guards.json"
    path.write_text(json.dumps({**RIGHT, **change}, indent=1))
    found = read_guards(path)
    assert isinstance(found, Diagnostic)
    assert found.code == "EZS872"
    assert why in str(found.primary.text)
    (key,) = change
    assert found.primary.span.text in ('"', "{"), key


@pytest.mark.parametrize("text", ["", "{", "[" * 100_000, "NaN", "[]", "3", '"x"', "\ufeff{}"])
def test_what_is_no_object_of_json_is_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "guards.json"
    path.write_text(text)
    found = read_guards(path)
    assert isinstance(found, Diagnostic)
    assert found.code == "EZS872"


def test_bytes_that_are_no_text_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "guards.json"
    path.write_bytes(b"\xff\xfe{")
    found = read_guards(path)
    assert isinstance(found, Diagnostic)
    assert "is not UTF-8" in str(found.primary.text)


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text(),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
    max_leaves=5,
)


@given(key=st.sampled_from(sorted(RIGHT)), value=JSON)
def test_nothing_that_is_wrong_breaks_the_reader(
    tmp_path_factory: pytest.TempPathFactory, key: str, value: object
) -> None:
    path = tmp_path_factory.mktemp("guards") / "guards.json"
    path.write_text(json.dumps({**RIGHT, key: value}))
    assert isinstance(read_guards(path), Guards | Diagnostic)


# --- what is known of the rules -------------------------------------------------------------------


def test_a_skill_waits_for_its_own_rules_only(tmp_path: Path) -> None:
    rules = ActiveRules(guards(tmp_path), Clock())
    skills = ("Drive", "Push", "Wait", "Other")

    def waits(*active: str, **more: Any) -> list[str | None]:
        rules.hear_state(state(*active, **more))
        return [rules.reason_to_wait(each) for each in skills]

    slow = "rule `slow` is active"
    assert waits() == [None] * 4
    assert waits("other") == [None] * 4
    assert waits("slow") == [slow, slow, None, None]
    assert waits("slow", "stop") == ["rules `stop` and `slow` are active", slow, None, None]
    assert waits("slow", "stop", exempted=("stop",)) == [slow, slow, None, None]
    closed = "`robot_safety` does not pass commands yet"
    assert waits(is_open=False) == [closed, closed, None, None]


def test_what_has_a_guard_waits_while_nobody_knows(tmp_path: Path) -> None:
    clock = Clock()
    rules = ActiveRules(guards(tmp_path), clock)

    def is_known() -> bool:
        assert rules.reason_to_wait("Wait") is None
        reason = rules.reason_to_wait("Drive")
        assert reason in (None, UNKNOWN)
        return reason is None

    assert not is_known()
    rules.hear_sign()
    assert not is_known(), "a sign tells nothing of the rules"
    rules.hear_state(state())
    assert is_known()
    clock.wait(PATIENCE)
    assert is_known()
    clock.wait(0.01)
    assert not is_known()
    rules.hear_sign()
    assert is_known(), "the node was there all the time, and would have told of a change"
    clock.wait(0.01)
    rules.lose(clock())
    rules.hear_sign()
    assert not is_known(), "another node may be there now"
    clock.wait(0.01)
    rules.hear_state(state())
    assert is_known()
    rules.lose(clock() - 0.01)
    assert is_known(), "it was stale before it reported this"


def test_a_node_of_other_rules_is_not_trusted(tmp_path: Path) -> None:
    rules = ActiveRules(guards(tmp_path), Clock())
    rules.hear_state(state("\x1b[31mnew" + "w" * 10**6))
    reason = rules.reason_to_wait("Drive")
    assert reason is not None
    assert reason.startswith("`robot_safety` has other rules than the guards")
    assert "\x1b" not in reason
    assert len(reason) < 300
    rules.hear_state(state(*map(str, range(10_001))))
    assert rules.reason_to_wait("Drive") == UNKNOWN


def test_only_the_node_of_the_rules_gives_a_sign(tmp_path: Path) -> None:
    clock = Clock()
    rules = ActiveRules(guards(tmp_path), clock)
    rules.hear_state(state())
    hear = signs(rules, "/robot1/robot_safety")
    clock.wait(PATIENCE + 1)
    hear(Message(status=[Message(hardware_id="robot2/robot_safety")]))
    hear(Message(status=[]))
    assert rules.reason_to_wait("Drive") == UNKNOWN
    hear(Message(status=[Message(hardware_id="x"), Message(hardware_id="robot1/robot_safety")]))
    assert rules.reason_to_wait("Drive") is None


def test_a_publisher_that_was_killed_is_no_connection() -> None:
    def subscriber(*connections: object) -> Message:
        return Message(impl=Message(connections=list(connections)))

    assert not is_connected(subscriber())
    assert not is_connected(subscriber(Message(socket=None)))
    assert is_connected(subscriber(Message(socket=None), Message(socket=3)))
    assert not is_connected(Message(impl=None))


# --- the command ----------------------------------------------------------------------------------


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    folder = tmp_path / "own"
    folder.mkdir()
    (folder / "skills.py").write_text(SKILLS)
    export(folder / "skills.py", out=folder / "skills.json")
    (folder / "guards.json").write_text(json.dumps(RIGHT))
    return folder


def ran(folder: Path, *words: str) -> tuple[int, str]:
    done = command_line.run("ezskiros", "run", "Drive", "skills.py", *words, folder=folder)
    assert "Traceback" not in done.stdout + done.stderr
    assert "drive(Running)" not in done.stdout
    return done.returncode, done.stdout + done.stderr


def test_nothing_runs_that_could_not_wait(folder: Path) -> None:
    code, text = ran(folder, "--guards", "guards.json")
    assert code == 2
    assert "nothing was run, because no rule can be received: " in text
    code, text = ran(folder, "--guards", "missing.json")
    assert (code, text) == (2, "ezskiros: cannot read missing.json: no such file or directory\n")
    code, text = ran(folder, "--guards", "guards.json", "--simulate")
    assert code == 2
    assert "leave out --simulate" in text
    (folder / "guards.json").write_text("{")
    code, text = ran(folder, "--guards", "guards.json")
    assert code == 2
    assert "error[EZS872]" in text


def test_nothing_runs_with_the_guards_of_other_skills(folder: Path) -> None:
    code, text = ran(folder, "--guards", "guards.json", "--context", "skills.json")
    assert code == 2
    assert "error[EZS873]" in text
    digest = json.loads((folder / "skills.json").read_text())["digest"]
    (folder / "guards.json").write_text(json.dumps({**RIGHT, "digest": digest}))
    code, text = ran(folder, "--guards", "guards.json", "--context", "skills.json")
    assert code == 2
    assert "nothing was run, because no rule can be received: " in text


# --- pages ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("code", ["EZS872", "EZS873"])
def test_the_example_of_a_page_is_refused(tmp_path: Path, folder: Path, code: str) -> None:
    (example,) = (
        each for each in blocks(CATALOG.page(code)) if each.heading == "Example" and each.name
    )
    path = tmp_path / "guards.json"
    lines = (each for each in example.text.splitlines(True) if not each.startswith("#"))
    path.write_text(re.sub("DIGEST", "5a" * 32, "".join(lines)))
    read = read_guards(path)
    skills = read_export(folder / "skills.json")
    assert isinstance(skills, Export)
    found = of_other_skills(read, skills) if isinstance(read, Guards) else read
    assert isinstance(found, Diagnostic)
    assert expectations.compare(example.text, [found], "#") == []
