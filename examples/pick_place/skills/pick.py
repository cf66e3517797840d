"""Listing 5 of the thesis (Paper IV), as printed."""

from ezskiros import INFERRED, SkillDescription

from .world import cora, rparts, scalable, skiros


# fmt: off
class Pick(SkillDescription):
    def description(self,
            Robot: INFERRED[cora.Robot],
            Arm: INFERRED[rparts.ArmDevice],
            StartPose: INFERRED[skiros.TransformationPose],
            GraspPose: INFERRED[skiros.GraspingPose],
            ApproachPose: INFERRED[skiros.ApproachPose],
            Workstation: INFERRED[scalable.Workstation],
            ObjectLocation: INFERRED[skiros.Location],
            Object: skiros.Product,
            Gripper: rparts.GripperEffector):

        self.pre_conditions += ObjectLocation.contain(Object)
        self.pre_conditions += Gripper.at(StartPose)
        self.pre_conditions += ~ Gripper.contain(Object)
        self.pre_conditions += Object.hasA(ApproachPose)
        self.pre_conditions += Object.hasA(GraspPose)
        self.pre_conditions += Robot.at(Workstation)
        self.pre_conditions += Workstation.contain(ObjectLocation)
        self.post_conditions += ~ Gripper.at(StartPose)
        self.post_conditions += Gripper.at(GraspPose)
        self.post_conditions += ~ ObjectLocation.contain (Object)
        self.post_conditions += Gripper.contain(Object)
