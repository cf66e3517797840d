"""Reports of exemptions: the rule that is not applied, the skill, and what it permits."""

from __future__ import annotations

import re
from html import unescape
from pathlib import Path

from rossmarie import ir
from rossmarie.driver.report import safety_file
from rossmarie.report.safety import render_safety_file
from support.rule_skills import HEAD, Robot, running

PERMITTED = "contact with skiros.Product up to 30 N"
RULES = """
rule contact: if force > 5 N then { stop; }
    unless doing Push(Object: Fragile) then { slow; }
    unless doing Drive;
rule crash: always if force > 50 N then { stop; };
"""


def test_a_verdict_says_which_rule_is_not_applied_and_why() -> None:
    robot = Robot(RULES)
    robot.tell(0, force=9)
    events = robot.tell(1, running("Push", Object="skiros.Glass"))
    cleared, activated = [ir.event_line(robot.machine, event) for event in events]
    assert cleared.startswith("contact cleared: doing Push(Object: Fragile), true since")
    start = "contact_doing_Push activated: contact is not applied: doing Push(Object: Fragile), "
    assert activated.startswith(f"{start}which permits {PERMITTED}; force = 9 N, > 5 N, true since")
    _, ended = [ir.event_line(robot.machine, event) for event in robot.tell(2)]
    assert ended.startswith("contact_doing_Push cleared: doing Push(Object: Fragile), false since")


def test_a_skill_that_permits_nothing_is_reported_without_a_permission() -> None:
    robot = Robot(RULES)
    (event,) = [
        event
        for event in robot.tell(0, running("Drive", Target="skiros.Shelf"), force=9)
        if isinstance(event, ir.Verdict)
    ]
    line = ir.event_line(robot.machine, event)
    start = "contact_doing_Drive activated: contact is not applied: doing Drive; "
    assert line.startswith(start)


def test_an_exemption_that_lacks_the_context_is_not_reported_as_one() -> None:
    robot = Robot("""
    input push = topic /push : std_msgs/Float32 in N timeout 1 sec;
    rule contact: if push > 5 N then { stop; } unless doing Push then { slow; };
    """)
    events = (*robot.wait(0), *robot.wait(2))
    lines = {ir.event_line(robot.machine, event) for event in events}
    stale = "activated: input push (/push) has never been received"
    context = "; input skill_context (/skill_context) has never been received"
    assert lines == {f"contact {stale}{context}", f"contact_doing_Push {stale}"}


def test_the_safety_file_lists_exemptions_with_their_permissions(tmp_path: Path) -> None:
    path = tmp_path / "rules.ross"
    path.write_text(HEAD + RULES)
    content, _ = safety_file(path, tool="rossmarie", date="2026-01-01")
    page = render_safety_file(content)
    (section,) = re.findall(r'<section id="exemptions">.*?</section>', page, re.DOTALL)
    cells = [
        [unescape(re.sub("<[^>]+>", "", cell)).strip() for cell in re.findall("<td.*?</td>", row)]
        for row in re.findall("<tr>.*?</tr>", section, re.DOTALL)
    ]
    assert cells[1:] == [
        ["contact", "doing Push(Object: Fragile)", PERMITTED, "contact_doing_Push"],
        ["contact", "doing Drive", "nothing", "contact_doing_Drive"],
    ]
    assert "The rule always applies: neither a skill nor an operator can exempt it." in page
    said = "The rule is part of an exemption: it applies instead of contact while doing Drive."
    assert said in page
