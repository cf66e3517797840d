"""Skills of EzSkiROS in real SkiROS2. Its sources are not part of this project: see the how-to."""
# mypy: disable-error-code="no-untyped-call,no-any-return"

from __future__ import annotations

import sys
from typing import Any

import pytest

from support import skiros2_core
from support.parts import SKIROS2, needs

pytestmark = [
    needs(SKIROS2),
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),  # of what SkiROS2 uses
]

SKILLS = """
class Mode(enum.Enum):
    SLOW = 1
    FAST = 2


class Say(SkillDescription):
    def description(self, Text: str, Ticks: int = 1):
        pass


class say(Say.SkillBase):
    def onStart(self):
        self.left = self.params.Ticks
        return True

    def execute(self):
        self.left -= 1
        return self.step(self.params.Text) if self.left else self.success(f"{self.params.Text}!")


class Measure(SkillDescription):
    def description(self, Force: OUTPUT[float], Mode: Mode = Mode.SLOW):
        pass


class measure(Measure.SkillBase):
    def execute(self):
        self.params.Force = 3.5 if self.params.Mode is Mode.FAST else 1
        return self.success(self.params.Mode.name)


class Push(SkillDescription):
    def description(
        self,
        Force: float,
        Start: Annotated[skiros.Location, Key("Start Place")],
        Target: skiros.Location,
    ):
        pass


class push(Push.SkillBase):
    def execute(self):
        return self.success(f"{self.params.Force} {self.params.Start} {self.params.Target}")


class Flaky(SkillDescription):
    def description(self, Failures: int):
        pass


class flaky(Flaky.SkillBase):
    count = 0

    def execute(self):
        self.count += 1
        return self.fail("no", 7) if self.count <= self.params.Failures else self.success("yes")


class Move(SkillDescription):
    def description(self, Piece: skiros.Product, Target: skiros.Location):
        self.post_conditions += Target.contain(Piece)


class move(Move.SkillBase):
    def execute(self):
        self.world.relate(self.params.Target, skiros.contain, self.params.Piece)
        return self.success("moved")


class lazy_move(Move.SkillBase):
    def execute(self):
        return self.success("not moved")


class Broken(SkillDescription):
    def description(self):
        pass


class broken(Broken.SkillBase):
    def execute(self):
        return 1 / len("")


class odd(Broken.SkillBase):
    def execute(self):
        return [True][0]


class Mark(SkillDescription):
    def description(self, Piece: skiros.Product, Container: OUTPUT[skiros.Location]):
        self.post_conditions += Piece.Weight == 3.5


class mark(Mark.SkillBase):
    def execute(self):
        self.world.set_value(self.params.Piece, skiros.Weight, 3.5)
        self.params.Container = self.world.new(skiros.Location)
        return self.success(str(self.world.values(self.params.Piece, skiros.Weight)))


class mark_in_skiros2(Mark.SkillBase):
    def execute(self):
        from skiros2_common.core.world_element import Element

        individual = self.params.Piece
        individual.setProperty("skiros:Weight", 3.5)
        self.params.Piece = individual
        self.params.Container = Element("skiros:Location", "new")
        return self.success(individual.type)


class Held(SkillDescription):
    def description(self, Piece: skiros.Product, Place: skiros.Location):
        self.hold_conditions += Place.contain(Piece)


class held(Held.SkillBase):
    def execute(self):
        self.world.unrelate(self.params.Place, skiros.contain, self.params.Piece)
        return self.step("holding")
"""
COMPOUND = """
class Task(SkillDescription):
    def description(self, {parameters} Loud: bool = False, Text: str = "outer"):
        pass


class task(Task.SkillBase):
    def expandBT(self, params):
        {tree}
"""


INDIVIDUALS = """A: skiros.Location, B: skiros.Location, Product: skiros.Product,
        Found: OPTIONAL[skiros.Location],"""


def reported_by(
    package: Any, tree: str, *, individuals: bool = False, **given: object
) -> tuple[str, list[str]]:
    """The result of a compound with this tree, and what its children tell."""
    name = package(
        "library",
        SKILLS + COMPOUND.format(tree=tree, parameters=INDIVIDUALS if individuals else ""),
    )
    core = skiros2_core.Core()
    core.load(name, "task")
    if individuals:
        given["A"], given["B"] = core.add("skiros:Location"), core.add("skiros:Location")
        given["Product"] = core.add("skiros:Product")
    return core.run("Task", "task", **given)


def test_a_library_is_loaded_and_a_primitive_runs(package: Any) -> None:
    core = skiros2_core.Core()
    core.load(package("library", SKILLS), "say")
    state, reported = core.run("Say", "say", Text="hello", Ticks=2)
    assert (state, reported) == ("Success", ["say Running hello", "say Success hello!"])


def test_the_skills_can_still_be_imported_by_their_names(package: Any) -> None:
    name = package("library", SKILLS, user="from library.skills import Say, say\n")
    skiros2_core.Core().load(name)
    user = sys.modules["library.user"]
    assert issubclass(user.say, user.Say.SkillBase)


def test_values_of_calls_stay_with_the_child(package: Any) -> None:
    tree = "self.serialstar(Say(Text='one'), Say(Text=params.Text), Measure(Mode=Mode.FAST))"
    state, reported = reported_by(package, tree)
    assert state == "Success"
    assert reported == ["say Success one!", "say Success outer!", "measure Success FAST"]


def test_an_output_reaches_the_next_child(package: Any) -> None:
    tree = "self.serialstar(Measure(), Push(Start=params.A, Target=params.B))"
    state, reported = reported_by(package, tree, individuals=True)
    assert state == "Success"
    assert reported[1].startswith("push Success 1.0 skiros:Location-")


def test_individuals_can_be_swapped_and_passed_twice(package: Any) -> None:
    calls = ("Start=params.A, Target=params.B", "Start=params.B, Target=params.A")
    both = "Start=params.A, Target=params.A"
    tree = ", ".join(f"Push.push(Force=2.0, {each})" for each in (*calls, both))
    state, reported = reported_by(package, f"self.serialstar({tree})", individuals=True)
    assert state == "Success"
    first, second, third = (text.split()[3:] for text in reported)
    assert first != third
    assert second == first[::-1]
    assert third == [first[0], first[0]]


def test_a_branch_goes_the_way_of_the_value(package: Any) -> None:
    tree = "self.serialstar(Say(Text='LOUD') if params.Loud else Say(Text='quiet'))"
    assert reported_by(package, tree, Loud=True) == ("Success", ["say Success LOUD!"])


@pytest.mark.parametrize(
    ("tree", "state", "reported"),
    [
        ("self.retry({no_no_yes}, 3)", "Success", ["Failure no", "Failure no", "Success yes"]),
        ("self.retry({no_no_yes}, 2)", "Failure", ["Failure no", "Failure no"]),
        ("self.inverter({no})", "Success", ["Failure no"]),
        ("self.inverter({yes})", "Failure", ["Success yes"]),
        ("self.nofail({no})", "Success", ["Failure no"]),
        ("self.selector({no}, {yes})", "Success", ["Failure no", "Success yes"]),
        ("self.serial({no}, {yes})", "Failure", ["Failure no"]),
        (
            "self.parallelfs(Say(Text='a', Ticks=9), {no})",
            "Failure",
            ["Running a", "Failure no", "Failure stopped"],
        ),
        (
            "self.parallelff(Say(Text='a'), Say(Text='b', Ticks=2))",
            "Success",
            ["Success a!", "Running b", "Success b!"],
        ),
    ],
)
def test_processors_and_decorators(
    package: Any, tree: str, state: str, reported: list[str]
) -> None:
    flaky = {"no_no_yes": 2, "no": 1, "yes": 0}
    calls = {name: f"Flaky(Failures={count})" for name, count in flaky.items()}
    found, texts = reported_by(package, tree.format(**calls))
    assert found == state
    assert [text.split(" ", 1)[1] for text in texts] == reported


def test_a_timeout_stops_what_takes_too_long(package: Any) -> None:
    state, reported = reported_by(package, "self.timeout(Say(Text='a', Ticks=1000000), 0.000001)")
    assert state == "Failure"
    assert reported[-1] == "say Failure stopped"


def test_the_world_model_is_changed_before_post_conditions_are_checked(package: Any) -> None:
    call = "(Piece=params.Product, Target=params.A)"
    assert (
        reported_by(package, f"self.serialstar(Move.move{call})", individuals=True)[0] == "Success"
    )


def test_a_post_condition_that_does_not_hold_fails(package: Any) -> None:
    call = "(Piece=params.Product, Target=params.A)"
    assert (
        reported_by(package, f"self.serialstar(Move.lazy_move{call})", individuals=True)[0]
        == "Failure"
    )


@pytest.mark.parametrize(
    ("name", "reported"), [("mark", "[3.5]"), ("mark_in_skiros2", "skiros:Product")]
)
def test_individuals_can_be_changed_and_found_out(package: Any, name: str, reported: str) -> None:
    after = "Push.push(Force=1.0, Start=params.A, Target=params.Found)"
    tree = f"self.serialstar(Mark.{name}(Piece=params.Product, Container=params.Found), {after})"
    state, texts = reported_by(package, tree, individuals=True)
    assert state == "Success"
    assert texts[0] == f"{name} Success {reported}"
    assert len(set(texts[1].split()[3:])) == 2


@pytest.mark.parametrize(
    ("name", "problem"),
    [
        ("broken", "`execute` raised ZeroDivisionError: division by zero"),
        ("odd", "`execute` returned True, not a result of self.success, self.step or self.fail"),
    ],
)
def test_what_goes_wrong_in_a_primitive_is_reported_in_one_line(
    package: Any, name: str, problem: str
) -> None:
    state, reported = reported_by(package, f"self.serialstar(Broken.{name}())")
    assert state == "Failure"
    assert reported == [f"{name} Failure {problem}"]


def test_hold_conditions_of_primitives_are_checked(package: Any) -> None:
    tree = """self.serialstar(
            Move.move(Piece=params.Product, Target=params.A),
            Held(Piece=params.Product, Place=params.A),
        )"""
    state, reported = reported_by(package, tree, individuals=True)
    assert state == "Failure"
    assert reported[1] == "held Running holding"
    assert "Check failed" in reported[2]


def test_a_value_that_is_needed_and_not_given_fails(package: Any) -> None:
    core = skiros2_core.Core()
    core.load(package("library", SKILLS), "say")
    state, reported = core.run("Say", "say")
    assert state == "Failure"
    assert "`Text`, a str, has no value" in reported[-1]


BAD = """
from .skills import Say


class Bad(SkillDescription):
    def description(self):
        pass


class bad(Bad.SkillBase):
    def expandBT(self, params):
        self.serialstar(Say(Text="hello", Tocks=1))
"""


def test_a_skill_with_errors_is_refused_with_the_message_of_the_check(
    package: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    core = skiros2_core.Core()
    core.load(package("library", SKILLS, bad=BAD), "say")
    logged = capsys.readouterr().out
    assert "library: refused: bad" in logged
    assert "error[EZS523]: `Say` has no parameter `Tocks`" in logged
    with pytest.raises(Exception, match=r"`bad` was refused\s+error\[EZS523\]"):
        core.load("library", "bad")
    assert core.run("Say", "say", Text="x")[0] == "Success"


def test_another_library_calls_the_skills(package: Any) -> None:
    package("library", SKILLS)
    other = """
    from library.skills import Say


    class Other(SkillDescription):
        def description(self):
            pass


    class other(Other.SkillBase):
        def expandBT(self, params):
            self.serialstar(Say(Text="from afar"))
    """
    package("another", other)
    core = skiros2_core.Core()
    core.load("another")
    core.load("library")
    core.load("another", "other")
    assert core.run("Other", "other")[1][0] == "say Success from afar!"


def test_a_skill_of_another_library_with_the_same_name_is_not_taken_for_it(package: Any) -> None:
    package("first", SKILLS)
    package("second", SKILLS + COMPOUND.format(tree="self.serial(Say(Text='x'))", parameters=""))
    core = skiros2_core.Core()
    core.load("first")
    core.load("second", "task")
    state, reported = core.run("Task", "task")
    assert state == "Failure"
    assert "the skill `Say` of `first.skills`, which comes first, not that of" in reported[-1]


def test_an_implementation_that_cannot_be_made_fails(
    package: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    name = package("library", SKILLS + COMPOUND.format(tree="self.serial(Broken())", parameters=""))
    core = skiros2_core.Core()
    core.load(name, "task")
    monkeypatch.setattr(core.instanciator, "add_instance", lambda _name: 1 / 0)
    state, reported = core.run("Task", "task")
    assert state == "Failure"
    assert "ZeroDivisionError" in reported[-1]
