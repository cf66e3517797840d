"""A safety file as one HTML page that needs only a browser: no network, no other file, no script.
Equal safety files give equal pages.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from markupsafe import Markup, escape

from dslkit.diagnostics import Severity
from dslkit.source import Span
from rossmarie import ir
from rossmarie.analysis.errors import Undecided
from rossmarie.analysis.finding import Finding
from rossmarie.analysis.loss import Effect
from rossmarie.ir.carried import holds_flags
from rossmarie.ir.duration_text import duration_text
from rossmarie.ir.path import path_words
from rossmarie.report.safety.conditions import ConditionWords
from rossmarie.report.safety.evidence import Evidence, EvidenceKind, Hashed
from rossmarie.report.safety.kept import kept
from rossmarie.report.safety.model import SafetyFile
from rossmarie.report.safety.phrase import Phrase, listed
from rossmarie.report.safety.rules import RuleText, claims, rule_texts
from rossmarie.report.safety.witness import witness_svg
from rossmarie.report.spare import MEANING
from rossmarie.report.templates import asset, template
from rossmarie.report.wiring import wiring_of, wiring_svg

_MOST_NAMES = 3
"""The most open results that the head of the page names."""


def render_safety_file(content: SafetyFile) -> str:
    """The text of the page."""
    machine = content.machine
    conditions = ConditionWords(machine)
    rules = rule_texts(machine, conditions)
    return template("safety.html.j2").render(
        content=content,
        machine=machine,
        rules=rules,
        groups=_groups(rules),
        hazards=_hazards(machine, rules),
        without_hazard=[rule for rule in rules if not rule.hazards],
        fields=_fields(machine, conditions),
        conditions=_conditions(machine, conditions),
        apart=_numbers_apart(conditions),
        warnings=_of_severity(content, is_note=False),
        notes=_of_severity(content, is_note=True),
        coded=_coded,
        drawn=lambda witness: Markup(witness_svg(machine, witness)),
        losses=content.losses,
        kept=[kept(each, content) for each in content.requirements],
        effects=(Effect.ACTIVATES, Effect.DEPENDS),
        claims=_claims(machine),
        exemptions=_exemptions(machine, rules),
        open_points=open_points(content),
        missing=_missing,
        spare_meaning=MEANING,
        others=lambda evidence: evidence.others(_hashed(content)),
        line=_Lines(content),
        duration=duration_text,
        listed=lambda words: listed(tuple(words)),
        picture=Markup(_picture(machine)),
        style=Markup(asset("palette.css") + asset("safety.css")),
    )


def _coded(text: str) -> Markup:
    """The words of a finding, with the text between backticks as code."""
    return Markup(re.sub("`([^`]+)`", r"<code>\1</code>", str(escape(text))))


def _picture(machine: ir.Machine) -> str:
    """The wiring, as wide as the page allows."""
    return wiring_svg(wiring_of(machine))


class _Lines:
    """The links to spans in the page: the anchor of a line, and the text of a link to it."""

    def __init__(self, content: SafetyFile) -> None:
        self._places = {source.file.path: place for place, source in enumerate(content.sources)}
        self._names = [source.name for source in content.sources]

    def anchor(self, span: Span) -> str | None:
        """The identifier of the line; None if its file is not in the page."""
        place = self._places.get(span.file.path)
        return None if place is None else f"file-{place}-line-{span.begin.line}"

    def words(self, span: Span) -> str:
        """`line 27`, with the file if it is not the main one, which is the last."""
        place = self._places.get(span.file.path)
        if place is None or place == len(self._names) - 1:
            return f"line {span.begin.line}"
        return f"{self._names[place]}, line {span.begin.line}"


# --- what is not done ------------------------------------------------------------------------


def open_points(content: SafetyFile) -> tuple[str, ...]:
    """The parts that are missing before the file can be signed, in words."""
    found = []
    for kind, evidence in (
        (EvidenceKind.VERIFICATION, content.verification),
        (EvidenceKind.COVERAGE, content.coverage),
    ):
        found += _open_of(kind, evidence, content)
    found += _unasked(content)
    left_out = content.machine.left_out
    if left_out is not None and left_out.rules:
        only = listed(tuple(each.value for each in left_out.only))
        found.append(f"Only rules of {only} are here: {listed(left_out.rules)} left out.")
    rules = content.machine.rules
    mitigated = {hazard for rule in rules for hazard in rule.hazards}
    for index, hazard in enumerate(content.machine.hazards):
        if index not in mitigated:
            found.append(f"No rule mitigates hazard {hazard.name}.")
    if not content.machine.hazards:
        found.append("The rules declare no hazards.")
    if count := len(_of_severity(content, is_note=False)):
        found.append(f"The check has {_counted(count, 'finding')}.")
    return tuple(found)


def _unasked(content: SafetyFile) -> Iterator[str]:
    if not content.is_thorough:
        yield (
            "Only the quick check was run. It does not prove that conflicts and impossible "
            "conditions are absent."
        )
    undecided = [each for each in content.findings if each.diagnostic.code == Undecided.code]
    if undecided:
        yield f"{_counted(len(undecided), 'query')} about these rules could not be decided."


def _of_severity(content: SafetyFile, *, is_note: bool) -> list[Finding]:
    return [
        each for each in content.findings if (each.diagnostic.severity is Severity.NOTE) is is_note
    ]


def _open_of(kind: EvidenceKind, evidence: Evidence | None, content: SafetyFile) -> list[str]:
    if evidence is None:
        return [f"No {kind.value} report was given."]
    found = []
    if missing := _missing(evidence, content):
        names = listed(missing)
        found.append(f"The {kind.value} report is not about these rules: {names} differs.")
    if not evidence.results:
        found.append(f"The {kind.value} report has no results.")
    for status in kind.statuses[1:]:
        those = [each.name for each in evidence.results if each.status == status]
        if those:
            names = listed(_shortened(those))
            found.append(f"The {kind.value} report has {len(those)} {status}: {names}.")
    return found


def _shortened(names: list[str]) -> tuple[str, ...]:
    """The first few names; the table contains all of them."""
    if len(names) <= _MOST_NAMES + 1:
        return tuple(names)
    return (*names[:_MOST_NAMES], f"{len(names) - _MOST_NAMES} more")


def _missing(evidence: Evidence, content: SafetyFile) -> tuple[str, ...]:
    """The sources that a report does not cover."""
    return evidence.missing(_hashed(content))


def _hashed(content: SafetyFile) -> list[Hashed]:
    return [Hashed(each.name, each.sha256) for each in content.sources]


def _counted(count: int, what: str) -> str:
    return f"{count} {what}{'' if count == 1 else 's'}"


# --- tables ----------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Hazard:
    hazard: ir.Hazard
    rules: tuple[RuleText, ...]


def _hazards(machine: ir.Machine, rules: tuple[RuleText, ...]) -> list[_Hazard]:
    return [
        _Hazard(hazard, tuple(rule for rule in rules if index in rule.hazards))
        for index, hazard in enumerate(machine.hazards)
    ]


@dataclass(frozen=True)
class _Exemption:
    """A rule that is not applied while a skill runs, the permissions, and the rules that apply
    instead.
    """

    exempted: RuleText
    doing: str
    permits: tuple[str, ...]
    instead: tuple[RuleText, ...]


def _exemptions(machine: ir.Machine, rules: tuple[RuleText, ...]) -> list[_Exemption]:
    by_name = {text.name: text for text in rules}
    standing: dict[ir.Exemption, list[RuleText]] = {}
    for rule, text in zip(machine.rules, rules, strict=True):
        if rule.exempts is not None:
            standing.setdefault(rule.exempts, []).append(text)
    return [
        _Exemption(by_name[each.rule], each.doing, each.permits, tuple(texts))
        for each, texts in standing.items()
    ]


@dataclass(frozen=True)
class _Group:
    """The rules of one category, under its name. The name is empty if no rule has a category."""

    name: str
    rules: tuple[RuleText, ...]


def _groups(rules: tuple[RuleText, ...]) -> list[_Group]:
    """The rules by their categories; rules without a category come last."""
    found = [
        _Group(f"{each.value}".capitalize(), those)
        for each in ir.SUBJECTS
        if (those := tuple(rule for rule in rules if each in rule.categories))
    ]
    others = tuple(rule for rule in rules if not set(rule.categories) & set(ir.SUBJECTS))
    return [*found, _Group("Without a category" if found else "", others)] if others else found


@dataclass(frozen=True)
class _Field:
    """A field of a message, with the `kind` of its values and the `unit` in which it arrives."""

    name: str
    input: int
    path: str
    kind: str
    unit: str


_KINDS = {
    ir.FieldKind.REAL: "number",
    ir.FieldKind.FLAG: "true or false",
    ir.FieldKind.TEXT: "text",
}


def _kind_of_array(machine: ir.Machine, array: ir.Array) -> str:
    """`array`, or the kind of a field of the elements of a list, with the greatest number of
    elements.
    """
    if array.list is None:
        return "array"
    kind = ir.FieldKind.FLAG if holds_flags(array) else array.kind
    return f"{_KINDS[kind]} of each of up to {machine.lists[array.list].most} elements"


def _fields(machine: ir.Machine, conditions: ConditionWords) -> list[_Field]:
    found = [
        _Field(conditions.numbers.slot(index), slot.input, path_words(slot.path) or "data",
               _KINDS[slot.kind], slot.unit)
        for index, slot in enumerate(machine.slots)
    ]  # fmt: skip
    found += [
        _Field(conditions.numbers.array(index), array.input, path_words(array.path),
               _kind_of_array(machine, array), array.unit)
        for index, array in enumerate(machine.arrays)
    ]  # fmt: skip
    return sorted(found, key=lambda field: field.input)


@dataclass(frozen=True)
class _Condition:
    name: str
    anchor: str
    phrase: Phrase
    span: Span


def _conditions(machine: ir.Machine, conditions: ConditionWords) -> list[_Condition]:
    """The named conditions, and the conditions to which the sentences above refer."""
    wanted = {
        index
        for index, proposition in enumerate(machine.propositions)
        if proposition.name is not None
    }
    said: dict[int, Phrase] = {}
    while missing := (wanted | set(conditions.apart)) - set(said):
        for index in sorted(missing):
            said[index] = conditions.in_full(index)
    return [
        _Condition(conditions.name(index), f"condition-{index}", said[index],
                   machine.propositions[index].span)
        for index in sorted(said)
    ]  # fmt: skip


def _numbers_apart(conditions: ConditionWords) -> list[tuple[int, str]]:
    """The signals that have a name such as `number 7` in the sentences."""
    said: dict[int, str] = {}
    while missing := set(conditions.numbers.apart) - set(said):
        for index in sorted(missing):
            said[index] = conditions.numbers.in_full(index)
    return sorted(said.items())


def _claims(machine: ir.Machine) -> list[tuple[str, list[ir.Rule]]]:
    """The resources that several rules need exclusively, with the rules in the order in which they
    get them.
    """
    return [
        (machine.reactions.resources[resource], [machine.rules[rule] for rule in rules])
        for resource, rules in claims(machine).items()
        if len(rules) > 1
    ]
