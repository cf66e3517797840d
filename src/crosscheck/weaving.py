"""Guards in tasks: the rules that each primitive waits for before it starts.

If a primitive starts while a rule takes away its resources, it can only fail. `ezskiros run` reads
the file (docs/reference/crosscheck.md).
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from crosscheck.asking import rests_on_skills
from crosscheck.robot import Robot
from rossmarie.ir.taking import takings
from rossmarie.naming import node_name

FORMAT = "crosscheck/guards"
VERSION = 1


@dataclass(frozen=True)
class Woven:
    """The guards of skills by skill name, and the node that reports their rules. `rules` has all
    rules of this node. `left_out` has the rules that query skills, with the skills from which they
    take a resource.
    """

    digest: str
    node: str
    rules: Sequence[str]
    guards: Mapping[str, Sequence[str]]
    left_out: Mapping[str, Sequence[str]]


def woven(robot: Robot) -> Woven:
    """The guards of a robot. A rule that queries skills could wait for a skill that waits for the
    rule, so no skill waits for such a rule.
    """
    rules = robot.machine.rules
    asking = {rule.name for rule in rules if rests_on_skills(robot.machine, rule)}
    guards: dict[str, list[str]] = {}
    left_out: dict[str, list[str]] = {}
    for skill in robot.skills.skills.values():
        found = [rules[each.rule].name for each in takings(robot.machine, skill.uses)]
        taking = dict.fromkeys(found)
        waits = [rule for rule in taking if rule not in asking]
        if waits or not skill.children:
            guards[skill.name] = waits
        for rule in taking:
            if rule in asking:
                left_out.setdefault(rule, []).append(skill.name)
    return Woven(
        digest=robot.skills.digest,
        node=node_name(robot.machine),
        rules=[rule.name for rule in rules],
        guards=guards,
        left_out=left_out,
    )


def text_of(found: Woven) -> str:
    """The text of the file, with a final newline."""
    head = {
        "format": FORMAT,
        "version": VERSION,
        "digest": found.digest,
        "node": found.node,
        "topic": f"{found.node}/state",
        "type": f"{found.node}/State",
        "rules": list(found.rules),
    }
    parts = [f"  {json.dumps(key)}: {json.dumps(value)}" for key, value in head.items()]
    lines = [
        f"    {json.dumps(skill)}: {json.dumps(list(rules))}"
        for skill, rules in found.guards.items()
    ]
    guards = "{\n" + ",\n".join(lines) + "\n  }" if lines else "{}"
    return "{\n" + ",\n".join([*parts, f'  "guards": {guards}']) + "\n}\n"
