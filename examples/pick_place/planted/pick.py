"""Listing 5 of the thesis (Paper IV) in short, with three mistakes."""

from pathlib import Path

from ezskiros import INFERRED, SkillDescription
from ezskiros.ontology import load

world = load(Path(__file__).parents[1] / "ontology")
rparts, skiros = world.rparts, world.skiros


class PickInHaste(SkillDescription):
    """The mistake of the thesis (section 6), a misspelt relation, and a contradiction."""

    def description(
        self,
        Object: skiros.Product,
        Gripper: rparts.GripperEffector,
        GraspPose: INFERRED[skiros.GraspingPose],
    ):
        self.pre_conditions += Object.hasA(Gripper)
        self.pre_conditions += Object.hasAA(GraspPose)
        self.post_conditions += ~Gripper.contain(Object)
        self.post_conditions += Gripper.contain(Object)
