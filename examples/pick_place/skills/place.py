"""The other half: puts down what the gripper holds."""

from ezskiros import INFERRED, SkillDescription

from .world import cora, rparts, skiros


class Place(SkillDescription):
    """Puts a product that the gripper holds at a location.

    Args:
        PlacingLocation: where it goes.
        Speed: of the approach, in m/s.

    """

    def description(
        self,
        Robot: INFERRED[cora.Robot],
        Object: INFERRED[skiros.Product],
        Gripper: rparts.GripperEffector,
        PlacingLocation: skiros.Location,
        Speed: float = 0.1,
    ):
        self.pre_conditions += Robot.at(PlacingLocation)
        self.pre_conditions += Gripper.contain(Object)
        self.hold_conditions += Robot.at(PlacingLocation)
        self.post_conditions += ~Gripper.contain(Object)
        self.post_conditions += PlacingLocation.contain(Object)
