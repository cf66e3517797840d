"""Implementations that cannot be translated because a skill cannot. Each skill is reported once,
with all consequences.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from dslkit.diagnostics import Diagnostic, Template, listed, remarked
from dslkit.source import Span
from ezskiros.migrate import implementation_errors
from ezskiros.migrate.skills import SkillId


@dataclass(frozen=True)
class Follower:
    """An implementation that stays unchanged because of a skill or another class, with the finding
    at its place. If the cause is in none of the files, it has no `path`; consequences with the same
    `reason` are reported once.
    """

    name: str
    skill: str
    path: str
    finding: Diagnostic
    reason: str = ""


@dataclass(frozen=True)
class LeftSkill:
    """An unchanged description or other class: its place, and its findings."""

    span: Span
    codes: Sequence[str]
    is_skill: bool = True


def follows(template: Template) -> bool:
    """Say whether a finding is only that a skill or a base is not translated."""
    return is_about_base(template) or isinstance(template, _FOLLOWING)


def is_about_base(template: Template) -> bool:
    """Say whether a finding is that another class is not translated or is missing."""
    return isinstance(template, implementation_errors.OtherBase) and bool(template.base)


def is_about_skill(template: Template) -> bool:
    """Say whether a finding is that the skill of an implementation is not translated."""
    return isinstance(template, implementation_errors.UnusableSkill)


_FOLLOWING = (
    implementation_errors.UnusableSkill,
    implementation_errors.UnusableChild,
)


def consequences(
    followers: Iterable[Follower], left: Mapping[SkillId, LeftSkill]
) -> list[Diagnostic]:
    """The findings for the implementations that stay unchanged as a consequence."""
    groups: dict[tuple[str, str, str], list[Follower]] = {}
    for each in followers:
        # A missing skill is reported as missing, at the first place that needs it.
        why = "" if (each.path, each.skill) in left else each.reason or each.finding.title
        groups.setdefault((each.path if not why else "", each.skill, why), []).append(each)
    return [
        _missing(group) if why else _left(skill, group, left[path, skill])
        for (path, skill, why), group in groups.items()
    ]


def _left(skill: str, group: Sequence[Follower], left: LeftSkill) -> Diagnostic:
    names = list(dict.fromkeys(each.name for each in group))
    followers, are = listed(names), "is" if len(names) == 1 else "are"
    codes = " and ".join(dict.fromkeys(left.codes))
    if left.is_skill:
        with_skill = implementation_errors.LeftWith(
            skill=skill, followers=followers, are=are, codes=codes
        )
        return with_skill.at(left.span)
    together = implementation_errors.LeftTogether(
        other=skill, followers=followers, are=are, codes=codes
    )
    return together.at(left.span)


def _missing(group: Sequence[Follower]) -> Diagnostic:
    first = group[0].finding
    others = [each for each in dict.fromkeys(each.name for each in group) if each != group[0].name]
    if not others:
        return first
    are = "is" if len(others) == 1 else "are"
    note = implementation_errors.LeftToo(names=listed(others), are=are)
    return remarked(first, note)
