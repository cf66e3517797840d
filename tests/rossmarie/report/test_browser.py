"""The page in a real browser, without a screen and without a network."""

from __future__ import annotations

import html
import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path

import numpy as np

from rossmarie.ir import TimeJump, Verdict
from rossmarie.report.model import Plot, Replay
from rossmarie.report.timeline import render_timeline
from support.browser import document_of, needs_browser
from support.docking import docking

pytestmark = needs_browser

# Without a screen frames come late or never; timers run in the virtual time of the browser.
FRAMES = "<head><script>window.requestAnimationFrame = (act) => setTimeout(act, 0);</script>"

SVG = "{http://www.w3.org/2000/svg}"

POINT = """
const pointAt = (element) => {
  const box = element.getBoundingClientRect();
  element.dispatchEvent(new PointerEvent("pointermove", {
    bubbles: true, clientX: box.left + box.width / 2, clientY: box.top + box.height / 2,
  }));
};
const press = (element, key) =>
  element.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
const lanes = document.querySelectorAll(".lane svg");
"""


def opened(page: str, folder: Path, script: str = "") -> str:
    """The document after its scripts, and then `script`, have run."""
    path = folder / "timeline.html"
    tail = f"<script>{POINT}{script}</script></body>"
    text = page.replace("<head>", FRAMES, 1).replace("</body>", tail)
    path.write_text(text, encoding="utf-8")
    document = document_of(path)
    root = document[: document.index(">", document.index("<html"))]
    assert "data-error" not in root, root
    assert 'data-ready="true"' in root
    return document


def element(document: str, identifier: str) -> str:
    """The text in an element, from where it starts to where its section ends."""
    start = document.index(f'id="{identifier}"')
    inside = document[document.index(">", start) + 1 : document.index("</section>", start)]
    return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", " ", inside))


def test_lanes_and_plots_are_drawn(drive: Replay, tmp_path: Path) -> None:
    document = opened(render_timeline(drive), tmp_path)
    rows = document[document.index('id="rows"') : document.index('id="card"')]
    assert len(re.findall(r'class="row lane"', rows)) == len(drive.machine.rules)
    assert len(re.findall(r'class="row plot"', rows)) == len(drive.plots)
    assert len(re.findall(r'<rect class="span active', rows)) == 9
    assert len(re.findall(r'<rect class="span stale', rows)) == 5
    lines = re.findall(r'<path class="line" d="M[^"]{200,}"', rows)
    assert len(lines) == len(drive.plots)
    assert "NaN" not in rows
    for text in ("10 deg", "\u221210 deg", "imu.steep", "in rad/s", "00:10", "01:20"):
        assert text in rows


def test_pointing_at_a_span_shows_its_cause_and_the_values(drive: Replay, tmp_path: Path) -> None:
    script = 'pointAt(lanes[0].querySelector(".span.active"));'
    document = opened(render_timeline(drive), tmp_path, script)
    card = element(document, "card")
    for text in (
        "slow_on_slope",
        "from 00:24.7 until 00:30.4",
        "imu.steep",
        "orientation.pitch() not in tilt for 2 s",
        "orientation.pitch() = 13.843 deg",
        "since 00:22.7",
        "lowSpeed",
        "clears as soon as its condition is false",
        "orientation.pitch() = 9.35816 deg",
    ):
        assert text in card
    assert "Would do" not in card
    readings = re.findall(r'<span class="reading">([^<]*)<', document)
    assert len(readings) == len(drive.plots)
    assert all(re.fullmatch("\u2212?[0-9.]+ \\S+", reading) for reading in readings)


def test_pointing_at_a_span_shows_what_its_rule_would_do(tmp_path: Path) -> None:
    script = 'pointAt(lanes[0].querySelector(".span.active"));'
    card = element(opened(render_timeline(docking()), tmp_path, script), "card")
    for text in (
        "Would do creep: limit /cmd_vel creep: publish /lamp at 2 Hz",
        "after 1.0 s, creep: publish /lamp at 2 Hz (overruled by touching)",
        "after 2.0 s, creep: publish /lamp at 2 Hz ",
    ):
        assert text in card


def test_a_stale_input_is_named(drive: Replay, tmp_path: Path) -> None:
    script = 'pointAt(lanes[1].querySelector(".span.stale"));'
    card = element(opened(render_timeline(drive), tmp_path, script), "card")
    assert re.search(r"acceleration \(/imu/data\) is older than its timeout", card)


def test_keys_walk_along_the_spans_and_say_them(drive: Replay, tmp_path: Path) -> None:
    script = 'press(lanes[1], "ArrowRight"); press(lanes[1], "ArrowRight");'
    document = opened(render_timeline(drive), tmp_path, script)
    assert "slow_on_bump, active from 00:15.5 until 00:17.3" in element(document, "spoken")


def test_zooming_narrows_the_window_and_reset_widens_it(drive: Replay, tmp_path: Path) -> None:
    page = render_timeline(drive)
    zoomed = opened(page, tmp_path, 'press(lanes[0], "+"); press(lanes[0], "+");')
    assert "00:25.6 \u2013 00:54.4" in zoomed
    script = 'press(lanes[0], "+"); document.getElementById("zoom-reset").click();'
    assert "00:00.0 \u2013 01:20.0" in opened(page, tmp_path, script)


DRAG = """
// An event that a script makes belongs to no pointer that could be captured.
Element.prototype.setPointerCapture = () => {};
const box = lanes[0].getBoundingClientRect();
const share = (part) => box.left + 46 + part * (box.width - 46 - 178);
const send = (type, part, more) => lanes[0].dispatchEvent(new PointerEvent(type, {
  bubbles: true, clientX: share(part), clientY: box.top + 9, ...more,
}));
const drag = (from, to, more) => {
  send("pointerdown", from, more);
  send("pointermove", to, more);
  send("pointerup", to, more);
};
"""


def test_dragging_selects_and_shift_pans(drive: Replay, tmp_path: Path) -> None:
    page = render_timeline(drive)
    assert "00:20.0 \u2013 00:40.0" in opened(page, tmp_path, DRAG + "drag(0.25, 0.5);")
    script = DRAG + "drag(0.25, 0.5); drag(0.75, 0.25, { shiftKey: true });"
    assert "00:30.0 \u2013 00:50.0" in opened(page, tmp_path, script)


def test_a_click_keeps_the_card_open(drive: Replay, tmp_path: Path) -> None:
    script = (
        DRAG
        + """
      send("pointermove", 0.34); drag(0.34, 0.34); send("pointermove", 0.9);
    """
    )
    document = opened(render_timeline(drive), tmp_path, script)
    assert 'class="card pinned"' in document
    assert "from 00:24.7" in element(document, "card")


def test_the_wheel_zooms_with_ctrl_only(drive: Replay, tmp_path: Path) -> None:
    wheel = """
      const wheel = (ctrlKey) => lanes[0].dispatchEvent(new WheelEvent("wheel", {
        bubbles: true, cancelable: true, deltaY: -50, ctrlKey, clientX: share(0.5),
      }));
    """
    page = render_timeline(drive)
    assert "00:00.0 \u2013 01:20.0" in opened(page, tmp_path, DRAG + wheel + "wheel(false);")
    assert "00:10.4 \u2013 01:09.6" in opened(page, tmp_path, DRAG + wheel + "wheel(true);")


def test_every_change_is_listed(drive: Replay, tmp_path: Path) -> None:
    document = opened(
        render_timeline(drive), tmp_path, 'document.getElementById("changes").open = true;'
    )
    changes = document[document.index('id="changes"') :]
    assert changes[: changes.index("</details>")].count("<tr>") == len(drive.events)


def test_hostile_names_run_nothing(drive: Replay, tmp_path: Path) -> None:
    hostile = "</script><img src=x onerror=\"document.documentElement.dataset.ran='1'\">"
    rules = tuple(replace(rule, name=hostile + rule.name) for rule in drive.machine.rules)
    replay = replace(drive, machine=replace(drive.machine, rules=rules), notes=(hostile,))
    document = opened(
        render_timeline(replay), tmp_path, "pointAt(lanes[0].querySelector('.span'));"
    )
    assert "data-ran" not in document[: document.index("<head")]


def with_recorded(replay: Replay, factor: float = 1.0) -> Replay:
    """The same replay with two signals to add."""
    times = np.linspace(0, 80, 500)
    recorded = (
        Plot("/odom twist.twist.linear.x", "m/s", times, factor * np.sin(times), ()),
        Plot("/fix altitude", "m", times, factor * times, ()),
    )
    return replace(replay, recorded=recorded)


def later_drive(drive: Replay) -> Replay:
    """The drive in another recording: a second later, and with other values."""
    later = tuple(
        replace(event, at_ns=event.at_ns + 1_000_000_000)
        for event in drive.events
        if isinstance(event, Verdict)
    )
    plots = tuple(replace(plot, values=plot.values * 1.5) for plot in drive.plots)
    return replace(drive, recording="b/evening.mcap", events=later, plots=plots)


def test_a_signal_is_added_and_removed(drive: Replay, tmp_path: Path) -> None:
    page = render_timeline(with_recorded(drive))
    add = """
      const select = document.getElementById("add-signal");
      select.value = "1"; select.dispatchEvent(new Event("change"));
    """
    document = opened(page, tmp_path, add)
    assert re.findall(r'<optgroup label="([^"]+)"', document) == ["/odom", "/fix"]
    assert re.findall(r"<option[^>]* disabled[^>]*>([^<]+)", document) == ["altitude"]
    rows = document[document.index('id="rows"') : document.index('id="card"')]
    assert len(re.findall(r'<path class="line" d="M[^"]{200,}"', rows)) == len(drive.plots) + 1
    assert "/fix altitude" in element(document, "rows")
    document = opened(page, tmp_path, add + 'document.querySelector(".remove").click();')
    assert "/fix altitude" not in element(document, "rows")
    assert not re.findall(r"<option[^>]* disabled", document)


def test_a_page_without_further_signals_offers_none(drive: Replay, tmp_path: Path) -> None:
    assert re.search(r'<p class="add" hidden', opened(render_timeline(drive), tmp_path))


def test_two_runs_are_drawn_above_each_other(drive: Replay, tmp_path: Path) -> None:
    page = render_timeline(drive, later_drive(drive))
    document = opened(page, tmp_path, 'pointAt(lanes[0].querySelectorAll(".span.active")[1]);')
    assert len(re.findall(r'class="row lane"', document)) == len(drive.machine.rules)
    heights = re.findall(r'<rect class="span active[^"]*" x="[\d.]{2,}" y="(\d+)"', document)
    assert {height: heights.count(height) for height in heights} == {"6": 9, "26": 9}
    assert len(re.findall(r'<path class="line other" d="M[^"]{200,}"', document)) == 5
    assert "the lower strip is evening.mcap" in element(document, "chart-title")


def test_a_span_of_the_second_run_has_its_own_card(drive: Replay, tmp_path: Path) -> None:
    page = render_timeline(drive, later_drive(drive))
    script = 'pointAt([...lanes[0].querySelectorAll(".span.active")].at(-1));'
    card = element(opened(page, tmp_path, script), "card")
    assert "from 01:07.7" in card
    assert "Run evening.mcap" in card


def test_limits_of_another_version_of_the_rules_are_marked(drive: Replay, tmp_path: Path) -> None:
    plots = tuple(
        replace(plot, thresholds=tuple(replace(one, limits=(7.0,)) for one in plot.thresholds))
        for plot in drive.plots
    )
    rules = drive.machine.rules[1:]
    old = replace(drive, rules_file="old.ross", plots=plots,
                  machine=replace(drive.machine, rules=rules), events=())  # fmt: skip
    document = opened(render_timeline(drive, old), tmp_path)
    assert 'class="line other"' not in document
    assert "limit other" in document
    assert "old.ross: no such rule" in element(document, "rows")


def test_a_rule_leads_to_its_line(drive: Replay, tmp_path: Path) -> None:
    script = 'pointAt(lanes[0].querySelector(".span.active")); location.hash = "line-0-1";'
    document = opened(render_timeline(drive), tmp_path, script)
    assert document.count('href="#line-0-1"') == len(drive.machine.rules) + 1
    assert re.search(r'<details open="">\s*<summary>draft.ross</summary>', document)


def test_the_picture_in_view_is_saved(drive: Replay, tmp_path: Path) -> None:
    script = """
      URL.createObjectURL = (blob) => {
        blob.text().then((text) => { document.getElementById("spoken").textContent = text; });
        return "#";
      };
      press(lanes[0], "+");
      setTimeout(() => document.getElementById("save-svg").click(), 100);
    """
    document = opened(render_timeline(drive), tmp_path, script)
    start = document.index(">", document.index('id="spoken"')) + 1
    saved = ET.fromstring(html.unescape(document[start : document.index("</div>", start)]))
    texts = [each.text for each in saved.iter(f"{SVG}text")]
    assert texts[0] == "yard.ross over yard_drive.mcap"
    for rule in drive.machine.rules:
        assert rule.name in texts
    assert "00:10" not in texts
    assert "00:20" in texts
    for each in saved.iter():
        assert "class" not in each.attrib
        assert not re.search(r"var\(|rgba|https?:", " ".join(each.attrib.values()))
    fills = {each.get("fill") for each in saved.iter(f"{SVG}rect")}
    assert {"rgb(207, 79, 23)", "url(#hatch)"} <= fills


def test_the_picture_is_saved_as_pixels(drive: Replay, tmp_path: Path) -> None:
    script = """
      const addressOf = URL.createObjectURL;
      URL.createObjectURL = (blob) => {
        if (blob.type !== "image/png") return addressOf.call(URL, blob);
        blob.slice(16, 24).arrayBuffer().then((header) => {
          const [width, height] = [0, 4].map((at) => new DataView(header).getUint32(at));
          document.getElementById("spoken").textContent = `${width} by ${height}`;
        });
        return "#";
      };
      document.getElementById("save-png").click();
    """
    document = opened(render_timeline(drive), tmp_path, script)
    size = re.search(r'id="spoken"[^>]*>(\d+) by (\d+)<', document)
    assert size is not None
    assert int(size[1]) > 1000
    assert int(size[2]) > 1000


def test_odd_replays_are_drawn_too(drive: Replay, tmp_path: Path) -> None:
    odd = (
        Plot("constant", "m", np.array([0.0]), np.array([2.0]), ()),
        Plot("unknown", "m", np.array([0.0, 1]), np.array([np.nan, np.nan]), ()),
        Plot("infinite", "m", np.array([0.0, 1, 2]), np.array([np.inf, -np.inf, 1]), ()),
        Plot("nothing", "", np.empty(0), np.empty(0), ()),
    )
    jump = TimeJump(drive.start_ns + 5_000_000_000, drive.start_ns + 2_000_000_000)
    replay = replace(drive, plots=odd, events=(*drive.events, jump))
    document = opened(render_timeline(replay), tmp_path)
    assert "clock back 3.0 s" in document
    empty = replace(drive, plots=(), events=(), end_ns=drive.start_ns)
    opened(render_timeline(empty), tmp_path)
