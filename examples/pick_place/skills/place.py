"""Places the product that the gripper holds."""

from ezskiros import INFERRED, SkillDescription

from .motions import ActuateGripper, ApproachMovement, SwitchController
from .waiting import Wait
from .world import cora, rparts, skiros
from .world_model import WmMoveObject


class Place(SkillDescription):
    """Puts a product that the gripper holds at a location.

    Args:
        PlacingLocation: the location of the product afterwards.
        Speed: the speed of the approach, in m/s.

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


class place(Place.SkillBase):
    """Opens the gripper at the location."""

    def expandBT(self, params):
        self.serialstar(
            SwitchController(Controller="compliant"),
            ApproachMovement.go_to_linear(Target=params.PlacingLocation, Speed=params.Speed),
            ActuateGripper(Open=True),
            Wait(Duration=1.0),
            WmMoveObject(TargetLocation=params.PlacingLocation),
        )
