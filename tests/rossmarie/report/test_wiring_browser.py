"""The picture of a wiring in a real browser: its widths are reckoned without knowing the fonts."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from rossmarie import ir
from rossmarie.report.wiring import wiring_of, wiring_svg
from support.browser import document_of, needs_browser
from support.compiled import machine_of
from support.live_cases import vehicle

pytestmark = needs_browser

LONG = """
input orientation = topic /robot_namespace/imu/data_raw : sensor_msgs/Imu .orientation;
action brake { block /robot_namespace/arm/joint_velocity_controller/command : geometry_msgs/Twist; }
rule tilting_too_far_forward: if orientation.pitch() > 1 deg then { brake; };
rule tilting_too_far_backward: if orientation.pitch() < -1 deg then { brake; };
"""
BARE = """
action stop;
input on = topic /on : std_msgs/Bool;
rule it: if on then { stop; };
"""
MACHINES: dict[str, Callable[[], ir.Machine]] = {
    "all": vehicle,
    "long": lambda: machine_of(LONG),
    "bare": lambda: replace(machine_of(BARE), name="a_rules_file_with_a_long_name"),
    "nothing": lambda: machine_of("action stop;"),
}

# What is outside of the picture, or lies across the edge of a box; and how many texts have been
# looked at.
SCRIPT = """
const picture = document.querySelector("svg").getBoundingClientRect();
const boxes = [...document.querySelectorAll(".box, .node, .filter")]
  .map((element) => element.getBoundingClientRect());
const texts = [...document.querySelectorAll("text")];
const isIn = (inner, outer) => inner.left >= outer.left && inner.right <= outer.right
  && inner.top >= outer.top && inner.bottom <= outer.bottom;
const meets = (one, other) => one.left < other.right && other.left < one.right
  && one.top < other.bottom && other.top < one.bottom;
const stale = texts.filter((element) => {
  const text = element.getBoundingClientRect();
  return !isIn(text, picture) || boxes.some((box) => meets(text, box) && !isIn(text, box));
});
document.body.dataset.stale = stale.map((element) => element.textContent).join("|");
document.body.dataset.count = texts.length;
"""


@pytest.mark.parametrize("name", MACHINES)
def test_every_text_has_room(name: str, tmp_path: Path) -> None:
    picture = wiring_svg(wiring_of(MACHINES[name]()))
    page = tmp_path / "wiring.html"
    page.write_text(f"<body>{picture}<script>{SCRIPT}</script></body>", encoding="utf-8")
    document = document_of(page)
    assert re.findall(r'data-stale="([^"]*)"', document) == [""]
    assert re.findall(r'data-count="([^"]*)"', document) == [str(picture.count("<text"))]
