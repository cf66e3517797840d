"""Trees on a terminal and as pictures: all that there is to see, in order, and nothing covered."""

from __future__ import annotations

import io
import itertools
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.console import Console

from ezskiros.drawing.outline import Line, NodeBox, Outline, Role, outline
from ezskiros.drawing.svg import svg
from ezskiros.drawing.terminal import terminal_tree
from ezskiros.driver import Checked, UnknownSkillError, trees_of
from support.browser import document_of, needs_browser
from support.golden import assert_golden
from support.tree_files import checked_text

GOLDEN = Path(__file__).parent / "golden"
SVG = "{http://www.w3.org/2000/svg}"


def outlines(checked: Checked, skill: str, **options: object) -> list[Outline]:
    wanted = {"depth": 0, "has_conditions": True, **options}
    return [
        outline(tree, checked.trees, checked.library, **wanted)  # type: ignore[arg-type]
        for tree in trees_of(skill, checked)
    ]


def printed(found: list[Outline]) -> str:
    out = Console(file=io.StringIO(), width=200)
    for each in found:
        out.print(terminal_tree(each))
    assert isinstance(out.file, io.StringIO)
    return "\n".join(line.rstrip() for line in out.file.getvalue().splitlines()) + "\n"


@pytest.mark.parametrize(("skill", "depth"), [("fetch", 0), ("fetch", 1), ("Pause", 0)])
def test_a_tree_on_a_terminal(gripping: Checked, skill: str, depth: int, bless: bool) -> None:
    found = printed(outlines(gripping, skill, depth=depth))
    assert_golden(GOLDEN / f"{skill}_{depth}.txt", found, bless=bless)


def test_conditions_can_be_left_out(gripping: Checked) -> None:
    found = printed(outlines(gripping, "fetch", has_conditions=False))
    assert "contain" not in found
    assert "Target <- Place, Speed = 0.05" in found


def test_a_picture_is_as_it_was_looked_at(gripping: Checked, bless: bool) -> None:
    assert_golden(GOLDEN / "fetch.svg", svg(outlines(gripping, "fetch", depth=1)), bless=bless)


def test_a_picture_needs_nothing_else(gripping: Checked) -> None:
    text = svg(outlines(gripping, "fetch", depth=1))
    assert text.count("http") == text.count('xmlns="http')
    for forbidden in ("@import", "@font-face", "url(", "src", "href", "fetch(", "XMLHttp"):
        assert forbidden not in text


@needs_browser
def test_a_browser_shows_a_picture(gripping: Checked, tmp_path: Path) -> None:
    page = tmp_path / "fetch.svg"
    page.write_text(svg(outlines(gripping, "fetch", depth=1)), encoding="utf-8")
    document = document_of(page)
    assert "Approach.go_to_linear" in document
    assert "parsererror" not in document


PRESS = """
const root = document.documentElement;
const press = (element) => element.dispatchEvent(new MouseEvent("click", { bubbles: true }));
const own = (title) => [...document.querySelectorAll(".own")]
  .find((each) => each.textContent.includes(title));
const button = (label) => [...document.querySelectorAll(".button")]
  .find((each) => each.textContent.startsWith(label));
"""


def opened(text: str, folder: Path, script: str = "") -> ET.Element:
    """The picture in a browser, after its scripts and then `script` have run."""
    page = folder / "tree.svg"
    tail = f"<script><![CDATA[{PRESS}{script}]]></script></svg>"
    page.write_text(text.replace("</svg>", tail), encoding="utf-8")
    return ET.fromstring(document_of(page))


def shown(root: ET.Element) -> dict[str, tuple[float, float]]:
    """The box of each skill in sight: its title, and its upper and lower edge."""
    hidden = {
        inner
        for each in root.iter(f"{SVG}g")
        if each.get("display") == "none"
        for inner in each.iter()
    }
    found = {}
    for own in (each for each in root.iter(f"{SVG}g") if each.get("class") == "own"):
        if own not in hidden:
            box = own.find(f"{SVG}rect")
            title = own.find(f"{SVG}text")
            assert box is not None
            assert title is not None
            assert title.text
            moved = re.match(r"translate\(0 (.*)\)", own.get("transform", "translate(0 0)"))
            assert moved is not None
            top = float(box.attrib["y"]) + float(moved[1])
            found[title.text] = (top, top + float(box.attrib["height"]))
    return found


def edges(root: ET.Element) -> object:
    """The edges of all boxes in sight, to compare up to the digits in the file."""
    return pytest.approx([edge for pair in shown(root).values() for edge in pair], abs=0.3)


@needs_browser
def test_a_click_folds_a_subtree_and_closes_the_gap(gripping: Checked, tmp_path: Path) -> None:
    text = svg(outlines(gripping, "fetch", depth=1))
    before = shown(opened(text, tmp_path))
    folded = opened(text, tmp_path, 'press(own("|ff|"));')
    after = shown(folded)
    gone = set(before) - set(after)
    assert {"Grip.grip", "Note.note", "<> inverter"} <= gone
    assert "|ff| parallelff" in after
    assert max(bottom for _, bottom in after.values()) < max(
        bottom for _, bottom in before.values()
    )
    again = opened(text, tmp_path, 'press(own("|ff|")); press(own("|ff|"));')
    assert [each for pair in shown(again).values() for each in pair] == edges(
        opened(text, tmp_path)
    )


@needs_browser
def test_all_can_be_folded_but_the_root(gripping: Checked, tmp_path: Path) -> None:
    text = svg(outlines(gripping, "fetch", depth=1))
    after = shown(opened(text, tmp_path, 'press(button("Fold"));'))
    assert len(after) == 2
    both = 'press(button("Fold")); press(button("Unfold"));'
    unfolded = shown(opened(text, tmp_path, both))
    assert [each for pair in unfolded.values() for each in pair] == edges(opened(text, tmp_path))


@needs_browser
def test_a_picture_zooms(gripping: Checked, tmp_path: Path) -> None:
    text = svg(outlines(gripping, "fetch", depth=1))

    def scale(script: str) -> float:
        (moved,) = (
            each.attrib["transform"]
            for each in opened(text, tmp_path, script).iter(f"{SVG}g")
            if each.get("class") == "all"
        )
        return float(moved.split("scale(")[1].rstrip(")"))

    fitting = scale("")
    assert scale('press(button("+"));') == pytest.approx(1.25 * fitting)
    wheel = "root.dispatchEvent(new WheelEvent('wheel', { deltaY: 50, clientX: 9, clientY: 9 }));"
    assert scale(wheel) < fitting
    assert scale(f'{wheel} press(button("Fit"));') == fitting


@needs_browser
def test_in_another_page_a_picture_stays_still(gripping: Checked, tmp_path: Path) -> None:
    text = svg(outlines(gripping, "fetch", depth=1))
    page = tmp_path / "page.html"
    page.write_text(f"<!DOCTYPE html><title>x</title>{text}", encoding="utf-8")
    document = document_of(page)
    assert 'viewBox="0 0 ' in document
    assert 'class="tools"' not in document


texts = st.text("ab<>&\"' \u00e4", min_size=1, max_size=90)
lines = st.lists(st.builds(Line, st.sampled_from(Role), texts), max_size=4).map(tuple)
boxes = st.recursive(
    st.builds(NodeBox, texts, st.just(""), lines, st.just(())),
    lambda inner: st.builds(
        NodeBox, texts, st.just("->"), lines, st.lists(inner, min_size=1, max_size=4).map(tuple)
    ),
    max_leaves=12,
)


@given(st.lists(boxes, min_size=1, max_size=3))
def test_no_box_covers_another_and_all_are_in_the_picture(roots: list[NodeBox]) -> None:
    root = ET.fromstring(svg([Outline(each, ("x > 3",)) for each in roots]))
    width, height = float(root.attrib["width"]), float(root.attrib["height"])
    places = [
        tuple(float(each.attrib[name]) for name in ("x", "y", "width", "height"))
        for each in root.iter(f"{SVG}rect")
        if each.attrib["class"] in ("skill", "flow")
    ]
    for x, y, wide, high in places:
        assert 0 <= x <= width - wide
        assert 0 <= y <= height - high
    for (x, y, wide, high), (a, b, c, d) in itertools.combinations(places, 2):
        assert x + wide <= a or a + c <= x or y + high <= b or b + d <= y


def test_a_skill_inside_itself_is_drawn_once(tmp_path: Path) -> None:
    found = checked_text(
        "class Loop(SkillDescription):\n    def description(self): pass\n"
        "class loop(Loop.SkillBase):\n"
        "    def expandBT(self, params):\n        self.serialstar(Loop.loop())\n",
        tmp_path,
    )
    assert printed(outlines(found, "loop", depth=9)).count("Loop.loop") == 2


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ("wait", "`wait` is primitive: it has no behavior tree"),
        ("Wait", "`Wait` has no compound implementation"),
        ("Fetsh", "there is no skill `Fetsh` in these files; did you mean `Fetch`?"),
    ],
)
def test_what_has_no_tree_is_said(gripping: Checked, asked: str, said: str) -> None:
    with pytest.raises(UnknownSkillError, match=said.replace("?", r"\?")):
        trees_of(asked, gripping)
