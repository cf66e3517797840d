"""The runs of one timeline: a replay, or two replays to compare, and their rules files."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import PurePath

from dslkit.source import SourceFile
from rossmarie.ir import Rule
from rossmarie.report.model import Replay
from rossmarie.report.spans import Summary, summarize


@dataclass(frozen=True)
class NamedReplay:
    """A replay and its name beside the other replay; the name is empty if there is no other."""

    replay: Replay
    label: str


def runs_of(replay: Replay, compared: Replay | None = None) -> tuple[NamedReplay, ...]:
    """The runs of one or two replays. Two runs are named after their difference: their recordings,
    or else their rules files.
    """
    if compared is None:
        return (NamedReplay(replay, ""),)
    pair = (replay, compared)
    paths = [each.recording for each in pair]
    if paths[0] == paths[1]:
        paths = [each.rules_file for each in pair]
    names = [PurePath(path).name for path in paths]
    labels = paths if names[0] == names[1] else names
    return tuple(NamedReplay(each, label) for each, label in zip(pair, labels, strict=True))


def sources_of(runs: Sequence[NamedReplay]) -> tuple[SourceFile, ...]:
    """The files with the rules of all runs, each version once."""
    files = (rule.span.file for run in runs for rule in run.replay.machine.rules)
    return tuple({(file.path, file.text): file for file in files}.values())


def rule_line(rule: Rule, sources: Sequence[SourceFile]) -> tuple[int, int]:
    """The place of the file of a rule among the sources, and the line of the rule, from 1."""
    file = rule.span.file
    versions = [(each.path, each.text) for each in sources]
    return versions.index((file.path, file.text)), rule.head.begin.line


def compared_rules(runs: Sequence[NamedReplay]) -> list[tuple[str, list[Summary | None]]]:
    """The summary of each rule in each run; None if a run does not have the rule."""
    found = [{each.rule: each for each in summarize(run.replay)} for run in runs]
    names = dict.fromkeys(name for summaries in found for name in summaries)
    return [(name, [summaries.get(name) for summaries in found]) for name in names]
