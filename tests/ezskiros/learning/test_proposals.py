"""Proposals: made where places make a difference, and right once their words are filled in."""

from __future__ import annotations

from pathlib import Path

import pytest

from dslkit.source import SourceFile, Span
from ezskiros.learning.learn import learn
from ezskiros.learning.lessons import Lessons
from ezskiros.learning.proposals import differences, proposals
from ezskiros.learning.runs import read_runs
from ezskiros.learning.scene import Map
from ezskiros.locations import Location
from support import command_line
from support.learning import (
    LOCATIONS,
    RAMP,
    SHELF,
    active,
    header,
    learnt,
    put_depot,
    refill,
    write,
)

HEAD = """
skills "skills.json";
input pose = topic /odom : nav_msgs/Odometry .pose.pose timeout 0.2 sec;
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.2 sec;
action walk { limit /cmd_vel : geometry_msgs/Twist { linear.x in [-0.3, 0.5] m/s; } ramp 1 m/s^2; }
motion base {
    position : pose;
    speed : speed;
    brake : 0.8 m/s^2;
    acceleration : 0.5 m/s^2;
    fastest : 1.5 m/s;
    latency : 0.1 sec;
}
"""


def lessons(folder: Path, *stations: tuple[str, bool]) -> Lessons:
    """The lessons of one run to each station; in some a rule became active."""
    runs = []
    for number, (station, is_tripped) in enumerate(stations):
        at = 20.0 * number
        verdicts = [header(at - 1, at + 11), *(active(at + 2, at + 5) if is_tripped else [])]
        runs.append((refill(at, station), verdicts))
    return learnt(folder, *runs)


def test_places_make_a_difference_if_it_is_always_the_same_ones(tmp_path: Path) -> None:
    found = lessons(tmp_path, (RAMP, True), (RAMP, False), (RAMP, True), (SHELF, False))
    (difference,) = differences(found)
    assert (difference.parameter, difference.tripped, difference.free) == (
        "Target",
        [RAMP],
        [SHELF],
    )


@pytest.mark.parametrize(
    "stations",
    [
        [(RAMP, True), (SHELF, False)],
        [(RAMP, True), (RAMP, True)],
        [(RAMP, True), (SHELF, True), (RAMP, False)],
        [(RAMP, True), (RAMP, True), ("nowhere", False)],
        [(RAMP, True), (RAMP, True), ("nowhere", True), (SHELF, False)],
    ],
    ids=["one run", "no other place", "at all places", "free without a place", "also elsewhere"],
)
def test_there_is_no_difference_else(stations: list[tuple[str, bool]], tmp_path: Path) -> None:
    assert list(differences(lessons(tmp_path, *stations))) == []


def location(iri: str, *types: str) -> Location:
    corners = ((0.0, 0.0),)
    return Location(iri, "", types, "map", corners, Span(SourceFile("lab.turtle", ""), 0, 0))


def test_the_class_is_one_that_only_the_tripped_places_have(tmp_path: Path) -> None:
    found = lessons(tmp_path, (RAMP, True), (RAMP, True), (SHELF, False))
    known = Map({RAMP: location(RAMP, "t:A", "t:Steep"), SHELF: location(SHELF, "t:A")})
    rule, _ = proposals(found, known)
    assert "distance(POSE, t:Steep)" in rule
    assert "CLASS" not in rule
    same = Map({iri: location(iri, "t:A") for iri in (RAMP, SHELF)})
    rule, _ = proposals(found, same)
    assert "distance(POSE, CLASS)" in rule
    assert f"Declare a new CLASS in the ontology, and give it to `{RAMP}`" in rule


def test_a_place_that_is_nowhere_is_reported(tmp_path: Path) -> None:
    found = lessons(tmp_path, (RAMP, True), (RAMP, True), (SHELF, False))
    rule, _ = proposals(found, Map())
    assert f"// Add the location of `{RAMP}` to the scene." in rule.splitlines()


def test_evidence_stays_in_its_comment(tmp_path: Path) -> None:
    """A cause with line ends and control characters would become rules, or move the cursor."""
    found = []
    for number, (station, text) in enumerate(
        [(RAMP, "a\nrule x\x1b[2J"), (RAMP, "b"), (SHELF, "")]
    ):
        at = 20.0 * number
        verdicts = [header(at - 1, at + 11), *(active(at + 2, at + 5) if text else [])]
        for each in verdicts[1:]:
            each["cause"] = {"text": text}
        found.append(write(tmp_path / f"trace_{number}.jsonl", refill(at, station)))
        found.append(write(tmp_path / f"verdicts_{number}.jsonl", verdicts))
    runs, _ = read_runs(found)
    for text in proposals(learn(runs, LOCATIONS), Map()):
        assert "\x1b" not in text
        assert not any(line.startswith("rule x") for line in text.splitlines())


def test_a_rule_that_is_filled_in_is_proved(tmp_path: Path) -> None:
    """With the scene of the page that tells users how to learn."""
    text = proposed(tmp_path)[0]
    words = {"POSE": "pose", "MOTION": "base", "SPEED": "0.5 m/s", "ACTION": "walk"}
    rule = "\n".join(each for each in text.splitlines() if not each.startswith("//"))
    for word, meant in words.items():
        rule = rule.replace(word, meant)
    (tmp_path / "ahead.ross").write_text(HEAD + rule, encoding="utf-8")
    done = command_line.run("rossmarie", "check", "--thorough", "ahead.ross", folder=tmp_path)
    assert done.returncode == 0, done.stdout
    assert "note[ROSS722]" in done.stdout


def test_a_pre_condition_that_is_filled_in_is_right(tmp_path: Path) -> None:
    text = proposed(tmp_path)[1].splitlines()[-1].replace("PROPERTY", "IsLevel")
    skills = (tmp_path / "charging.py").read_text("utf-8")
    first = "        self.pre_conditions += Robot.at(Start)\n"
    (tmp_path / "charging.py").write_text(
        skills.replace(first, f"{first}        {text}\n", 1), encoding="utf-8"
    )
    with (tmp_path / "depot.ttl").open("a", encoding="utf-8") as file:
        file.write(
            "depot:IsLevel a owl:DatatypeProperty ; rdfs:domain skiros:Location ;\n"
            "    rdfs:range xsd:boolean .\n"
        )
    done = command_line.run(
        "ezskiros", "check", "charging.py", "--ontology", "depot.ttl", folder=tmp_path
    )
    assert done.returncode == 0, done.stdout


def proposed(folder: Path) -> list[str]:
    """The proposals for the depot, whose skills are exported with its scene."""
    put_depot(folder)
    ontology = ("--ontology", "depot.ttl")
    out = ("-o", "skills.json")
    done = command_line.run(
        "ezskiros", "export", "charging.py", "depot.turtle", *ontology, *out, folder=folder
    )
    assert done.returncode == 0, done.stdout
    runs = [(RAMP, True), (RAMP, True), (SHELF, False)]
    lessons(folder, *runs)
    files = sorted(each.name for each in folder.glob("*_?.jsonl"))
    done = command_line.run(
        "ezskiros", "learn", *files, "--scene", "depot.turtle", *ontology, folder=folder
    )
    assert done.returncode == 0, done.stdout
    texts = done.stdout.partition("\nProposals\n\n")[2]
    return texts.strip().split("\n\n")
