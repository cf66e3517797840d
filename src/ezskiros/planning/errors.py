"""EZS85x: goals, and the reasons why a plan cannot reach them."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class NoGoal(Error, code="EZS850", name="no-goal"):
    """A goal with a syntax error."""

    title = "this is not a valid goal: {why}"
    help = "write `(skiros:contain skiros:Location-1 skiros:Product-2)`; separate goals by commas"
    why: str


class UnknownIndividual(Error, code="EZS851", name="unknown-individual-in-goal"):
    """An individual in a goal that the scene does not have."""

    title = "the scene has no `{spelled}`"
    spelled: str

    class Known(Remark):
        says = "the scene has {known}"
        known: str


class UnknownProperty(Error, code="EZS852", name="unknown-property-in-goal"):
    """A relation or data property in a goal that the ontology does not have."""

    title = "the ontology has no relation or data property `{spelled}`"
    spelled: str

    class WithPrefix(Remark):
        says = "write the name with its prefix, such as `skiros:contain`"


class GoalOutOfReach(Error, code="EZS853", name="goal-out-of-reach"):
    """A goal that no sequence of skills reaches because of one condition."""

    title = "no skill achieves {missing}"
    missing: str

    class Needs(Remark):
        says = "`{skill}` needs {needed}"
        skill: str
        needed: str

    class NeedsIndividual(Remark):
        says = "`{skill}` needs a {owl_class}, but the scene has none"
        skill: str
        owl_class: str

    class Forbidden(Remark):
        says = "the rules forbid {steps}"
        steps: str

    class Circular(Remark):
        says = (
            "{missing} is false in the scene, and the skills that achieve it ({skills}) have the "
            "same needs themselves"
        )
        missing: str
        skills: str

    class Missing(Remark):
        says = "{missing} is false in the scene, and no skill achieves it"
        missing: str


class GoalsTogether(Error, code="EZS854", name="goals-together"):
    """Goals that can be reached one by one but not together."""

    title = "no sequence of skills reaches all goals together"
    note = "each goal and each intermediate condition can be reached alone, but one undoes another"
    help = "give fewer goals at once, or see what the skills undo with `ezskiros explain`"

    class Forbidden(Remark):
        says = "the rules forbid {steps}"
        steps: str


class PlanningTimeOver(Error, code="EZS855", name="planning-time-over"):
    """A search that reached its time limit."""

    title = "no plan was found in {seconds:g} s"
    note = "a plan may still exist"
    help = "increase `--timeout`, or plan with fewer skills by giving fewer paths"
    seconds: float


class SkillLeftOut(Warning, code="EZS856", name="skill-left-out"):
    """A skill that the planner cannot use."""

    title = "the planner cannot use `{skill}`: {why}"
    skill: str
    why: str


class NoSkillsToPlan(Error, code="EZS857", name="no-skills-to-plan"):
    """Files without a skill that the planner can use."""

    title = "these files have no skill that the planner can use"
    help = "give the files of the skills and of their implementations"


class PlanNotConfirmed(Error, code="EZS858", name="plan-not-confirmed"):
    """A plan that fails when it is replayed on the world model."""

    title = "the planner returned a plan that fails: step {number}, `{skill}`, needs {missing}"
    note = "the ontology constrains these relations in ways that the planner does not model"
    help = "please report this defect, with the skills and the scene"
    number: int
    skill: str
    missing: str


class GoalIsMet(Warning, code="EZS859", name="goal-is-met"):
    """A goal that already holds."""

    title = "the goal already holds"
    help = "no plan is needed"


ALL: tuple[type[Template], ...] = (
    NoGoal,
    UnknownIndividual,
    UnknownProperty,
    GoalOutOfReach,
    GoalsTogether,
    PlanningTimeOver,
    SkillLeftOut,
    NoSkillsToPlan,
    PlanNotConfirmed,
    GoalIsMet,
)
