"""Skills that rules always stop go along with a goal that replans: rule S68."""

from __future__ import annotations

import itertools
import json
from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rossmarie.ir import reactions
from support.compiled import machine_of
from support.depth import examples
from support.rule_skills import Robot, ahead, content, running

ACTIONS = """
action halt { block /cmd_vel : geometry_msgs/Twist; }
action stand { scale /cmd_vel : geometry_msgs/Twist by 0 %; }
action half { scale /cmd_vel : geometry_msgs/Twist by 50 %; }
action slow { limit /cmd_vel : geometry_msgs/Twist { linear.x in [-0.1, 0.1] m/s; }; }
action back { publish /cmd_vel : geometry_msgs/Twist { linear.x = -0.1 m/s; } at 10 Hz; }
action nudge { publish /cmd_vel : geometry_msgs/Twist { linear.x = -0.1 m/s; }; }
action away { cancel /insert within 1 sec; }
action home { send actionlib/Test { goal = 1; } to /insert within 9 sec; }
action say { log info "it is so"; }
action ask { call /ask : std_srvs/Trigger within 1 sec; }
action lastly { call /ask : std_srvs/Trigger within 1 sec else halt; }
action anew { tree Insert(Object: "box") within 20 sec then replan; }
rule stuck: if force > 100 N then { anew; };
rule hard: if force > 50 N then { slow; };
"""
CORRIDOR, SCHOOL, CHARGER = "hall.Corridor", "hall.SchoolCorridor", "hall.Charger"
IN_CORRIDOR = ("Drive(Target=hall.Corridor)",)


def use(kind: str, name: str) -> dict[str, Any]:
    return {"kind": kind, "name": name, "type": None, "place": None}


def step(skill: str, **arguments: str | None) -> dict[str, Any]:
    return {"skill": skill, "arguments": arguments, "place": None}


def control(kind: str, *children: dict[str, Any]) -> dict[str, Any]:
    return {"control": kind, "children": list(children), "place": None}


def compound(name: str, *trees: dict[str, Any]) -> dict[str, Any]:
    """A skill with the parameters A and B, which are locations."""
    shape = {"kind": "given", "type": "skiros.Location", "is_output": False, "default": None}
    alternatives = [{"implementation": "it", "place": None, "children": [each]} for each in trees]
    return {
        "name": name,
        "parents": [],
        "parameters": [{"name": each, "key": each, **shape, "place": None} for each in "AB"],
        "conditions": {"pre": [], "hold": [], "post": []},
        "trees": alternatives,
        "permits": [],
        "uses": [],
        "place": None,
    }


def head(folder: Path, *compounds: dict[str, Any]) -> str:
    """The head of rules about skills that drive and insert, and about compounds of them."""
    found = content()
    for each in found["skills"]:
        each["uses"] = {
            "Drive": [use("topic", "/cmd_vel")],
            "Insert": [use("server", "/insert")],
        }.get(each["name"], [])
    found["skills"] += compounds
    file = folder / "skills.json"
    file.write_text(json.dumps(found), encoding="utf-8")
    force = "input force = topic /force : std_msgs/Float32 in N;"
    return f'skills "{file}" timeout 1 sec;\n{force}\n{ACTIONS}'


def without(rules: str) -> tuple[str, ...]:
    """The skills that goals of rules say."""
    found = [
        {each.path[0]: each.value for each in task.effect.assignments}["without"]
        for task in machine_of(rules).reactions.tasks
        if isinstance(task.effect, reactions.SendGoal) and task.effect.server == "/recovery"
    ]
    (reported,) = set(found)
    assert isinstance(reported, tuple)
    return tuple(map(str, reported))


@pytest.mark.parametrize(
    ("condition", "reported"),
    [
        ("doing Drive(Target: Corridor)", IN_CORRIDOR),
        ("(doing Drive(Target: Corridor))", IN_CORRIDOR),
        ("force > 5 N or doing Drive(Target: Corridor)", IN_CORRIDOR),
        ("ahead Drive(Target: Corridor) or doing Drive(Target: Corridor)", IN_CORRIDOR),
        ("zone.here", IN_CORRIDOR),
        ("zone.here or force > 5 N", IN_CORRIDOR),
        ("doing Drive or doing Drive(Target: Corridor)", ("Drive",)),
        (
            "doing Drive(Target: Charger) or doing Drive(Target: Corridor)",
            ("Drive(Target=hall.Charger)", *IN_CORRIDOR),
        ),
        ("doing Move", ("Drive",)),  # that derived from it commands what is taken
        ("doing Push", ()),  # it needs nothing of that
        ("ahead Drive(Target: Corridor)", ()),  # no more when it runs
        ("not doing Drive", ()),
        ("doing Drive for 1 sec", ()),
        ("doing Drive and force > 5 N", ()),
        ("doing Drive and doing Drive(Target: Corridor)", ()),
        ("force > 5 N", ()),
    ],
)
def test_s68_a_query_that_alone_makes_a_condition_true(
    tmp_path: Path, condition: str, reported: tuple[str, ...]
) -> None:
    zone = "entity zone { here : doing Drive(Target: Corridor); }"
    rules = f"{head(tmp_path)}{zone}\nrule it: if {condition} then {{ halt; }};"
    assert without(rules) == reported


@pytest.mark.parametrize(
    ("rule", "is_reported"),
    [
        ("if IT then { halt; } clear for 1 sec", True),
        ("if IT then { stand; }", True),
        ("if IT then { back; }", True),
        ("if IT then { say; halt; }", True),
        ("if IT then { say; also halt; }", True),
        ("if IT then { halt; anew; }", True),
        ("if IT then { half; }", False),
        ("if IT then { slow; }", False),
        ("if IT then { nudge; }", False),  # once: then the commands of the skill pass again
        ("if IT then { lastly; }", False),  # if the call fails
        ("if IT then { ask; halt; }", False),  # after the call
        ("if IT then { away; }", False),  # another server
        ("if IT while doing Insert then { halt; }", False),
        ("if IT unless stuck then { halt; }", False),
        ("if IT then { halt; } unless doing Insert then { slow; }", False),
    ],
)
def test_s68_what_is_taken_away_at_once_and_for_as_long(
    tmp_path: Path, rule: str, is_reported: bool
) -> None:
    rule = rule.replace("IT", "doing Drive(Target: Corridor)")
    found = without(f"{head(tmp_path)}rule it: {rule};")
    assert found == (IN_CORRIDOR if is_reported else ())


@pytest.mark.parametrize("action", ["away", "home"])
def test_s68_a_server_that_has_another_goal(tmp_path: Path, action: str) -> None:
    rule = f"rule it: if doing Insert(Object: Box) then {{ {action}; }};"
    with_namespace = rule.replace("Box", "skiros.Box")
    assert without(head(tmp_path) + with_namespace) == ("Insert(Object=skiros.Box)",)


def test_s68_only_a_goal_that_replans_says_it(tmp_path: Path) -> None:
    rules = head(tmp_path).replace("then replan", "then retry")
    machine = machine_of(rules + "rule it: if doing Drive then { halt; };")
    (goal,) = (
        each.effect
        for each in machine.reactions.tasks
        if isinstance(each.effect, reactions.SendGoal)
    )
    assert "without" not in {each.path[0] for each in goal.assignments}


DRIVE, PUSH = step("Drive", Target="A", Speed="0.3"), step("Push", Object="A")


@pytest.mark.parametrize(
    ("trees", "reported"),
    [
        ([control("serial", PUSH, DRIVE)], ("Outer",)),
        ([control("selector", DRIVE, control("retry", DRIVE))], ("Outer",)),
        ([control("selector", DRIVE, PUSH)], ()),
        ([control("parallelfs", DRIVE, PUSH)], ()),
        ([control("nofail", DRIVE), PUSH], ()),
        ([DRIVE, PUSH], ()),
        ([PUSH], ()),
    ],
)
def test_s68_a_compound_needs_what_its_skills_need(
    tmp_path: Path, trees: list[dict[str, Any]], reported: tuple[str, ...]
) -> None:
    """Whichever way it takes: each tree is one."""
    rules = head(tmp_path, compound("Outer", *trees))
    assert without(f"{rules}rule it: if doing Outer then {{ halt; }};") == reported


# --- what it means -------------------------------------------------------------------------------

ATOMS = st.sampled_from(
    [
        "doing Drive(Target: Corridor)",
        "doing Drive(Target: SchoolCorridor)",
        "doing Drive",
        "doing Move",
        "doing Insert",
        "ahead Drive",
        "force > 5 N",
    ]
)
CONDITIONS = st.recursive(
    ATOMS,
    lambda inner: st.one_of(
        st.lists(inner, min_size=2, max_size=3).map(lambda them: f"({' or '.join(them)})"),
        st.lists(inner, min_size=2, max_size=2).map(lambda them: f"({' and '.join(them)})"),
        inner.map(lambda it: f"not ({it})"),
        inner.map(lambda it: f"(({it}) for 1 sec)"),
    ),
    max_leaves=5,
)
OTHERS = [running("Insert", Object="skiros.Box"), ahead("Drive"), running("Move")]


@given(st.data(), CONDITIONS)
@settings(max_examples=examples(1.0), deadline=None)
def test_s68_such_a_rule_is_active_whenever_the_skill_runs(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject, condition: str
) -> None:
    """The other running skills and the past have no influence."""
    rules = f"{head(tmp_path_factory.mktemp('rules'))}rule it: if {condition} then {{ halt; }};"
    reported = without(rules)
    if not reported:
        return
    robot = Robot("", machine_of(rules))
    for at in range(data.draw(st.integers(1, 4))):
        others = data.draw(st.lists(st.sampled_from(OTHERS), unique=True))
        kind = data.draw(st.sampled_from([CORRIDOR, SCHOOL, CHARGER, None]))
        drives = [] if kind is None else [running("Drive", Target=kind)]
        robot.tell(at / 2, *others, *drives, force=data.draw(st.sampled_from([0.0, 9.0])))
        stopped = {CORRIDOR: [CORRIDOR], SCHOOL: [SCHOOL, CORRIDOR], CHARGER: [CHARGER]}
        names = {"Drive", *(f"Drive(Target={each})" for each in stopped.get(kind or "", []))}
        if drives and names.intersection(reported):
            assert "it" in robot.active(), (condition, reported)


# --- compounds -----------------------------------------------------------------------------------

KINDS = (CORRIDOR, SCHOOL, CHARGER)
ALWAYS = "with anything"
STOPPED = {
    "Drive(Target: Corridor)": {CORRIDOR, SCHOOL},
    "Drive(Target: SchoolCorridor)": {SCHOOL},
    "Drive(Target: Charger)": {CHARGER},
    "Drive": {*KINDS, ALWAYS},
}
ALL_OF = ("serial", "serialstar", "parallelff", "retry", "timeout")
ONE_OF = ("selector", "selectorstar", "parallelfs")


def trees(*leaves: st.SearchStrategy[dict[str, Any]]) -> st.SearchStrategy[dict[str, Any]]:
    return st.recursive(
        st.one_of(*leaves),
        lambda inner: st.builds(
            lambda kind, below: control(
                kind, *(below[:1] if kind in ("retry", "timeout", "inverter") else below)
            ),
            st.sampled_from([*ALL_OF, *ONE_OF, "nofail", "inverter"]),
            st.lists(inner, min_size=1, max_size=3),
        ),
        max_leaves=5,
    )


GIVEN = st.sampled_from(["A", "B", "'A'", None])
DRIVES = GIVEN.map(lambda it: step("Drive", Target=it, Speed="0.3"))
PUSHES = st.just(step("Push", Object="A"))
INNERS = st.tuples(GIVEN, GIVEN).map(lambda them: step("Inner", A=them[0], B=them[1]))


@dataclass(frozen=True)
class Stopped:
    """The classes that `Drive` is stopped with, and the compounds that are stopped themselves."""

    kinds: Set[str]
    compounds: Set[str] = frozenset()


Library = Mapping[str, Sequence[Mapping[str, Any]]]


def may_succeed(
    node: Mapping[str, Any],
    library: Library,
    individuals: Mapping[str, str | None],
    stopped: Stopped,
) -> bool:
    """Say whether a tree can succeed if a skill that is stopped never does. Skills with individuals
    that nobody knows may succeed; so does a result that is turned round.
    """
    if node.get("skill") == "Drive":
        return not stopped.kinds & {ALWAYS, individuals.get(node["arguments"]["Target"] or "")}
    if "skill" in node:
        inner = {name: individuals.get(each or "") for name, each in node["arguments"].items()}
        return can_succeed(node["skill"], library, inner, stopped)
    results = [may_succeed(each, library, individuals, stopped) for each in node["children"]]
    if node["control"] in ALL_OF:
        return all(results)
    return node["control"] not in ONE_OF or any(results)


def can_succeed(
    skill: str, library: Library, individuals: Mapping[str, str | None], stopped: Stopped
) -> bool:
    below = library.get(skill, ())
    can = not below or any(may_succeed(each, library, individuals, stopped) for each in below)
    return can and skill not in stopped.compounds


@given(
    st.lists(trees(DRIVES, PUSHES), min_size=1, max_size=2),
    st.lists(trees(DRIVES, PUSHES, INNERS), min_size=1, max_size=2),
    st.lists(st.sampled_from([*STOPPED, "Inner", "Outer"]), unique=True, min_size=1, max_size=3),
)
@settings(max_examples=examples(1.0), deadline=None)
def test_s68_a_compound_that_cannot_do_without(
    tmp_path_factory: pytest.TempPathFactory,
    inner: list[dict[str, Any]],
    outer: list[dict[str, Any]],
    queries: list[str],
) -> None:
    """For all individuals: what is reported is what no outcome of the other skills makes
    succeed.
    """
    library = {"Inner": inner, "Outer": outer}
    rules = head(
        tmp_path_factory.mktemp("rules"), *(compound(name, *library[name]) for name in library)
    )
    for number, each in enumerate(queries):
        rules += f"rule it_{number}: if doing {each} then {{ halt; }};\n"
    reported = without(rules)
    always = Stopped({ALWAYS})
    stopped = Stopped(
        {kind for each in queries for kind in STOPPED.get(each, ())},
        {
            each
            for each in queries
            if each in library and not can_succeed(each, library, {}, always)
        },
    )
    for skill, (one, other) in itertools.product(library, itertools.product(KINDS, KINDS)):
        individuals = {"A": one, "B": other}
        can = can_succeed(skill, library, individuals, stopped)
        assert is_reported(skill, individuals, reported) is not can, (skill, one, other, reported)


def is_reported(skill: str, individuals: Mapping[str, str], reported: Sequence[str]) -> bool:
    above = {CORRIDOR: {CORRIDOR}, SCHOOL: {SCHOOL, CORRIDOR}, CHARGER: {CHARGER}}
    for each in reported:
        name, _, limits = each.partition("(")
        pairs = [pair.split("=") for pair in limits.strip(")").split(", ") if pair]
        if name == skill and all(kind in above[individuals[it]] for it, kind in pairs):
            return True
    return False
