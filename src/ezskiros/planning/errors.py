"""EZS85x and EZS86x: goals, and what stands between a scene and them."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class NoGoal(Error, code="EZS850", name="no-goal"):
    """A goal that is not written as one."""

    title = "this is no goal: {why}"
    help = "write `(skiros:contain skiros:Location-1 skiros:Product-2)`; separate several by commas"
    why: str


class UnknownThing(Error, code="EZS851", name="unknown-thing-in-goal"):
    """Something in a goal that the scene does not have."""

    title = "the scene has no `{spelled}`"
    spelled: str

    class Known(Remark):
        says = "it has {known}"
        known: str


class UnknownProperty(Error, code="EZS852", name="unknown-property-in-goal"):
    """A relation or data property in a goal that the ontology does not have."""

    title = "the ontology has no relation or data property `{spelled}`"
    spelled: str

    class WithPrefix(Remark):
        says = "name one with its prefix, such as `skiros:contain`"


class GoalOutOfReach(Error, code="EZS853", name="goal-out-of-reach"):
    """A goal that no sequence of skills leads to, because of one condition."""

    title = "no skill leads to this: {missing}"
    missing: str

    class Needs(Remark):
        says = "`{skill}` needs {needed}"
        skill: str
        needed: str

    class NeedsThing(Remark):
        says = "`{skill}` needs a {owl_class}, and the scene has none"
        skill: str
        owl_class: str

    class Forbidden(Remark):
        says = "the rules forbid {steps}"
        steps: str

    class Circular(Remark):
        says = (
            "{missing} is not so in the scene, and what makes it so, {skills}, leads back to "
            "these needs"
        )
        missing: str
        skills: str

    class Missing(Remark):
        says = "{missing} is not so in the scene, and no skill makes it so"
        missing: str


class GoalsTogether(Error, code="EZS854", name="goals-together"):
    """Goals that can be reached each for itself."""

    title = "no sequence of skills leads to this"
    note = (
        "each part of it, and each condition on the way, can be reached alone: one undoes another"
    )
    help = "ask for fewer goals at once, or look at what the skills undo: `ezskiros explain`"

    class Forbidden(Remark):
        says = "the rules forbid {steps}"
        steps: str


class PlanningTimeOver(Error, code="EZS855", name="planning-time-over"):
    """A search that took too long."""

    title = "no plan was found in {seconds:g} s"
    note = "whether there is one is not known"
    help = "give it more time with `--seconds`, or name fewer skills: the paths say which are used"
    seconds: float


class SkillLeftOut(Warning, code="EZS856", name="skill-left-out"):
    """A skill that no planner can make use of."""

    title = "`{skill}` cannot be planned with: {why}"
    skill: str
    why: str


class NoSkillsToPlan(Error, code="EZS857", name="no-skills-to-plan"):
    """Files in which nothing is that a plan could be made of."""

    title = "there is no skill here that a plan can be made of"
    help = "name the files of the skills, with their implementations"


class PlanNotConfirmed(Error, code="EZS858", name="plan-not-confirmed"):
    """A plan of the planner that the world model does not agree with."""

    title = "a plan was found that does not work: step {number}, `{skill}`, needs {missing}"
    note = "the ontology says more of these relations than the planner was reported"
    help = "please report it, with the skills and the scene"
    number: int
    skill: str
    missing: str


class GoalIsMet(Warning, code="EZS859", name="goal-is-met"):
    """A goal that holds already."""

    title = "this is so already"
    help = "nothing has to be done"


ALL: tuple[type[Template], ...] = (
    NoGoal,
    UnknownThing,
    UnknownProperty,
    GoalOutOfReach,
    GoalsTogether,
    PlanningTimeOver,
    SkillLeftOut,
    NoSkillsToPlan,
    PlanNotConfirmed,
    GoalIsMet,
)
