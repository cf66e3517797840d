"""The sources of parameter values: the call, siblings, the world model, or new individuals."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros.driver import UnknownSkillError
from ezskiros.engine.arguments import WrongArgumentError
from ezskiros.engine.events import Happened
from support.engine import Skills

SCENE = """
cora:Robot-1 a cora:Robot ; rdfs:label "heron" ; skiros:at skiros:Location-2 .
skiros:Location-2 a skiros:Location ; rdfs:label "bench" ;
    skiros:contain skiros:Product-4 , skiros:Product-5 .
skiros:Location-3 a skiros:Location ; rdfs:label "shelf" .
skiros:Product-4 a skiros:Product ; rdfs:label "nut" ; skiros:Weight 2.0 .
skiros:Product-5 a skiros:Product ; rdfs:label "bolt" ; skiros:Weight 0.5 .
"""
SOURCE = """
class Grade(enum.Enum):
    FINE = 1
    COARSE = 2


class Find(SkillDescription):
    def description(
        self, Robot: INFERRED[cora.Robot], Place: INFERRED[skiros.Location],
        Object: INFERRED[skiros.Product], Grade: Grade = Grade.FINE, Speed: float = 1,
        Count: int = 1, Careful: bool = False, Note: str = "",
    ):
        self.pre_conditions += Robot.at(Place)
        self.pre_conditions += Place.contain(Object)
        self.pre_conditions += Object.Weight < 1.0


class find(Find.SkillBase):
    def execute(self):
        given = self.params
        return self.success(
            f"{given.Object} {given.Grade.name} {given.Speed} {given.Count} {given.Careful} "
            f"{given.Note}"
        )


class Drive(SkillDescription):
    def description(
        self, Robot: cora.Robot, Start: INFERRED[skiros.Location], Goal: skiros.Location,
    ):
        self.pre_conditions += Robot.at(Start)


class drive(Drive.SkillBase):
    def execute(self):
        self.world.relate(self.params.Robot, skiros.at, self.params.Goal)
        return self.success(f"from {self.params.Start}")


class Round(SkillDescription):
    def description(self, Robot: cora.Robot, Here: skiros.Location, There: skiros.Location):
        self.pre_conditions += Robot.at(Here)


class there_and_back(Round.SkillBase):
    def expandBT(self, params):
        self.serialstar(Drive(Goal=params.There), Drive(Goal=params.Here))


class Weigh(SkillDescription):
    def description(
        self, Object: skiros.Product, Weight: OUTPUT[float], Box: OUTPUT[skiros.Container],
        Grade: OUTPUT[Grade],
    ):
        self.post_conditions += Box.contain(Object)


class weigh(Weigh.SkillBase):
    def execute(self):
        self.params.Weight = 3
        self.params.Box = self.world.new(skiros.Container)
        self.params.Grade = Grade.COARSE
        self.world.relate(self.params.Box, skiros.contain, self.params.Object)
        return self.success("done")


class Tell(SkillDescription):
    def description(self, Text: float, Box: skiros.Container):
        self.pre_conditions += ~Box.hasA(Box) if False else Box.ContainerState == "Empty"


class Pack(SkillDescription):
    def description(self, Object: skiros.Product, Weight: OUTPUT[float]):
        pass


class pack(Pack.SkillBase):
    def expandBT(self, params):
        self.serialstar(Weigh(), Show(Value=params.Weight))


class Show(SkillDescription):
    def description(self, Value: float):
        pass


class show(Show.SkillBase):
    def execute(self):
        return self.success(f"it weighs {self.params.Value!r}")
"""
SOURCE = SOURCE.replace(SOURCE[SOURCE.index("class Tell") : SOURCE.index("class Pack")], "")


@pytest.fixture
def skills(tmp_path: Path) -> Skills:
    return Skills(tmp_path, SOURCE, SCENE)


def test_what_is_inferred_fits_all_pre_conditions(skills: Skills) -> None:
    ran = skills.run("find", "Speed=2", "Count=3", "Careful=true", "Grade=COARSE", "Note=a=b")
    assert ran.notes[-1] == "skiros:Product-5 COARSE 2.0 3 True a=b"
    assert {name: str(value) for name, value in ran.events[0].values.items()} == {
        "Robot": "cora:Robot-1", "Place": "skiros:Location-2", "Object": "skiros:Product-5",
        "Grade": "Grade.COARSE", "Speed": "2.0", "Count": "3", "Careful": "True", "Note": "a=b",
    }  # fmt: skip


def test_properties_compare_as_written_but_for_skiros2(skills: Skills) -> None:
    skills.options["compatible"] = True
    ran = skills.run("find")
    assert not ran.outcome.is_success
    assert "Object.Weight < 1.0" in ran.reason
    skills.scene = SCENE.replace("0.5", "1.0")
    assert not skills.run("find").outcome.is_success


def test_of_several_the_first_by_name_is_taken_and_the_others_are_reported(skills: Skills) -> None:
    skills.scene = SCENE.replace("2.0", "0.2")
    ran = skills.run("find")
    chosen = [each.text for each in ran.events if each.happened is Happened.CHOSEN]
    place = "Robot=cora:Robot-1, Place=skiros:Location-2"
    assert chosen == [
        f"{place}, Object=skiros:Product-4; it could be {place}, Object=skiros:Product-5"
    ]
    skills.options["choose"] = lambda _, solutions: solutions[1]
    assert "skiros:Product-5" in skills.run("find").notes[-1]


def test_what_cannot_be_inferred_is_reported_with_the_condition(skills: Skills) -> None:
    skills.scene = SCENE.replace("0.5", "5.0")
    reason = skills.run("find").reason
    assert reason.startswith("pre-condition does not hold: Object.Weight < 1.0 (")
    skills.scene = SCENE.replace("skiros:Product-4 , skiros:Product-5", "skiros:Location-3")
    reason = skills.run("find").reason
    assert reason.startswith("pre-condition does not hold: Place.contain(Object) (")
    assert reason.endswith("skiros:contain skiros:Location-3")
    skills.scene = "skiros:Location-2 a skiros:Location ."
    assert skills.run("find").reason.startswith(
        "the world has no individual for `Robot`, a cora.Robot ("
    )


def test_a_second_child_infers_again_what_does_not_hold_any_more(skills: Skills) -> None:
    ran = skills.run("Round", "Robot=heron", "Here=bench", "There=shelf")
    assert ran.outcome.is_success
    assert [text for text in ran.notes if text.startswith("from")] == [
        "from skiros:Location-2", "from skiros:Location-3",
    ]  # fmt: skip


def test_what_a_child_gives_its_value_another_one_has(skills: Skills) -> None:
    ran = skills.run("pack", "Object=nut")
    assert "it weighs 3.0" in ran.notes
    assert ran.outcome.is_success


def test_what_is_simulated_makes_post_conditions_hold_and_values_up(skills: Skills) -> None:
    skills.options["simulate"] = True
    ran = skills.run("Weigh", "Object=nut")
    assert ran.outcome.is_success
    assert ran.notes[-1] == "simulated"
    box, product = (ran.world.named(f"skiros:{name}")[0] for name in ("Container-6", "Product-4"))
    assert ran.world.related(box, "http://rvmi.aau.dk/ontologies/skiros.owl#contain") == [product]
    assert skills.run("pack", "Object=nut").outcome.is_success
    there = skills.run("Round", "Robot=heron", "Here=bench", "There=shelf")
    assert there.outcome.is_success


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("self.params.Weight = 3", "the skill has not set `Weight` ("),
        (
            "self.params.Box = self.world.new(skiros.Container)",
            "'NoneType' object has no attribute",
        ),
    ],
)
def test_outputs_have_to_be_given_a_value(skills: Skills, line: str, said: str) -> None:
    skills.source = SOURCE.replace(line, "pass")
    assert said in skills.run("Weigh", "Object=nut").reason


def test_an_output_of_before_is_none_of_now(skills: Skills) -> None:
    skills.source = SOURCE.replace(
        "self.serialstar(Weigh(), Show", "self.serialstar(Weigh(), Weigh(), Show"
    )
    skills.source = skills.source.replace(
        "        self.params.Weight = 3\n",
        "        boxes = self.world.individuals(skiros.Container)\n"
        "        if self.world.individual('nut') and not boxes:\n"
        "            self.params.Weight = 3\n",
    )
    ran = skills.run("pack", "Object=nut")
    assert ran.ends() == ["Weigh succeeded", "Weigh#2 failed", "pack failed"]
    assert ran.reason.startswith("the skill has not set `Weight`")


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("self.params.Weight = 'much'", "`Weight` must be a float, but the value is 'much'"),
        ("setattr(self.params, 'Wight', 3)",
         "`Weigh` has no parameter `Wight`; did you mean `Weight`?"),
        ("self.params.Box = self.params.Object", "`Box` must be a skiros.Container, but "
         "the value is skiros:Product-4"),
        ("self.world.relate(self.params.Object, 'skiros:contian', self.params.Object)",
         "the ontology has no relation 'skiros:contian'; did you mean skiros:contain?"),
        ("self.world.set_value(self.params.Object, skiros.at, 2.0)",
         "the ontology has no data property 'skiros:at'"),
        ("self.world.individual('screw')", "there is no 'screw' in the world"),
    ],
)  # fmt: skip
def test_wrong_names_and_values_are_reported(skills: Skills, line: str, said: str) -> None:
    skills.source = SOURCE.replace("self.params.Weight = 3", line)
    assert said in skills.run("Weigh", "Object=nut").reason


@pytest.mark.parametrize(
    ("skill", "texts", "said"),
    [
        ("Drive", ["Robot=heron", "Goal=nut"], "`Goal`: skiros:Product-4 has the class "
         "skiros:Product, but must be a skiros.Location; choose from skiros:Location-2 (bench), "
         "skiros:Location-3 (shelf)"),
        ("Drive", ["Robot=hero", "Goal=shelf"],
         "`Robot`: there is no 'hero' in the world; choose from cora:Robot-1 (heron)"),
        ("Drive", ["Robot=heron"], "`Goal`, a skiros.Location, is not given: Goal=...; choose from "
         "skiros:Location-2 (bench), skiros:Location-3 (shelf)"),
        ("Drive", ["Robot=heron", "Gaol=shelf"],
         "`Drive` has no parameter `Gaol`; did you mean `Goal`?"),
        ("Drive", ["Goal=shelf", "Goal=bench"], "`Goal` is given twice"),
        ("Weigh", ["Weight=3"], "`Weight` cannot be given, because `Weigh` sets this output"),
        ("find", ["Speed=fast"], "`Speed`: 'fast' is not a float"),
        ("find", ["Careful=yes"], "`Careful`: 'yes' is not a bool (true or false)"),
        ("find", ["Count=1.5"], "`Count`: '1.5' is not an int"),
        ("find", ["Grade=SMOOTH"], "`Grade`: 'SMOOTH' is not one of FINE, COARSE"),
    ],
)  # fmt: skip
def test_wrong_arguments_say_what_would_do(
    skills: Skills, skill: str, texts: list[str], said: str
) -> None:
    with pytest.raises(WrongArgumentError) as problem:
        skills.run(skill, *texts)
    assert str(problem.value) == said


def test_a_label_that_several_individuals_have_is_no_name(skills: Skills) -> None:
    skills.scene = SCENE.replace("shelf", "bench")
    with pytest.raises(WrongArgumentError, match="several individuals are called 'bench'"):
        skills.run("Drive", "Robot=heron", "Goal=bench")


def test_unknown_skills_say_which_there_are(skills: Skills) -> None:
    with pytest.raises(UnknownSkillError, match=r"there is no skill `Drvie` .*mean `Drive`\?"):
        skills.run("Drvie")
    with pytest.raises(UnknownSkillError, match="there is Drive, Find, Pack"):
        skills.run("Zzz")


LOCKS = """
class Use(SkillDescription):
    def description(self, Robot: LOCK[cora.Robot], Ticks: int = 2):
        self.post_conditions += generated(Robot)


class use(Use.SkillBase):
    def onStart(self):
        self.count = 0
        return True

    def execute(self):
        self.count += 1
        return self.success("used") if self.count > self.params.Ticks else self.step("using")


class Twice(SkillDescription):
    def description(self, Robot: LOCK[cora.Robot]):
        self.post_conditions += generated(Robot)


class at_once(Twice.SkillBase):
    def expandBT(self, params):
        self.parallelff(Use(), Use())


class one_by_one(Twice.SkillBase):
    def expandBT(self, params):
        self.serialstar(Use(), Use())


class Eat(SkillDescription):
    def description(self, Object: CONSUME[skiros.Product], Place: UNSPECIFY[skiros.Location]):
        self.pre_conditions += Place.contain(Object)


class eat(Eat.SkillBase):
    def execute(self):
        self.world.remove(self.params.Object)
        return self.success("eaten")


class Meal(SkillDescription):
    def description(self, Object: skiros.Product, Place: skiros.Location):
        self.pre_conditions += Place.contain(Object)


class meal(Meal.SkillBase):
    def expandBT(self, params):
        self.serialstar(Eat(), Eat())
"""


def test_what_is_locked_is_used_by_one_at_a_time(tmp_path: Path) -> None:
    skills = Skills(tmp_path, LOCKS, SCENE)
    assert skills.run("one_by_one", "Robot=heron").outcome.is_success
    ran = skills.run("at_once", "Robot=heron")
    assert ran.reason == "`Robot`, cora:Robot-1, is locked by at_once/Use"
    assert ran.ends() == ["Use#2 failed", "Use preempted", "at_once failed"]


def test_what_is_consumed_is_gone_and_its_parameter_is_empty(tmp_path: Path) -> None:
    skills = Skills(tmp_path, LOCKS, SCENE)
    ran = skills.run("meal", "Object=nut", "Place=bench")
    assert ran.ends() == ["Eat succeeded", "Eat#2 failed", "meal failed"]
    assert ran.reason.startswith("`Object`, a skiros.Product, has no value (")
    skills.source = LOCKS.replace("self.world.remove", "print")
    reason = skills.run("eat", "Object=nut", "Place=bench").reason
    assert reason.startswith("post-condition does not hold: Object (")


LOUDNESS = """
class Listen(SkillDescription):
    def description(self, Value: OPTIONAL[float] = 1.0, Note: OPTIONAL[str] = ""): ...


class listen(Listen.SkillBase):
    def execute(self):
        heard = self.params.Value
        self.params.Value = heard + 2.5
        return self.success(f"heard {heard}")


class Show(SkillDescription):
    def description(self, Value: float, Note: OPTIONAL[str]): ...


class show(Show.SkillBase):
    def execute(self):
        return self.success(f"shows {self.params.Value} {self.params.Note}")


class Hear(SkillDescription):
    def description(self): ...


class hear(Hear.SkillBase):
    def expandBT(self, params):
        self.serialstar(Listen(), Show(), Listen(Value=2.0), Show(), Listen(), Show())
"""


@pytest.mark.parametrize("simulate", [False, True])
def test_a_default_that_is_set_is_passed_on_and_takes_nothing(
    tmp_path: Path, simulate: bool
) -> None:
    skills = Skills(tmp_path, LOUDNESS)
    skills.options["simulate"] = simulate
    ran = skills.run("hear")
    assert ran.outcome.is_success, ran.reason
    if not simulate:
        reported = [each for each in ran.notes if each not in ("Start", "End")]
        shown = "shows 3.5 None"
        assert reported == ["heard 1.0", shown, "heard 2.0", shown, "heard 1.0", shown]
