"""Pages deny no feature that the programs have, and each denial in the table has a probe.

A page that says "not in this version" outlives the version. So such a sentence stands in `DENIALS`
with a probe that looks for the feature, and a page may not deny a name of the command line.
"""

from __future__ import annotations

import copy
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
import typer

import crosscheck.cli.main
import ezskiros.cli.main
import heron.cli.main
import rossmarie.cli.main
from rossmarie.cli.choices import TargetName
from rossmarie.syntax import words
from support import skills
from support.checking import findings
from support.policy_rules import guard_of
from support.rule_skills import put_skills

ROOT = Path(__file__).parents[2]
APPS = (rossmarie.cli.main.app, ezskiros.cli.main.app, crosscheck.cli.main.app, heron.cli.main.app)
PAGES = sorted(
    {*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md"), *ROOT.glob("src/*/catalog/pages/*.md")}
    - {*ROOT.glob("docs/decisions/*.md"), ROOT / "CHANGELOG.md"}
)
"""Pages about the present. Decisions and the change log describe the past as well."""

_OF_A_VERSION = re.compile(
    r"not (?:yet )?(?:in|part of) this version|in (?:a later|a future|the next) version"
    r"|not yet (?:supported|implemented|possible|available|written|generated|offered)"
    r"|\b(?:is|are) not (?:supported|implemented)\b|\bnot planned\b|\bnamed in verdicts only\b",
    re.IGNORECASE,
)
"""Forms of a denial that a new version makes false."""
_KINDS = r"(?:command|option|effect|target|subcommand)"
_OF_A_NAME = re.compile(
    rf"\bno {_KINDS} `(?P<after>[\w-]+)[^`]*`|\bno `(?P<inside>[\w-]+)[^`]*` {_KINDS}\b"
    rf"|`(?P<before>[\w-]+)[^`]*` (?:does not exist|is (?:no|not an?) {_KINDS})",
    re.IGNORECASE,
)
"""Forms of a denial that name a command, an option, an effect or a target."""


def command_names() -> set[str]:
    """The names of commands and options of all programs, and of effects and targets of rules."""
    found = {*words.EFFECT_WORDS, *(target.value for target in TargetName)}
    for app in APPS:
        for name, command in _commands(typer.main.get_command(app)):
            found.add(name)
            for parameter in command.params:
                found.update([*parameter.opts, *parameter.secondary_opts])
    return found


def _commands(app: Any) -> Iterator[tuple[str, Any]]:
    for name, command in app.commands.items():
        yield name, command
        if hasattr(command, "commands"):
            yield from _commands(command)


def sentences(page: str) -> list[str]:
    """The sentences of a page in Markdown, without its fenced blocks and comments."""
    prose = re.sub(r"^ *```.*?^ *```|<!--.*?-->", "\n\n", page, flags=re.MULTILINE | re.DOTALL)
    blocks = [" ".join(block.split()) for block in re.split(r"\n\s*\n|\n *[-*|] ", prose)]
    return [one for block in blocks for one in re.split(r"(?<=[.:;]) (?=[A-Z`*(])", block) if one]


def denied_of_this_version(page: str) -> list[str]:
    """The sentences that deny a feature for this version."""
    return [sentence for sentence in sentences(page) if _OF_A_VERSION.search(sentence)]


def denied_names(page: str) -> set[str]:
    """The names that a page denies."""
    found = [match.groupdict() for one in sentences(page) for match in _OF_A_NAME.finditer(one)]
    return {name for groups in found for name in groups.values() if name}


# --- denials with a probe ------------------------------------------------------------------------

STOP = "action stop;\n"
FORCE = "input force = topic /force : std_msgs/Float64 in N timeout 0.1 sec\n"
OUTPUT_WITH_DEFAULT = """\
from ezskiros import OUTPUT, SkillDescription


class Look(SkillDescription):
    def description(self, Found: OUTPUT[float] = 2.0): ...
"""


def rules_are_refused(code: str, text: str) -> Callable[[Path], bool]:
    """A probe: the check of these rules finds this error."""

    def probe(folder: Path) -> bool:
        put_skills(folder)
        rules = folder / "probe.ross"
        rules.write_text(text, encoding="utf-8")
        return code in {one.code for one in findings(rules)}

    return probe


def skill_is_refused(code: str, text: str) -> Callable[[Path], bool]:
    """A probe: the check of this skill finds this error."""

    def probe(folder: Path) -> bool:
        skill = folder / "probe.py"
        skill.write_text(text, encoding="utf-8")
        return code in {one.code for one in skills.findings([skill])}

    return probe


def no_word_is(*meant: str) -> Callable[[Path], bool]:
    """A probe: none of these is a word of the language."""
    known = {
        *words.ITEM_WORDS,
        *words.CONTEXTUAL_ITEM_WORDS,
        *words.EFFECT_WORDS,
        *words.MEMBER_WORDS,
        *words.PART_WORDS,
    }
    return lambda _: not known & {*meant}


def no_option_has(*parts: str) -> Callable[[Path], bool]:
    """A probe: no option of a command has one of these parts in its name."""
    return lambda _: (
        not [
            name
            for name in command_names()
            if name.startswith("--") and {*name.split("-")} & {*parts}
        ]
    )


def no_option_of_heron_run(option: str, *experiments: str) -> Callable[[Path], bool]:
    """A probe: `heron run EXPERIMENT` has no such option."""
    runs = typer.main.get_command(heron.cli.main.app).commands["run"].commands  # type: ignore[attr-defined]
    return lambda _: (
        not [name for name in experiments for each in runs[name].params if option in each.opts]
    )


def batches_are_not_copied(folder: Path) -> bool:
    """A probe: a batch of guards refuses to be copied."""
    batch = guard_of("python", folder).batch(2)
    with pytest.raises(TypeError, match="copied"):
        copy.copy(batch)
    return True


@dataclass(frozen=True)
class Denial:
    """A sentence of a page, by a pattern, and a probe: true if the feature is missing."""

    page: str
    pattern: str
    is_missing: Callable[[Path], bool]


DENIALS = (
    Denial(
        "docs/reference/language.md",
        r"`/\* \*/`",
        rules_are_refused("ROSS025", f"/* a comment */\n{STOP}"),
    ),
    Denial(
        "docs/reference/language.md",
        r"Strings cannot be used with `in`",
        rules_are_refused(
            "ROSS224",
            "input mode = topic /mode : std_msgs/String .data timeout 1 sec\n"
            f'{STOP}if mode in ["a", "b"] then {{ stop; }};\n',
        ),
    ),
    Denial(
        "docs/tutorial/one-robot.md",
        r"`always` allows no exemption",
        rules_are_refused(
            "ROSS426",
            f'skills "skills.json";\n{STOP}{FORCE}'
            "rule hard: always if force > 60 N then { stop; } "
            "unless doing Push then if force > 70 N then { stop; };\n",
        ),
    ),
    Denial(
        "docs/tutorial/first-skill.md",
        r"cannot have a default",
        skill_is_refused("EZS009", OUTPUT_WITH_DEFAULT),
    ),
    Denial(
        "docs/tutorial/first-rules.md",
        r"`10 deg` is a number, not a range",
        rules_are_refused(
            "ROSS203",
            "input imu = topic /imu/data : sensor_msgs/Imu .orientation timeout 0.2 sec\n"
            f"{STOP}if imu.pitch() not in 10 deg then {{ stop; }};\n",
        ),
    ),
    Denial(
        "docs/explanation/beside-nav2.md",
        r"no word for an outline",
        no_word_is("outline", "footprint", "approach"),
    ),
    Denial("docs/reference/limits.md", r"[Nn]o option raises", no_option_has("limit", "max")),
    Denial("docs/explanation/security.md", r"[Nn]o option raises", no_option_has("limit", "max")),
    Denial(
        "docs/how-to/run-the-experiments.md",
        r"Experiments II to IV",
        no_option_of_heron_run("--ros1", "place", "human", "contact"),
    ),
    Denial("docs/reference/python.md", r"batch cannot be copied", batches_are_not_copied),
)
"""Features that pages deny, each with a probe that tries the feature."""


@pytest.mark.parametrize("denial", DENIALS, ids=lambda denial: denial.pattern)
def test_a_denied_feature_is_missing(denial: Denial, tmp_path: Path) -> None:
    page = (ROOT / denial.page).read_text(encoding="utf-8")
    assert any(re.search(denial.pattern, sentence) for sentence in sentences(page)), denial.page
    assert denial.is_missing(tmp_path), f"{denial.page} denies a feature that is there"


def test_a_denial_of_this_version_has_a_probe() -> None:
    unknown = [
        f"{path.relative_to(ROOT)}: {sentence}"
        for path in PAGES
        for sentence in denied_of_this_version(path.read_text(encoding="utf-8"))
        if not any(
            ROOT / denial.page == path and re.search(denial.pattern, sentence) for denial in DENIALS
        )
    ]
    assert unknown == []


def test_no_page_denies_a_name_of_the_command_line() -> None:
    known = command_names()
    assert {"check", "--force", "limit", "ros2"} <= known
    denied = {
        path.relative_to(ROOT).as_posix(): names
        for path in PAGES
        if (names := denied_names(path.read_text(encoding="utf-8")) & known)
    }
    assert denied == {}


@pytest.mark.parametrize(
    "text",
    [
        "Not in this version: the part of the thesis that acts\non the robot. Good.",
        "Actions are named in verdicts only.",
        "- A filter is not yet\n  implemented.",
    ],
)
def test_denials_of_a_version_are_found(text: str) -> None:
    assert len(denied_of_this_version(text)) == 1


@pytest.mark.parametrize(
    "text",
    [
        "There is no command `graph`.",
        "It has no `graph` command.",
        "`graph RULES` does not exist.",
        "| a | `graph` is not a command |",
    ],
)
def test_denied_names_are_found(text: str) -> None:
    assert denied_names(text) == {"graph"}
    assert denied_names(f"```text\n{text}\n```\n") == set()
