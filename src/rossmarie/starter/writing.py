"""The text of first rules."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from rossmarie.driver.formatting import format_text
from rossmarie.starter.numbers import GAPS, MOST_PERIODS, PERIODS, SHORTEST_S, plain, rounded_down
from rossmarie.starter.robot import ProposedRules, RobotTopics, WatchedTopic

_WIDTH = 100
_CLEAR_S = 1
_SHARED = (
    "No input reads {topic}, because the node of these rules speaks there, too. Let the drivers of"
    " the hardware publish on a topic of their own, such as /hardware/diagnostics."
)
_JOINT = "\N{WORD JOINER}"


@dataclass(frozen=True)
class SourceRecording:
    """The recording behind the rules. `part` is the part that was read; None for the whole
    recording. `shared` is a recorded topic on which the node of the rules also publishes; None if
    there is none.
    """

    name: str
    part: str | None
    shared: str | None


def write_rules(
    source: SourceRecording, robot: RobotTopics, proposals: Mapping[str, Sequence[ProposedRules]]
) -> str:
    """Rules in canonical layout: inputs, a rule about their silence with its tests, and `proposals`
    by topic, as comments.
    """
    steady = [each for each in robot.watched if each.is_steady]
    silent = robot.names.take("silent")
    parts = [
        _opening(source),
        f"{_prose(robot.commands.about)}\n{robot.commands.declared}",
        "\n".join(_inputs(steady, silent)),
        _rule_of_silence(silent, steady, robot),
    ]
    if source.shared is not None:
        parts.append(_prose(_SHARED.format(topic=source.shared)))
    for each in robot.watched:
        parts += _proposed(each, proposals.get(each.topic, ()))
    parts += map(_comment, proposals.get(robot.commands.topic, ()))
    parts += _tests(silent, steady, robot)
    return format_text("\n\n".join(parts) + "\n")


def _opening(source: SourceRecording) -> str:
    begun = f"First rules for a robot, begun by `rossmarie init` from {source.name}"
    begun += f", of which {source.part} were read." if source.part else "."
    paragraphs = (
        f"{begun} Nothing here is certified.",
        "Proposals are comments without a space behind `//`, or with several. Delete the `//` in"
        " front of each line of a proposal to use it, and set its numbers to those of your robot.",
        f"A timeout is {PERIODS} periods of the topic or {GAPS:g} times its longest gap, whichever"
        f" is longer; at least {SHORTEST_S:g} s, and at most {MOST_PERIODS} periods, rounded up.",
    )
    return "\n//\n".join(map(_prose, paragraphs))


def _inputs(steady: Sequence[WatchedTopic], silent: str) -> Iterator[str]:
    for each in steady:
        yield _prose(_rhythm(each, silent))
        yield _declarations(each)[_first_input(each)]


def _rhythm(watched: WatchedTopic, silent: str | None) -> str:
    """The rhythm of a topic, in a sentence or two."""
    rhythm = watched.rhythm
    longest = rhythm.longest_ns / 1e9
    text = f"{rhythm.count} messages, {plain(1e9 / max(rhythm.median_ns, 1))} Hz;"
    text += f" the longest gap is {plain(longest)} s."
    if silent is not None and longest > watched.timeout:
        text += f" That is a pause: a replay shows it by the rule `{silent}`."
    return text


def _declarations(watched: WatchedTopic) -> dict[str, str]:
    """The inputs of a topic by their names."""
    return {
        name: f"input {name} = topic {watched.topic} : {watched.message_type} {field}"
        f" timeout {plain(watched.timeout)} sec;"
        for name, field in watched.kind.fields(watched.name).items()
    }


def _first_input(watched: WatchedTopic) -> str:
    return next(iter(watched.kind.fields(watched.name)))


def _rule_of_silence(silent: str, steady: Sequence[WatchedTopic], robot: RobotTopics) -> str:
    late = " or ".join(f"age({_first_input(each)}) > {plain(each.timeout)} sec" for each in steady)
    return (
        "'''\nThe robot stops when a sensor falls silent. At the start the rule is active until all"
        " sensors have\nspoken.\n'''\n"
        f"rule {silent}: if {late} then {{ {robot.commands.stop}; }} clear for {_CLEAR_S} sec;"
    )


def _proposed(watched: WatchedTopic, proposals: Sequence[ProposedRules]) -> Iterator[str]:
    """Proposals about a topic, with the additional inputs that they need."""
    declared = _declarations(watched)
    code = "\n".join(each.code for each in proposals)
    names = [name for name in declared if re.search(rf"\b{name}\b", code)]
    needed = [
        declared[name]
        for name in names
        if not (watched.is_steady and name == _first_input(watched))
    ]
    if needed:
        about = f"More of {watched.topic}."
        if not watched.is_steady:
            about = (
                f"{watched.topic} comes irregularly: {_rhythm(watched, None)} Choose the timeout."
            )
        yield _comment(ProposedRules(about, "\n".join(needed)))
    yield from map(_comment, proposals)


def _comment(proposal: ProposedRules) -> str:
    lines = format_text(proposal.code).strip().split("\n")
    return "\n".join([_prose(proposal.about), *(f"//{line}" if line else "" for line in lines)])


def _tests(silent: str, steady: Sequence[WatchedTopic], robot: RobotTopics) -> Iterator[str]:
    """The tests of the rule about silence."""
    soonest = min(steady, key=lambda each: each.timeout)
    step = f"{plain(rounded_down(soonest.timeout / 2))} s"
    names = [_first_input(each) for each in steady]
    yield (
        f'test "{silent} is inactive while all sensors speak" {{\n'
        f"every {step} from 0 s to 2 s {', '.join(names)};\n"
        f"expect {silent} inactive from 0 s to 2 s;\n}}"
    )
    others = [name for name in names if name != _first_input(soonest)]
    end = plain(round(2 + soonest.timeout, 6))
    speak = f"every {step} from 0 s to {end} s {', '.join(others)};\n" if others else ""
    commands = robot.commands
    yield (
        f'test "{silent} is active when {_first_input(soonest)} falls silent, and stops the robot"'
        f" {{\n{speak}every {step} from 0 s to 1 s {_first_input(soonest)};\n"
        f"expect {silent} inactive at 1 s;\n"
        f"expect {silent} active at {end} s;\n"
        f"expect {commands.topic}.{commands.field} in [0, 0] m/s at {end} s;\n}}"
    )


def _prose(text: str) -> str:
    """Text as comments. A number and its unit stay on one line."""
    joined = re.sub(r"(?<=\d) (?=[a-zA-Z%])", _JOINT, text)
    lines = textwrap.wrap(joined, _WIDTH, break_long_words=False, break_on_hyphens=False)
    return "\n".join(f"// {line}".replace(_JOINT, " ") for line in lines)
