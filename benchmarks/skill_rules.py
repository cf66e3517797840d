"""Rules that depend on the running skill, and the loop around their generated C."""

from __future__ import annotations

import json
from pathlib import Path

from rossmarie.ir import Machine

SKILLS = {
    "format": "ezskiros/skills",
    "version": 1,
    "digest": "0" * 64,
    "sources": [],
    "context": {
        "topic": "/skill_context",
        "type": "skill_context_msgs/SkillContext",
        "period": 0.1,
    },
    "classes": [],
    "properties": [],
    "skills": [
        {"name": "Drive", "parents": [], "parameters": [],
         "conditions": {"pre": [], "hold": [], "post": []}, "trees": [], "permits": [], "uses": [],
         "place": None},
    ],
}  # fmt: skip
CONTEXT_EVERY = 10
"""The number of samples for each message that reports the running skills."""

OF_SKILLS = {
    "plain": "if speed > 0.5 then { react; }",
    "scope": "if speed > 0.5 while doing Drive then { react; }",
    "exemption": "if speed > 0.5 then { react; } "
    "unless doing Drive then if speed > 0.9 then { react; }",
}
"""The same rule without a scope, with a scope, and with an exemption."""

SKILL_HARNESS = """
#include <stdlib.h>
#include "{name}_monitor.h"

void skilled(size_t n, const int64_t *t, const double *speed, const uint8_t *drives,
             uint64_t *active)
{{
    static {name}_monitor m;
    if ({name}_init(&m, NULL, NULL))
        abort();
    (void)drives;
    *active = 0;
    for (size_t i = 0; i < n; i++) {{
        {tell}
        {name}_update_reading(&m, t[i], speed[i]);
        *active += {name}_is_active(&m, 0);
    }}
}}
"""


def of_skills(rule: str) -> str:
    """The rules file with a rule about a speed and the running skill."""
    return (
        'skills "skills.json";\naction react;\n'
        f"input speed = topic /reading : bench_msgs/Sample .speed;\nrule r: {rule};\n"
    )


def _reported_context(compiled: Machine) -> str:
    """The lines that report the running skills; none if no rule needs them."""
    flags = ["drives[i]"] * sum(slot.path != ("speed",) for slot in compiled.slots)
    if not flags:
        return ""
    call = f"{compiled.name}_update_skill_context(&m, t[i], {', '.join(flags)});"
    return f"if (i % {CONTEXT_EVERY} == 0)\n            {call}"


def write_skills(folder: Path) -> None:
    """Write the skills file that these rules name."""
    (folder / "skills.json").write_text(json.dumps(SKILLS), encoding="utf-8")


def skill_harness(compiled: Machine) -> str:
    """A speed with each sample, and the skill context ten times a second if a rule needs it."""
    return SKILL_HARNESS.format(name=compiled.name, tell=_reported_context(compiled))
