"""Rules that know which skills run: exemptions hold as long as somebody says so, and no longer."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from rossmarie.driver import compile_file
from support.live import LIMIT, Ears, Process, Ros, Wanted, until

ROOT = Path(__file__).parents[2]
RULES = ROOT / "tests" / "fixtures" / "skillful" / "skillful.ross"
DIGEST = f"c0ffee{'0' * 58}"
TIMEOUT = 1.0
"""Seconds after which the rules give up a context."""
SOON = 0.2
"""Seconds in which a node that is not held up says what it has noticed."""

CLEARED, ACTIVATED_WITHOUT_INPUT = 0, 2
STALE = {"contact", "heavy", "next_fragile"}
"""The rules that are active while nobody knows which skills run, and something is touched."""

Skill = tuple[str, list[tuple[str, str, float]]]
"""A skill, and for each parameter the class and the weight of the individual (kg)."""

GLASS: Skill = ("Push", [("Object", "skiros.Glass", 0.3)])
HEAVY_GLASS: Skill = ("Push", [("Object", "skiros.Glass", 7.0)])
BOX: Skill = ("Push", [("Object", "skiros.Product", 0.3)])

Begin = Callable[[str], Ears]


def needs(generation: str) -> Sequence[Wanted]:
    packages = ROOT / "ros" / generation
    tools = packages / "skill_context_tools"
    return [packages / "skill_context_msgs", compile_file(RULES).machine, tools]


pytestmark = [pytest.mark.builds(by=needs)]


@pytest.fixture
def begin(ros: Ros, programs: Sequence[Path], started: list[Process]) -> Begin:
    """Starts a robot and its node, in a namespace. It feels a force, and no skill runs."""

    def begin(namespace: str) -> Ears:
        robot = ros.ears(namespace, script="skillful.py")
        started.append(robot)
        robot.set(digest=DIGEST, force=20.0)
        started.append(ros.begin(programs[1], {"patience": LIMIT}, namespace=namespace))
        return robot

    return begin


def active(robot: Ears, namespace: str = "") -> set[str]:
    return set((robot.last(f"{namespace}/skillful_safety/state") or {}).get("active", ()))


def becomes(robot: Ears, rules: set[str], namespace: str = "") -> None:
    until(lambda: active(robot, namespace) == rules, f"{rules}, not {active(robot, namespace)}")


def passes(robot: Ears, speed: float, namespace: str = "") -> None:
    until(lambda: robot.last(f"{namespace}/cmd_vel") == speed, f"{speed} m/s passes")


def test_a_rule_gives_way_to_a_skill_with_its_individuals(begin: Begin) -> None:
    robot = begin("")
    becomes(robot, {"contact"})
    passes(robot, 0.0)
    robot.set(skills=[GLASS])
    becomes(robot, {"contact_doing_Push"})
    passes(robot, 0.2)
    robot.set(skills=[BOX])
    becomes(robot, {"contact"})
    passes(robot, 0.0)
    robot.set(skills=[["Drive", []], HEAVY_GLASS])
    becomes(robot, {"contact_doing_Push", "heavy"})
    passes(robot, 0.1)
    robot.set(skills=[GLASS], force=0.0)
    becomes(robot, set())
    passes(robot, 1.0)


def test_a_rule_holds_before_a_skill_starts(begin: Begin) -> None:
    robot = begin("")
    robot.set(force=0.0, skills=[BOX])
    becomes(robot, set())
    passes(robot, 1.0)
    robot.set(ahead=[GLASS])
    becomes(robot, {"next_fragile"})
    passes(robot, 0.1)
    robot.set(ahead=[["Drive", []], BOX])
    becomes(robot, set())
    robot.set(ahead=[["Push", []]])  # nobody knows yet what will be pushed
    becomes(robot, {"next_fragile"})
    robot.set(ahead=[])
    becomes(robot, set())
    robot.set(ahead=None)
    becomes(robot, {"next_fragile"})


def test_what_is_not_known_exempts_from_nothing(begin: Begin) -> None:
    robot = begin("")

    def exempts(unknown: dict[str, object]) -> None:
        robot.set(digest=DIGEST, skills=[GLASS])
        becomes(robot, {"contact_doing_Push"})
        robot.set(**unknown)
        until(lambda: "contact" in active(robot), f"{unknown}")
        passes(robot, 0.0)

    exempts({"digest": f"c0ffee{'1' * 58}"})
    exempts({"digest": ""})
    exempts({"skills": [GLASS] * 65})
    exempts({"skills": [("Push", GLASS[1] * 65)]})


def test_silence_ends_an_exemption_within_the_timeout(begin: Begin) -> None:
    robot = begin("")

    def silence() -> float:
        """Seconds from the last context to the verdict that it is stale."""
        robot.set(skills=[GLASS], is_talking=True)
        becomes(robot, {"contact_doing_Push"})
        robot.ask(forget="/skillful_safety/verdicts")
        robot.set(is_talking=False)
        becomes(robot, STALE)
        passes(robot, 0.0)
        reported = robot.ask(heard="/skillful_safety/verdicts")
        changes = {verdict["rule"]: verdict["change"] for _, verdict in reported}
        stale = dict.fromkeys(STALE, ACTIVATED_WITHOUT_INPUT)
        assert changes == {"contact_doing_Push": CLEARED, **stale}
        last, _ = robot.ask(last="context")
        return float(max(at for at, _ in reported) - last)

    shortest = [silence()]

    def is_in_time() -> bool:  # a busy machine holds up the node, or what hears it
        shortest.append(min(shortest[-1], silence()))
        return shortest[-1] < TIMEOUT + SOON

    until(is_in_time, f"{shortest[-1]} s")
    assert shortest[-1] >= TIMEOUT - SOON


def test_a_robot_knows_nothing_of_the_skills_of_another(begin: Begin) -> None:
    one, other = begin("/robot1"), begin("/robot2")
    one.set(skills=[GLASS])
    becomes(one, {"contact_doing_Push"}, "/robot1")
    becomes(other, {"contact"}, "/robot2")
    other.set(digest="", is_talking=False)
    passes(one, 0.2, "/robot1")
    passes(other, 0.0, "/robot2")
    other.set(digest=DIGEST, is_talking=True, skills=[GLASS])
    one.set(is_talking=False)
    becomes(one, STALE, "/robot1")
    becomes(other, {"contact_doing_Push"}, "/robot2")


def test_nobody_can_exempt_a_rule_that_holds_always(begin: Begin) -> None:
    robot = begin("")
    until(lambda: bool(robot.last("/skillful_safety/state")), "the node is there")
    asked = {"rule": "hard", "reason": "test"}
    refused = robot.ask(exempt=asked)
    assert not refused["success"]
    assert refused["message"] == "rule hard has `always`: it cannot be exempted"
    assert robot.ask(exempt={**asked, "rule": "contact"})["success"]


def test_contact_is_allowed_while_a_skill_permits_it(
    begin: Begin, ros: Ros, programs: Sequence[Path], started: list[Process]
) -> None:
    robot = begin("")
    started.append(ros.begin(programs[2] / "contact_allowed", {"digest": DIGEST}))

    def allows(is_allowed: bool) -> None:
        until(lambda: robot.last("/contact_allowed") == is_allowed, f"{is_allowed}")

    allows(False)
    robot.set(skills=[GLASS], permits=["speed"])
    robot.ask(forget="/contact_allowed")
    until(lambda: robot.count("/contact_allowed") > 3, "it says so again and again")
    assert set(robot.heard("/contact_allowed")) == {False}
    robot.set(permits=["speed", "contact"])
    allows(True)
    robot.set(skills=[])
    allows(False)
    robot.set(skills=[BOX])
    allows(True)
    robot.set(digest=f"c0ffee{'1' * 58}")
    allows(False)
    robot.set(digest=DIGEST)
    allows(True)
    robot.set(is_talking=False)
    allows(False)
