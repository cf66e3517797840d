"""The page of a safety file: all that the machine has is in it, and it needs nothing else."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import pytest
from hypothesis import given

from dslkit.diagnostics import Diagnostic, Severity
from dslkit.source import Span
from rossmarie import ir
from rossmarie.analysis.errors import Undecided
from rossmarie.analysis.finding import Finding
from rossmarie.driver import compile_file
from rossmarie.driver.report import safety_file
from rossmarie.ir import reactions
from rossmarie.ir.duration_text import duration_text
from rossmarie.ir.overruled import can_fail, fails_at_once
from rossmarie.report.safety import SafetyFile, open_points, render_safety_file
from rossmarie.report.safety.conditions import ConditionWords
from rossmarie.report.safety.evidence import AnsweredQuery, Evidence, EvidenceKind, Hashed
from rossmarie.report.safety.phrase import Phrase
from rossmarie.report.safety.rules import rule_texts
from support.browser import document_of, needs_browser
from support.golden import assert_golden
from support.machines import machines
from support.reacting import reacting_machines

EXAMPLES = Path(__file__).parents[4] / "examples"
GOLDEN = Path(__file__).with_name("golden")
RULES = ("demo/demo", "thesis/mobile_base", "thesis/arm", "thesis/peg_in_hole", "husky/husky")
HOSTILE = """</style><script>boom()</script>'"&<img src=x onerror=boom()>{{ 7*7 }}<!--"""


class Page(HTMLParser):
    """The elements of a page, its words, its anchors and the links to them."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.attributes: list[tuple[str, str | None]] = []
        self.words = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.attributes += attrs

    def handle_data(self, data: str) -> None:
        self.words += data

    def values(self, name: str) -> list[str]:
        return [value or "" for found, value in self.attributes if found == name]


def content_of(machine: ir.Machine) -> SafetyFile:
    return SafetyFile(
        machine,
        "rules.ross",
        (),
        (),
        (),
        (),
        False,
        (),
        (),
        frozenset(),
        "rossmarie 1",
        "2026-01-01",
        None,
        None,
    )


def example(name: str) -> SafetyFile:
    path = EXAMPLES / f"{name}.ross"
    return safety_file(path, tool="rossmarie 1", date="2026-01-01")[0]


@pytest.mark.parametrize("name", RULES)
def test_sentences_of_the_examples_are_those_that_were_read(name: str, bless: bool) -> None:
    machine = compile_file(EXAMPLES / f"{name}.ross").machine
    texts = ["\n".join(rule.lines()) for rule in rule_texts(machine, ConditionWords(machine))]
    text = "\n\n".join(texts) + "\n"
    assert_golden(GOLDEN / f"{Path(name).name}.txt", text, bless=bless)


# --- all of it -------------------------------------------------------------------------------


def expected_of_conditions(machine: ir.Machine) -> Iterator[str]:
    """Words that a page owes to what the rules stand on."""
    for rule in machine.rules:
        yield rule.name
        propositions = ir.reachable_propositions(machine, rule.condition)
        for index in propositions + (() if rule.release is None else (rule.release,)):
            match machine.propositions[index].node:
                case ir.Held(duration_ns=duration_ns):
                    yield duration_text(duration_ns)
                case ir.Recurs(count=count, window_ns=window_ns):
                    times = "once" if count == 1 else f"{count} times"
                    yield f"become true at least {times} within the last {duration_text(window_ns)}"
                case ir.AgeReaches(input=used, age_ns=age_ns):
                    yield f"the last message of {machine.inputs[used].name}"
                    yield duration_text(age_ns - (age_ns % 1000 == 1))
                case ir.Oscillates(count=count, window_ns=window_ns):
                    yield f"at least {count} turning points within {duration_text(window_ns)}"
                case ir.Between(low=one, high=other) | ir.Compare(left=one, right=other):
                    yield from (constant(machine, end) for end in (one, other))
                case ir.Quantified() as node:
                    yield "element of " + ConditionWords(machine).numbers.array_of(node.element)
                case ir.Since():
                    yield "ever since"
                case ir.Literal() | ir.Flag() | ir.Not() | ir.And() | ir.Or():
                    pass
        for used in rule.inputs:
            timeout_ns = machine.inputs[used].timeout_ns
            yield machine.inputs[used].name
            yield "no timeout" if timeout_ns is None else duration_text(timeout_ns)


def constant(machine: ir.Machine, signal: int) -> str:
    node = machine.signals[signal].node
    return f"{node.value + 0.0:.12g}" if isinstance(node, ir.Constant) else ""


def expected_of_reactions(machine: ir.Machine) -> Iterator[str]:
    """Words that a page owes to what the rules do."""
    for index, task in enumerate(machine.reactions.tasks):
        target = reactions.target_of(task.effect)
        timeout_ns = reactions.timeout_ns(task.effect)
        yield "" if target is None else target.name
        yield "the rule goes no further" if can_fail(task) and not fails_at_once(task) else ""
        yield "" if timeout_ns is None else f"not done within {duration_text(timeout_ns)}"
        yield "to another rule, this starts:" if fails_at_once(task) else ""
        if may_wait_too_long(machine, index):
            yield "it waits, and starts afterwards"
            yield f"after {duration_text(timeout_ns or 0)} it counts as failed"
        yield from expected_of_effect(machine, task.effect)
    for plan in machine.reactions.plans:
        for other in plan.unless:
            yield f"{machine.rules[other].name}"
            yield "none of these effects happen"


def may_wait_too_long(machine: ir.Machine, index: int) -> bool:
    """Say whether the time of a task can run out while another rule holds its resource."""
    found = machine.reactions
    task = found.tasks[index]
    others = {each for plan in found.plans if index not in plan.tasks for each in plan.tasks}
    is_contested = task.resource in {found.tasks[other].resource for other in others} - {None}
    is_awaited = reactions.timeout_ns(task.effect) is not None
    return is_awaited and reactions.waits(task.effect) and is_contested


def expected_of_effect(machine: ir.Machine, effect: reactions.Effect) -> Iterator[str]:
    match effect:
        case reactions.Limit(topic=topic, bounds=bounds):
            command = machine.reactions.commands[topic]
            yield f"commands on {command.topic} are"
            if len({bound.field for bound in bounds}) != len(command.fields):
                for bound in bounds:
                    yield f"{bound.low + 0.0:.12g} to {bound.high + 0.0:.12g}"
            yield from (f"{b.ramp:.12g}" for b in bounds if b.ramp is not None)
        case reactions.Scale(factor=factor):
            yield f"multiplied by {factor:.12g}"
        case reactions.Publish(period_ns=int(period_ns)):
            yield f"every {duration_text(period_ns)}"
        case reactions.Retrace(topic=topic, period_ns=period_ns):
            yield f"sent back on {topic}"
            yield f"one every {duration_text(period_ns)}"
        case reactions.Log(text=text) | reactions.Diagnose(text=text):
            yield f'"{text}"'
        case reactions.Hook(name=name):
            yield name
        case reactions.Publish() | reactions.Call() | reactions.SetParameter():
            pass
        case reactions.SwitchControllers() | reactions.SendGoal() | reactions.CancelGoal():
            pass
        case reactions.Reset():
            pass


@given(machines())
def test_all_that_rules_stand_on_is_in_the_page(machine: ir.Machine) -> None:
    words = Page(render_safety_file(content_of(machine))).words
    assert [each for each in expected_of_conditions(machine) if each not in words] == []


@given(reacting_machines())
def test_all_that_rules_do_is_in_the_page(machine: ir.Machine) -> None:
    content = content_of(machine)
    words = Page(render_safety_file(content)).words
    assert [each for each in expected_of_reactions(machine) if each not in words] == []
    conditions = ConditionWords(machine)
    for index, rule in enumerate(rule_texts(machine, conditions)):
        count = len(machine.reactions.plans[index].tasks)
        named = [line for step in rule.steps for line in actions(step)]
        assert len(named) == count


def actions(phrase: Phrase) -> Iterator[str]:
    """The tasks in a sentence: what has the name of the action."""
    if phrase.name == "act":
        yield phrase.name
    for part in phrase.parts:
        yield from actions(part)


# --- the page --------------------------------------------------------------------------------


@pytest.mark.parametrize("name", RULES)
def test_the_page_needs_nothing_from_outside(name: str) -> None:
    text = render_safety_file(example(name))
    page = Page(text)
    assert not {"link", "img", "iframe", "object", "embed", "base", "script"} & set(page.tags)
    assert not {"src", "srcset", "action"} & {name for name, _ in page.attributes}
    namespaces = text.replace("http://www.w3.org/2000/svg", "")
    assert not re.search(r"https?:|@import|url\((?!#)", namespaces)
    assert "default-src 'none'" in text
    assert text == render_safety_file(example(name))


@pytest.mark.parametrize("name", RULES)
def test_every_link_leads_somewhere_in_the_page(name: str) -> None:
    page = Page(render_safety_file(example(name)))
    anchors = page.values("id")
    assert len(anchors) == len(set(anchors))
    links = page.values("href")
    assert {link for link in links if link.removeprefix("#") not in anchors} == set()
    assert all(link.startswith("#") for link in links)
    assert sum("-line-" in link for link in links) > 10


def test_a_link_leads_to_the_line_that_says_so() -> None:
    content = example("demo/demo")
    text = render_safety_file(content)
    span = content.machine.rules[0].span
    line = content.sources[-1].file.text.split("\n")[span.begin.line - 1]
    assert line.startswith("rule slow_on_bump")
    item = text.split(f'id="file-0-line-{span.begin.line}"><code>', 1)[1].split("</code>")[0]
    assert html.unescape(item) == line
    assert f'href="#file-0-line-{span.begin.line}"' in text


def hostile_finding(span: Span) -> Diagnostic:
    finding = Undecided(query=f"`{HOSTILE}`", reason=HOSTILE).at(span)
    return replace(finding, severity=Severity.WARNING)


def test_hostile_names_stay_text() -> None:
    content = example("demo/demo")
    machine = content.machine
    hostile = replace(
        content,
        rules_file=HOSTILE,
        machine=replace(
            machine,
            rules=tuple(replace(rule, documentation=HOSTILE) for rule in machine.rules),
            inputs=tuple(replace(each, name=HOSTILE) for each in machine.inputs),
            hazards=tuple(replace(each, text=HOSTILE) for each in machine.hazards),
        ),
        findings=(Finding(hostile_finding(machine.rules[0].span)),),
    )
    page = Page(render_safety_file(hostile))
    assert {"script", "img"} & set(page.tags) == set()


def test_hazards_have_their_rules() -> None:
    content = example("demo/demo")
    words = Page(render_safety_file(content)).words
    assert "Rules without a hazard: report_braking." in words
    left = replace(content, machine=replace(content.machine, rules=()))
    assert "No rule mitigates hazard H1." in open_points(left)


def test_the_picture_of_the_wiring_leaves_the_page_as_it_is() -> None:
    text = render_safety_file(example("demo/demo"))
    picture = text.split("<figure><svg", 1)[1].split("</svg>")[0]
    styles = picture.split("<style>")[1].split("</style>")[0]
    rules = re.findall(
        r"^ *([^@/{}]+?) *\{", re.sub(r"/\*.*?\*/", "", styles, flags=re.DOTALL), re.MULTILINE
    )
    selectors = [each.strip() for rule in rules for each in rule.split(",")]
    assert len(selectors) > 10
    assert [each for each in selectors if not each.startswith(".wiring")] == []


# --- reports of others -----------------------------------------------------------------------


def evidence(content: SafetyFile, *, is_current: bool, status: str) -> Evidence:
    hashes = tuple(
        Hashed(each.name, each.sha256 if is_current else "0" * 64) for each in content.sources
    )
    results = (AnsweredQuery("no overflow", status, "by induction"),)
    kind = EvidenceKind.VERIFICATION
    return Evidence(kind, "v.json", "f" * 64, (("cbmc", "6.6.0"),), hashes, (), "3 events", results)


@pytest.mark.parametrize(
    ("is_current", "status", "points"),
    [
        (True, "proved", []),
        (True, "undecided", ["The verification report has 1 undecided: no overflow."]),
        (False, "proved", ["The verification report is not about these rules: demo.ross differs."]),
    ],
)
def test_what_a_report_leaves_open_is_said(
    is_current: bool, status: str, points: list[str]
) -> None:
    content = example("demo/demo")
    found = evidence(content, is_current=is_current, status=status)
    given_ = replace(content, verification=found)
    assert [point for point in open_points(given_) if "verification" in point] == points
    words = Page(render_safety_file(given_)).words
    for expected in ("6.6.0", "3 events", "no overflow", status, "by induction", "f" * 64):
        assert expected in words
    assert ("yes, all hashes are in it" in words) is is_current


def test_of_many_open_results_only_the_first_are_named() -> None:
    content = example("demo/demo")
    found = evidence(content, is_current=True, status="undecided")
    many = tuple(AnsweredQuery(f"query {number}", "undecided") for number in range(9))
    points = open_points(replace(content, verification=replace(found, results=many)))
    assert (
        "The verification report has 9 undecided: query 0, query 1, query 2 and 6 more." in points
    )


@needs_browser
def test_the_page_fits_a_narrow_window(tmp_path: Path) -> None:
    """In a real browser nothing but tables, pictures and sources may be wider than the page."""
    text = render_safety_file(example("thesis/mobile_base"))
    measure = "document.body.dataset.over = document.documentElement.scrollWidth - innerWidth;"
    text = text.replace("style-src", "script-src 'unsafe-inline'; style-src", 1)
    path = tmp_path / "report.html"
    path.write_text(text.replace("</body>", f"<script>{measure}</script></body>"), "utf-8")
    (over,) = re.findall(r'data-over="(-?\d+)"', document_of(path))
    assert int(over) <= 0


@needs_browser
def test_the_hazards_fit_a_phone(tmp_path: Path) -> None:
    """In 390 pixels no cell is cut off, and each cell of a rule has its heading."""
    text = render_safety_file(example("demo/demo"))
    measure = """
      const inside = frame.contentDocument;
      const table = inside.querySelector(".hazards");
      const wide = [...table.querySelectorAll("th, td")]
        .filter((each) => each.getBoundingClientRect().right > 390 - 10);
      const heads = [...table.querySelectorAll("[data-head]")]
        .map((each) => frame.contentWindow.getComputedStyle(each, "::before").content);
      document.body.dataset.wide = wide.length;
      document.body.dataset.over = inside.documentElement.scrollWidth
        - inside.documentElement.clientWidth;
      document.body.dataset.heads = heads.join(" ");
    """
    page = tmp_path / "phone.html"
    page.write_text(
        f'<body><iframe id="frame" width="390" srcdoc="{html.escape(text)}"></iframe>'
        f"<script>frame.onload = () => {{ {measure} }};</script>",
        encoding="utf-8",
    )
    document = document_of(page)
    assert re.findall(r'data-(?:wide|over)="(\d+)"', document) == ["0", "0"]
    (heads,) = re.findall(r'data-heads="([^"]+)"', document)
    assert heads.count("Mitigated by") == heads.count("Recovery") > 3
