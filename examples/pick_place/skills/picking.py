"""Listing 7 of the thesis (Paper IV), as printed, with the commas that the print omits."""

from .motions import (
    ActuateGripper,
    ApproachMovement,
    MoveitCartesianSpaceMotion,
    SwitchController,
)
from .perception import HSVDetection
from .pick import Pick
from .waiting import Wait
from .world_model import WmMoveObject, WmSetRelation


# fmt: off
# ruff: noqa: E501
class pick(Pick.SkillBase):
    def expandBT(self, params):
        self.serialstar(
            SwitchController(Controller='joint_config'),
            MoveitCartesianSpaceMotion(GoalPose=params.ApproachPose),
            WmSetRelation.wm_set_relation(Src=params.Gripper, Dst=params.ApproachPose, Relation='skiros.at', RelationState=True),
            HSVDetection(),
            SwitchController(Controller='compliant'),
            ApproachMovement.go_to_linear(Target=params.GraspPose),
            WmSetRelation.wm_set_relation(Src=params.Gripper, Dst=params.GraspPose, Relation='skiros.at', RelationState=True),
            Wait(Duration=2.0),
            ActuateGripper(Open=False),
            WmMoveObject(TargetLocation=params.Gripper),
            ApproachMovement.go_to_linear(Target=params.ApproachPose),
            Wait(Duration=2.0)
        )
