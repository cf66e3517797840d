"""Behavior trees that are wired wrong, each way, and those that are not."""

from __future__ import annotations

import pytest

from support.skill_files import HEADER, checked
from support.trees import findings, tree

FINE = [
    "self.serialstar(Drive(Target=params.Place), Grip(Force=params.Force), Grip(Force=2.0))",
    "self.serialstar(Drive.drive(Target=params.Place, Speed=1), Grip())",
    "self.serial(Measure(), Grip(), self.nofail(Watch()))",
    "self.selector(Drive(Target=params.Place), self.inverter(Grip()))",
    "self.selectorstar(self.retry(Drive(Target=params.Place), 3), Grip())",
    "self.parallelff(self.timeout(Drive(Target=params.Place), 5.0), Grip())",
    "self.parallelfs(Watch(), Drive(Target=params.Place))",
    "Grip()",
    "steps = [Grip(Force=2.0 * each) for each in (1, 2)]\nself.serialstar(*steps, *steps)",
    "Grip(Force=params.Speed * 2)",
    "self.serialstar(*(Grip(Force=1.0 * each) for each in range(int(params.Speed))))",
    "steps = [Grip(Force=1.0) for each in params.Name.split()]\nself.serialstar(*steps, Grip())",
    "self.serialstar(*[Grip(Force=1.0)] * int(params.Speed), Grip())",
    "self.serialstar(*int(params.Speed) * (Grip(Force=1.0),))",
    "if params.Speed > 1:\n    Grip()\nelse:\n    self.nofail(Grip())",
    "self.serialstar(self.selector(Measure(), Grip(Force=1.0)), Grip())",
    "self.serialstar(Drive(Target=params.Place, Speed=params.Speed))",
]
"""Trees in which nothing is wrong."""
WRONG = [
    ("Gripp(Force=2.0)", "EZS510", "Gripp"),
    ("grip(Force=2.0)", "EZS515", "grip(Force=2.0)"),
    ("Grip.grop(Force=2.0)", "EZS521", "grop"),
    ("Grip.drive(Force=2.0)", "EZS522", "drive"),
    ("Dream()", "EZS520", "Dream()"),
    ("Dream.dream()", "EZS521", "dream"),
    ("Grip(Force=2.0, Fource=3.0)", "EZS523", "Fource"),
    ("Grip(2.0, Force=2.0)", "EZS505", "Grip(2.0, Force=2.0)"),
    ("Grip(Force=params.Forse)", "EZS508", "params.Forse"),
    ("Grip(Force='2')", "EZS524", "'2'"),
    ("Grip(Force=True)", "EZS524", "True"),
    ("Grip(Force=params.Name)", "EZS526", "params.Name"),
    ("Grip(Force=params.Place)", "EZS526", "params.Place"),
    ("Drive(Target=params.Force)", "EZS526", "params.Force"),
    ("Drive(Target=params.Box)", "EZS526", "params.Box"),
    ("Drive(Target='shelf')", "EZS525", "'shelf'"),
    ("Drive(Target=None)", "EZS525", "None"),
    ("Say()", "EZS526", "Say()"),
    ("Drive()", "EZS530", "Drive()"),
    ("self.sequence(Grip())", "EZS519", "self.sequence"),
    ("self.serialstar(Grip(Force=self.params.Force))", "EZS519", "self.params"),
    ("self.serialstar()", "EZS501", "self.serialstar()"),
    ("self.serialstar('Grip')", "EZS502", "self.serialstar('Grip')"),
    ("self.serialstar([Grip()])", "EZS502", "self.serialstar([Grip()])"),
    ("self.retry(Grip(), 0)", "EZS503", "self.retry(Grip(), 0)"),
    ("self.timeout(Grip(), 'long')", "EZS503", "self.timeout(Grip(), 'long')"),
    ("Grip()\nself.nofail(Watch())", "EZS506", "Grip()"),
    ("pass", "EZS507", "def expandBT(self, params):"),
    ("if params.Speed > 1:\n    Grip()", "EZS507", "def expandBT(self, params):"),
    ("open('x')\nGrip()", "EZS221", "open('x')"),
    ("raise ValueError('no')", "EZS220", "raise ValueError('no')"),
    (
        "self.timeout(Grip(), duration=params.Force)",
        "EZS538",
        "self.timeout(Grip(), duration=params.Force)",
    ),
    ("self.retry(Grip(), delay=params.Speed)", "EZS538", "self.retry(Grip(), delay=params.Speed)"),
    (
        "self.serialstar(Grip(), Force=params.Force)",
        "EZS538",
        "self.serialstar(Grip(), Force=params.Force)",
    ),
    ("Drive(Target=params.Place, Start=params.Place)", "EZS529", "params.Place"),
    ("self.selector(self.nofail(Grip()), Watch())", "EZS544", "Watch()"),
    ("self.serialstar(Watch(), Grip())", "EZS544", "Grip()"),
    ("self.serialstar(Watch())", "EZS543", "task"),
    ("self.parallelff(Watch(), Grip())", "EZS543", "task"),
    (
        "self.serial(Drive(Target=params.Place), Drive(Target=params.Place))",
        "EZS545",
        "Drive(Target=params.Place)",
    ),
    ("self.serialstar(Grip(), Task())", "EZS546", "Task()"),
]


@pytest.mark.parametrize("body", FINE)
def test_nothing_is_found_in_a_tree_that_is_right(body: str) -> None:
    assert findings(tree(body)) == []


@pytest.mark.parametrize(("body", "code", "place"), WRONG, ids=[body for body, _, _ in WRONG])
def test_what_is_wrong_is_found_at_its_place(body: str, code: str, place: str) -> None:
    assert (code, place) in findings(tree(body))


MISWRITTEN = [
    ("serialstar(Grip(Force=1.0), Watch())", "EZS510", "write `self.serialstar(...)`"),
    ("self.serailstar(Grip(Force=1.0))", "EZS519", "did you mean `self.serialstar`?"),
    ("self.fallback(Grip(Force=1.0))", "EZS519", "write `self.selectorstar(...)`"),
    ("self.skill('Grip', 'grip')", "EZS519", "`Drive(Target=params.Place)`"),
    ("Grip(Force=params['Force'])", "EZS220", "write `params.Force`"),
    ("params.Force = 1.0\nGrip()", "EZS220", "pass the value to the child, `Skill(Force=...)`"),
    ("Drive(Target=params.Place())", "EZS220", "`params.Place` is an individual"),
    ("self.serialstar('Grip')", "EZS502", "write `Grip(...)`, without quotes"),
    ("self.serialstar(Grip)", "EZS502", "write `Grip(...)`"),
    ("self.serialstar([Grip(Force=1.0)])", "EZS502", "write `*[...]`"),
    ("self.serialstar(lambda: Grip(Force=1.0))", "EZS502", "call it"),
    ("self.retry(3, Grip(Force=1.0))", "EZS503", "write `self.retry(child, 3)`"),
    ("yield Grip(Force=1.0)", "EZS507", "remove `yield`"),
    ("self.timeout(Grip(Force=1.0), second=2.0)", "EZS538", "write `self.timeout(child, seconds)`"),
    ("self.retry(Grip(Force=1.0))", "EZS538", "write `self.retry(child, count)`"),
    ("self.inverter(Grip(Force=1.0), Grip(Force=1.0))", "EZS538", "write `self.inverter(child)`"),
    ("self.serial(Grip(Force=1.0), Force=1.0)", "EZS538", "write `self.serial(child, ...)`"),
]
"""Trees as newcomers write them, and what they are reported: one message."""


@pytest.mark.parametrize(
    ("body", "code", "reported"), MISWRITTEN, ids=[each for each, *_ in MISWRITTEN]
)
def test_what_is_miswritten_is_reported_once_with_what_to_write(
    body: str, code: str, reported: str
) -> None:
    found = [each for each in tree(body).diagnostics if each.code != "EZS420"]
    assert [each.code for each in found] == [code]
    assert reported in f"{found[0].help} {found[0].primary.text}"


MISCALLED = [
    ("timeout(Grip(), duration=1.0)", "`self.timeout` has no argument `duration`"),
    (
        "timeout(Grip(), second=1.0)",
        "`self.timeout` has no argument `second`: did you mean `seconds`?",
    ),
    ("timeout(Grip(), child=Grip())", "`self.timeout` gets `child` twice"),
    ("retry(Grip())", "`self.retry` needs `count`"),
    ("retry(count=3)", "`self.retry` needs `child`"),
    ("inverter(Grip(), Grip())", "`self.inverter` gets 2 arguments but takes 1"),
]


@pytest.mark.parametrize(("call", "reported"), MISCALLED, ids=[call for call, _ in MISCALLED])
def test_a_miscalled_processor_says_which_argument_is_wrong(call: str, reported: str) -> None:
    [found] = [each for each in tree(f"self.{call}").diagnostics if each.code == "EZS538"]
    assert found.title == reported


def test_mistakes_beside_a_miscalled_processor_are_found_as_well() -> None:
    found = findings(tree("self.timeout(Grip(Fource=1.0), duration=2.0)\nGripp()"))
    assert [code for code, _ in found] == ["EZS538", "EZS523", "EZS510"]


def test_a_value_without_its_name_is_reported_once() -> None:
    found = tree("self.serialstar(Drive(params.Place), Grip(2.0))")
    assert findings(found) == [("EZS505", "Drive(params.Place)"), ("EZS505", "Grip(2.0)")]
    assert "`Drive(Target=...)`" in str(found.diagnostics[0].help)


@pytest.mark.parametrize(
    ("child", "codes"),
    [
        ("Hand(Tool=params.Part, Part=params.Part)", ["EZS526", "EZS529"]),
        ("Hand(Tool=params.Part)", ["EZS526"]),
        ("Hand(Tool=params.Place)", ["EZS535"]),
    ],
)
def test_what_does_not_fit_is_not_reported_to_be_dropped_besides(
    child: str, codes: list[str]
) -> None:
    text = f"""
class Hand(SkillDescription):
    def description(
        self, Tool: OPTIONAL[skiros.Location], Part: skiros.Product, Place: skiros.Location
    ): ...

class hand(Hand.SkillBase):
    def execute(self):
        return self.success(f"{{self.params.Tool}}, {{self.params.Part}}, {{self.params.Place}}")

class Give(SkillDescription):
    def description(self, Part: skiros.Product, Place: skiros.Location):
        self.pre_conditions += Place.contain(Part)

class give(Give.SkillBase):
    def expandBT(self, params):
        self.serialstar({child})
"""
    found = findings(checked(HEADER + text))
    assert [code for code, _ in found if code != "EZS420"] == codes


OUTPUTS = [
    ("self.serialstar(Measure(), Grip())", []),
    ("self.serialstar(Grip(), Measure(), Grip())", [("EZS531", "Grip()")]),
    ("self.serialstar(self.nofail(Measure()), Grip())", [("EZS531", "Grip()")]),
    ("self.serialstar(self.inverter(Measure()), Grip())", [("EZS531", "Grip()")]),
    (
        "self.serialstar(self.selector(Measure(), Dream.dream()), Grip())",
        [("EZS521", "dream"), ("EZS531", "Grip()")],
    ),
    ("self.serialstar(self.parallelff(Measure(), Watch()), Grip())", [("EZS544", "Grip()")]),
    ("self.parallelff(Measure(), Grip())", [("EZS532", "Grip()")]),
    ("self.parallelff(Measure(), self.serialstar(Measure(), Grip()))",
     [("EZS536", "Measure()"), ("EZS532", "Grip()")]),
    ("Measure()", [("EZS533", "Measure()")]),
    ("self.serialstar(Measure(), Say())", [("EZS528", "Say()")]),
]  # fmt: skip


@pytest.mark.parametrize(("body", "expected"), OUTPUTS, ids=[body for body, _ in OUTPUTS])
def test_values_that_are_found_out_are_there_when_they_are_read(
    body: str, expected: list[tuple[str, str]]
) -> None:
    assert sorted(findings(tree(body, ""))) == sorted(expected)


def test_an_output_of_the_compound_has_a_value_on_all_ways_to_its_end() -> None:
    output = "Force: OUTPUT[float]"
    assert findings(tree("Measure()", output)) == []
    assert findings(tree("Measure(Force=params.Force)", output)) == []
    missing = [("EZS534", "task")]
    assert findings(tree("Grip(Force=2.0)", output)) == missing
    assert findings(tree("self.selector(Measure(), Grip(Force=2.0))", output)) == missing


def test_both_ends_are_shown() -> None:
    (found,) = tree("Grip(Force=params.Name)").diagnostics
    labels = {(label.span.text, label.text) for label in found.labels}
    assert ("Force", "`Force` is declared here") in labels
    assert ("Name", "`Name` is declared here") in labels


def test_all_branches_are_looked_at() -> None:
    body = """
        if params.Speed > 1:
            Grip(Forse=2.0)
        elif params.Name == "slow":
            Grip(Fource=2.0)
        else:
            Grip()
    """
    assert {place for code, place in findings(tree(body)) if code == "EZS523"} == {
        "Forse",
        "Fource",
    }


def test_without_a_tree_the_way_there_is_reported() -> None:
    (found,) = tree("if params.Speed > 1:\n    Grip()").diagnostics
    assert [(each.span.text, each.text) for each in found.labels] == [
        ("params.Speed > 1", "on the path where this is false")
    ]


@pytest.mark.parametrize(
    ("sets", "expected"),
    [
        ("self.params.Pose = self.found", []),
        ("self.wmi.add_element(self.params.Pose)", []),
        ("pose = self.params.Pose; self._wmi.add_elements([pose])", []),
        ("self.found = 1", [("EZS530", "Use()")]),
        ("self.wmi.update_element(self.params.Pose)", [("EZS530", "Use()")]),
        ("pose = self.params.Pose; self.wmi.add_element(self.found)", [("EZS530", "Use()")]),
    ],
)
def test_an_optional_parameter_that_is_set_has_a_value(
    sets: str, expected: list[tuple[str, str]]
) -> None:
    text = f"""
class Make(SkillDescription):
    def description(self, Pose: OPTIONAL[skiros.Location]): ...

class make(Make.SkillBase):
    found = None

    def execute(self):
        {sets}
        return self.success("made")

class Use(SkillDescription):
    def description(self, Pose: skiros.Location): ...

class use(Use.SkillBase):
    def execute(self):
        return self.success(str(self.params.Pose))

class Both(SkillDescription):
    def description(self): ...

class both(Both.SkillBase):
    def expandBT(self, params):
        self.serialstar(Make(), Use())
"""
    found = findings(checked(HEADER + text))
    assert [each for each in found if each[0] not in ("EZS420", "EZS533")] == expected


FINDS_OUT = """
class Weigh(SkillDescription):
    def description(self, Force: OPTIONAL[float] = 1.0): ...

class weigh(Weigh.SkillBase):
    def execute(self):
        {sets}
        return self.success("weighed")

class Use(SkillDescription):
    def description(self, Force: float): ...

class use(Use.SkillBase):
    def execute(self):
        return self.success(str(self.params.Force))

class Both(SkillDescription):
    def description(self{own}): ...

class both(Both.SkillBase):
    def expandBT(self, params):
        self.serialstar({children})
"""


@pytest.mark.parametrize(
    ("sets", "own", "children", "expected"),
    [
        ("self.params.Force = 3.5", "", "Weigh(), Use()", []),
        ("self.params.Force = 3.5", "", "Weigh(Force=2.0), Use()", [("EZS530", "Use()")]),
        ("self.found = 3.5", "", "Weigh(), Use()", [("EZS530", "Use()")]),
        ("self.params.Force = 3.5", "", "Use(), Weigh()", [("EZS531", "Use()")]),
        ("self.params.Force = 3.5", "", "self.parallelff(Weigh(), Use())", [("EZS532", "Use()")]),
        ("self.params.Force = 3.5", ", Force: str", "Weigh()", [("EZS526", "Weigh()")]),
        ("self.found = 3.5", ", Force: str", "Weigh()", []),
    ],
)
def test_a_default_is_passed_on_when_it_is_set(
    sets: str, own: str, children: str, expected: list[tuple[str, str]]
) -> None:
    found = findings(checked(HEADER + FINDS_OUT.format(sets=sets, own=own, children=children)))
    assert [each for each in found if each[0] not in ("EZS420", "EZS533")] == expected


def test_a_parameter_whose_type_is_unknown_is_reported_once() -> None:
    text = """
from typing import Annotated

class Drive(SkillDescription):
    def description(self, Target: skiros.Locatoin, Start: Annotated[skiros.Place, Key("a b")]): ...

class drive(Drive.SkillBase):
    def execute(self):
        return self.success(f"{self.params.Target} {self.params.Start}")

class Go(SkillDescription):
    def description(self, Place: skiros.Locatoin): ...

class go(Go.SkillBase):
    def expandBT(self, params):
        Drive(Target=params.Place, Start=params.Place)
"""
    found = findings(checked(HEADER + text))
    assert {code for code, _ in found} == {"EZS111"}


def test_an_optional_parameter_with_a_default_has_a_value() -> None:
    optional = 'Force: OPTIONAL[float] = 2.0, Name: OPTIONAL[str] = "a"'
    assert findings(tree("Grip(Force=params.Force)", optional)) == []
    without = "Force: OPTIONAL[float]"
    assert findings(tree("Grip(Force=params.Force)", without)) == [
        ("EZS537", "Grip(Force=params.Force)")
    ]


@pytest.mark.parametrize(
    ("limit", "parameters", "codes"),
    [
        ("self.retry(Grip(Force=1.0), params.Tries)", "Tries: int", []),
        ("self.retry(Grip(Force=1.0), params.Tries + 1)", "Tries: int", []),
        ("self.retry(Grip(Force=1.0), params.Tries)", "Tries: float", ["EZS503"]),
        ("self.retry(Grip(Force=1.0), 2.5)", "", ["EZS503"]),
        ("self.timeout(Grip(Force=1.0), params.Tries)", "Tries: int", []),
        ("self.timeout(Grip(Force=1.0), params.Tries)", "Tries: str", ["EZS503"]),
        ("self.timeout(Grip(Force=1.0), float('inf'))", "", ["EZS503"]),
        ("self.timeout(Grip(Force=1.0), params.Tries)", "Tries: OPTIONAL[float]", ["EZS537"]),
    ],
)
def test_limits_that_are_parameters(limit: str, parameters: str, codes: list[str]) -> None:
    assert [code for code, _ in findings(tree(limit, parameters))] == codes
