"""The task: picks a product, and places it at another location."""

from ezskiros import INFERRED, SkillDescription

from .motions import Drive
from .pick import Pick
from .place import Place
from .world import cora, rparts, scalable, skiros


class PickAndPlace(SkillDescription):
    """Takes a product to another location.

    Args:
        Object: the product.
        PlacingLocation: the location of the product afterwards.

    """

    def description(
        self,
        Robot: INFERRED[cora.Robot],
        Workstation: INFERRED[scalable.Workstation],
        ObjectLocation: INFERRED[skiros.Location],
        Object: skiros.Product,
        StartPose: INFERRED[skiros.TransformationPose],
        ApproachPose: INFERRED[skiros.ApproachPose],
        GraspPose: INFERRED[skiros.GraspingPose],
        Gripper: rparts.GripperEffector,
        PlacingLocation: skiros.Location,
    ):
        self.pre_conditions += Robot.at(Workstation)
        self.pre_conditions += Workstation.contain(ObjectLocation)
        self.pre_conditions += ObjectLocation.contain(Object)
        self.pre_conditions += Object.hasA(ApproachPose)
        self.pre_conditions += Object.hasA(GraspPose)
        self.pre_conditions += Gripper.at(StartPose)
        self.pre_conditions += ~Gripper.contain(Object)
        self.post_conditions += PlacingLocation.contain(Object)
        self.post_conditions += ~Gripper.contain(Object)


class pick_and_place(PickAndPlace.SkillBase):
    """Tries to pick a second time if the first pick fails."""

    def expandBT(self, params):
        self.serialstar(
            self.retry(Pick.pick(), 2),
            Drive(Target=params.PlacingLocation),
            Place.place(),
        )
