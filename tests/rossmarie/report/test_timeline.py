from __future__ import annotations

import html
import json
import math
import re
from dataclasses import replace
from html.parser import HTMLParser
from typing import Any

import numpy as np

from rossmarie.ir import Change, InputState, TruthValue, Verdict
from rossmarie.report.model import Plot, Replay
from rossmarie.report.spans import active_spans, summarize
from rossmarie.report.timeline import render_timeline
from rossmarie.report.wording import format_length
from support.docking import docking

HOSTILE = """</script><script>boom()</script>'"&<img src=x onerror=boom()>{{ 7*7 }}<!--"""


class Page(HTMLParser):
    """The elements of a page, and what stands in its scripts."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.attributes: list[tuple[str, str | None]] = []
        self.scripts: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.attributes += attrs
        if tag == "script":
            self.scripts.append("")

    def handle_data(self, data: str) -> None:
        if self.lasttag == "script" and self.scripts:
            self.scripts[-1] += data


def data_of(text: str) -> Any:
    return json.loads(Page(text).scripts[0])


def test_the_page_needs_nothing_from_outside(drive: Replay) -> None:
    text = render_timeline(drive)
    page = Page(text)
    assert not {"link", "img", "iframe", "object", "embed", "base"} & set(page.tags)
    assert not {"src", "srcset", "action"} & {name for name, _ in page.attributes}
    namespaces = text.replace("http://www.w3.org/2000/svg", "")
    assert not re.search(r"https?:|//[a-z]+\.|@import|url\((?!#)", namespaces)
    assert "default-src 'none'" in text


def test_the_page_words_lengths_as_the_table_does(drive: Replay) -> None:
    rules = data_of(render_timeline(drive))["rules"]
    assert [rule["total"] for rule in rules] == [
        format_length(summary.total_ns) for summary in summarize(drive)
    ]
    lengths = [format_length(span.end_ns - span.start_ns) for span in active_spans(drive)[0]]
    assert [span[-1] for span in rules[0]["spans"]] == lengths != []


def test_the_table_needs_no_script(drive: Replay) -> None:
    text = render_timeline(drive)
    table = text[text.index("<table>") : text.index("</table>")]
    for summary in summarize(drive):
        assert summary.rule in table
        assert html.escape(summary.first_cause) in table
    assert "1 min 20 s" in text
    assert "2023-11-14 22:13:20 UTC" in text
    assert drive.notes[0] in text
    assert "Every change, in order" in text


def test_hostile_names_stay_text(drive: Replay) -> None:
    rule = drive.machine.rules[0]
    machine = replace(
        drive.machine,
        rules=(
            replace(rule, name=HOSTILE, documentation=HOSTILE, actions=(HOSTILE,)),
            *drive.machine.rules[1:],
        ),
        propositions=tuple(
            replace(proposition, text=HOSTILE) for proposition in drive.machine.propositions
        ),
    )
    plots = tuple(replace(plot, text=HOSTILE, unit=HOSTILE) for plot in drive.plots)
    hostile = replace(
        drive, machine=machine, plots=plots, rules_file=HOSTILE, recording=HOSTILE, notes=(HOSTILE,)
    )
    text = render_timeline(hostile)
    page = Page(text)
    assert page.tags == Page(render_timeline(drive)).tags
    assert len(page.scripts) == 2
    assert not set("<>&") & set(page.scripts[0])
    assert data_of(text)["rules"][0]["name"] == HOSTILE


def test_six_minutes_of_ten_signals_stay_below_two_megabytes(drive: Replay) -> None:
    generator = np.random.default_rng(1)
    times = np.arange(400 * 30) / 30
    columns = generator.normal(size=(10, len(times)))
    plots = tuple(Plot(f"signal {i}", "m", times, column, ()) for i, column in enumerate(columns))
    verdicts = tuple(
        Verdict(1, drive.start_ns + i * 33_000_000,
                Change.CLEARED if i % 2 else Change.ACTIVATED,
                (TruthValue.FALSE if i % 2 else TruthValue.TRUE,), (drive.start_ns,),
                (9.0 if i % 2 else 15.0,), (InputState.FRESH,))
        for i in range(12_000)
    )  # fmt: skip
    long = replace(drive, end_ns=drive.start_ns + 400_000_000_000, plots=plots, events=verdicts)
    text = render_timeline(long)
    assert len(text.encode()) < 2_000_000
    assert len(data_of(text)["changes"]) == 1000
    assert "The first 1000 of 12000 changes, in order" in text


def test_an_empty_replay_has_a_page(drive: Replay) -> None:
    empty = replace(drive, events=(), plots=(), notes=(), end_ns=drive.start_ns)
    found = data_of(render_timeline(empty))
    assert found["duration"] == 0
    assert all(rule["spans"] == [] for rule in found["rules"])


def test_numbers_that_json_lacks_do_not_reach_the_page(drive: Replay) -> None:
    odd = Plot(
        "x", "", np.array([0.0, 1, 2, 3]), np.array([math.inf, -math.inf, math.nan, 1e300]), ()
    )
    render_timeline(replace(drive, plots=(odd,)))


def test_a_page_tells_what_would_be_done_but_not_without_end() -> None:
    replay = docking()
    first, other = data_of(render_timeline(replay))["changes"][:2]
    assert first["done"] == [
        "creep: limit /cmd_vel",
        "creep: publish /lamp at 2 Hz",
        "after 1.0 s, creep: publish /lamp at 2 Hz (overruled by touching)",
        "after 2.0 s, creep: publish /lamp at 2 Hz",
    ]
    assert len(other["done"]) == 3
    often = replace(replay, rehearsed=replay.rehearsed * 9)
    assert len(data_of(render_timeline(often))["changes"][0]["done"]) == 13
    assert (
        data_of(render_timeline(often))["changes"][0]["done"][-1] == "more is in the verdicts file"
    )
