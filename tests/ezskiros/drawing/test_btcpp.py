"""XML for BehaviorTree.CPP: by its structure, and by its own library where that is installed."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from ezskiros.drawing.btcpp import export
from ezskiros.driver import Checked, trees_of
from support.golden import assert_golden
from support.tree_files import checked_text

GOLDEN = Path(__file__).parent / "golden"
CONTROLS = {"Sequence", "ReactiveSequence", "Fallback", "ReactiveFallback", "Parallel"}
DECORATORS = {"Inverter", "RetryUntilSuccessful", "Timeout", "ForceSuccess"}


def exported(found: Checked, skill: str, depth: int = 0) -> tuple[str, list[str | None]]:
    trees = trees_of(skill, found)
    text, diagnostics = export(trees, found.trees, found.library, depth=depth)
    return text, [each.code for each in diagnostics]


def compound(body: str, parameters: str = "") -> str:
    return (
        f"class Task(SkillDescription):\n    def description(self, {parameters}): pass\n"
        f"class task(Task.SkillBase):\n    def expandBT(self, params):\n        {body}\n"
    )


def element(body: str, folder: Path) -> ET.Element:
    """The XML element of a processor."""
    text, codes = exported(checked_text(compound(body), folder), "task")
    assert codes == []
    tree = ET.fromstring(text).find("BehaviorTree")
    assert tree is not None
    return tree[0]


def test_a_tree_is_as_it_was_looked_at(gripping: Checked, bless: bool) -> None:
    text, codes = exported(gripping, "fetch", depth=1)
    assert codes == []
    assert_golden(GOLDEN / "fetch.xml", text, bless=bless)


def test_the_structure_is_what_the_library_asks_for(gripping: Checked) -> None:
    root = ET.fromstring(exported(gripping, "fetch", depth=1)[0])
    assert (root.tag, root.attrib["BTCPP_format"]) == ("root", "4")
    trees = {each.attrib["ID"]: each for each in root.findall("BehaviorTree")}
    assert root.attrib["main_tree_to_execute"] in trees
    (models,) = root.findall("TreeNodesModel")
    ports = {
        (each.tag, each.attrib["ID"]): {p.attrib["name"] for p in each if "name" in p.attrib}
        for each in models
    }
    for tree in trees.values():
        assert len(tree) == 1
        for node in list(tree.iter())[1:]:
            check_node(node, ports, trees.keys())


def check_node(node: ET.Element, ports: dict[tuple[str, str], set[str]], trees: object) -> None:
    count = len(node)
    if node.tag in CONTROLS:
        assert count > 0
    elif node.tag in DECORATORS:
        assert count == 1
    elif node.tag == "SubTree":
        assert count == 0
        assert node.attrib["ID"] in trees  # type: ignore[operator]
    else:
        assert count == 0
        assert node.attrib.keys() <= ports["Action", node.tag]


@pytest.mark.parametrize(
    ("processor", "tag", "ports"),
    [
        ("serial", "ReactiveSequence", {}),
        ("serialstar", "Sequence", {}),
        ("selector", "ReactiveFallback", {}),
        ("selectorstar", "Fallback", {}),
        ("parallelff", "Parallel", {"success_count": "-1", "failure_count": "1"}),
        ("parallelfs", "Parallel", {"success_count": "1", "failure_count": "1"}),
    ],
)
def test_processors(processor: str, tag: str, ports: dict[str, str], tmp_path: Path) -> None:
    body = f"self.{processor}(Wait(Duration=1.0), Wait(Duration=2.0))"
    found = element(body, tmp_path)
    assert found.tag == tag
    assert {key: text for key, text in found.attrib.items() if key != "name"} == ports
    assert [each.attrib["Duration"] for each in found] == ["1.0", "2.0"]


def test_no_fail_is_a_sequence_that_counts_as_success(tmp_path: Path) -> None:
    found = element("self.nofail(Wait(Duration=1.0), Wait(Duration=2.0))", tmp_path)
    assert (found.tag, found[0].tag, len(found[0])) == ("ForceSuccess", "Sequence", 2)


@pytest.mark.parametrize(
    ("body", "tag", "ports"),
    [
        ("self.inverter(Wait(Duration=1.0))", "Inverter", {}),
        ("self.retry(Wait(Duration=1.0), 3)", "RetryUntilSuccessful", {"num_attempts": "3"}),
        ("self.timeout(Wait(Duration=1.0), 2.5)", "Timeout", {"msec": "2500"}),
        # 0 would be no timeout at all
        ("self.timeout(Wait(Duration=1.0), 0.0001)", "Timeout", {"msec": "1"}),
    ],
)
def test_decorators(body: str, tag: str, ports: dict[str, str], tmp_path: Path) -> None:
    found = element(body, tmp_path)
    assert (found.tag, found.attrib) == (tag, ports)


def test_tries_that_are_a_parameter_are_an_entry_of_the_blackboard(tmp_path: Path) -> None:
    text = compound("self.retry(Wait(Duration=1.0), params.Tries)", "Tries: int")
    found, codes = exported(checked_text(text, tmp_path), "task")
    assert codes == []
    retry = ET.fromstring(found).find("BehaviorTree/RetryUntilSuccessful")
    assert retry is not None
    assert retry.attrib == {"num_attempts": "{Tries}"}


def test_several_trees_have_names_of_their_own_and_say_when(gripping: Checked) -> None:
    tree = trees_of("pause", gripping)[1]
    text, _ = export([tree, tree], gripping.trees, gripping.library, depth=0)
    root = ET.fromstring(text)
    assert [each.attrib["ID"] for each in root.findall("BehaviorTree")] == ["pause_1", "pause_2"]
    assert "main_tree_to_execute" not in root.attrib
    assert "<!-- if not params.Careful -->" in text


INNER = """
class Inner(SkillDescription):
    def description(self, Text: str, Duration: float): pass
class inner(Inner.SkillBase):
    def expandBT(self, params):
        self.serialstar(Wait(), Say(Words=params.Text))
class Say(SkillDescription):
    def description(self, Words: str, Volume: float): pass
class say(Say.SkillBase):
    def execute(self):
        return self.success(f"{self.params.Words} {self.params.Volume}")
"""


def test_a_subtree_gets_all_names_that_are_shared(tmp_path: Path) -> None:
    """Also those that only its own children have: a subtree has a blackboard of its own."""
    text = INNER + compound("self.serialstar(Inner.inner(Text='x'))", "Duration: float")
    found, codes = exported(checked_text(text, tmp_path), "task", depth=1)
    assert codes == []
    subtree = ET.fromstring(found).find("BehaviorTree/Sequence/SubTree")
    assert subtree is not None
    assert subtree.attrib == {
        "ID": "inner", "Text": "x", "Duration": "{Duration}", "Volume": "{Volume}",
    }  # fmt: skip


FAULTS = {
    "EZS830": compound("self.serialstar(Wait(Duration=params.D + 1.0))", "D: float"),
    "EZS831": compound("self.serialstar(Wait(Duration=params._D))", "_D: float"),
    "EZS832": "class Sleep(Wait.SkillBase):\n    def execute(self): return self.success()\n"
    + compound("self.serialstar(Wait.Sleep(Duration=1.0))"),
    "EZS833": INNER + compound("self.serialstar(Say(Words='{Text}', Volume=1.0))"),
    "EZS834": compound("self.timeout(Wait(Duration=1.0), 1e9)"),
    "EZS837": compound("self.timeout(Wait(Duration=1.0), params.Seconds)", "Seconds: float"),
    "EZS835": compound("self.serialstar(Task.task())"),
}


@pytest.mark.parametrize("code", FAULTS)
def test_what_cannot_be_said_is_refused(code: str, tmp_path: Path) -> None:
    _, codes = exported(checked_text(FAULTS[code], tmp_path), "task")
    assert codes == [code]


@pytest.mark.parametrize(("text", "is_refused"), [("42", True), ("1e5", True), ("4x", False)])
def test_a_number_in_a_text_is_none_for_a_subtree(
    text: str, is_refused: bool, tmp_path: Path
) -> None:
    body = f"self.serialstar(Inner.inner(Text={text!r}, Duration=1.0))"
    found = checked_text(INNER + compound(body), tmp_path)
    assert exported(found, "task", depth=1)[1] == (["EZS833"] if is_refused else [])
    assert exported(found, "task", depth=0)[1] == []


def test_a_circle_of_subtrees_is_refused(tmp_path: Path) -> None:
    text = compound("self.serialstar(One.one())") + (
        "class One(SkillDescription):\n    def description(self): pass\n"
        "class Two(SkillDescription):\n    def description(self): pass\n"
        "class one(One.SkillBase):\n    def expandBT(self, params): self.serialstar(Two.two())\n"
        "class two(Two.SkillBase):\n    def expandBT(self, params): self.serialstar(One.one())\n"
    )
    found = checked_text(text, tmp_path)
    for depth in (1, 2, 3, 5):
        assert set(exported(found, "task", depth=depth)[1]) <= {"EZS835"}
        assert ("EZS835" in exported(found, "task", depth=depth)[1]) == (depth > 1)


def test_a_compound_with_several_trees_stays_an_action(tmp_path: Path, gripping: Checked) -> None:
    text = (
        "class Pause(SkillDescription):\n    def description(self, Long: bool): pass\n"
        "class pause(Pause.SkillBase):\n    def expandBT(self, params):\n"
        "        if params.Long: self.serialstar(Wait(Duration=2.0))\n"
        "        else: self.serialstar(Wait(Duration=1.0))\n"
    ) + compound("self.serialstar(Pause.pause(Long=True))")
    found, codes = exported(checked_text(text, tmp_path), "task", depth=1)
    assert codes == ["EZS836"]
    assert ET.fromstring(found).find("BehaviorTree/Sequence/pause") is not None
