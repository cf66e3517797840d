"""Motions of the arm, of the gripper and of the robot. Each motion is simulated in a few ticks."""

from ezskiros import INFERRED, SkillDescription, specified

from .world import cora, rparts, skiros, sumo

TICKS = 5
"""The duration of a simulated motion, in ticks."""


class SwitchController(SkillDescription):
    """Changes the controller of the arm.

    Args:
        Controller: the name of the controller, such as `joint_config` or `compliant`.

    """

    def description(self, Controller: str):
        pass


class switch_controller(SwitchController.SkillBase):
    """Ends at once."""

    def execute(self):
        return self.success(f"{self.params.Controller} is active")


class MoveitCartesianSpaceMotion(SkillDescription):
    """Moves the gripper to a pose, around obstacles.

    Args:
        GoalPose: the pose of the gripper afterwards.

    """

    def description(self, GoalPose: skiros.TransformationPose):
        self.pre_conditions += specified(GoalPose)


class ApproachMovement(SkillDescription):
    """Moves the gripper slowly until it touches an object.

    Args:
        Target: the object that the gripper touches.
        Speed: the speed, in m/s.

    """

    def description(self, Target: sumo.Object, Speed: float = 0.1):
        self.pre_conditions += specified(Target)


class moveit_cartesian_space_motion(MoveitCartesianSpaceMotion.SkillBase):
    """Moves closer to the goal with each tick."""

    def onStart(self):
        self.left = TICKS
        return True

    def execute(self):
        if self.left == 0:
            return self.success(f"at {self.params.GoalPose}")
        self.left -= 1
        return self.step(f"on the way to {self.params.GoalPose}")

    def onPreempt(self):
        return self.fail("the arm has stopped", -406)


class go_to_linear(ApproachMovement.SkillBase):
    """Moves on a straight line."""

    def onStart(self):
        self.left = TICKS
        return self.params.Speed > 0.0

    def execute(self):
        if self.left == 0:
            return self.success(f"at {self.params.Target}")
        self.left -= 1
        return self.step(f"{self.params.Speed} m/s to {self.params.Target}")

    def onPreempt(self):
        return self.fail("the arm has stopped", -406)


class ActuateGripper(SkillDescription):
    """Opens or closes the gripper.

    Args:
        Open: True to open the gripper, False to close it.

    """

    def description(self, Gripper: rparts.GripperEffector, Open: bool):
        self.pre_conditions += specified(Gripper)


class actuate_gripper(ActuateGripper.SkillBase):
    """Ends at once."""

    def execute(self):
        return self.success(f"{self.params.Gripper} is {'open' if self.params.Open else 'closed'}")


class Drive(SkillDescription):
    """Drives the robot to another place.

    Args:
        Target: the place of the robot afterwards.

    """

    def description(
        self,
        Robot: cora.Robot,
        StartLocation: INFERRED[skiros.Location],
        Target: skiros.Location,
    ):
        self.pre_conditions += Robot.at(StartLocation)
        self.post_conditions += Robot.at(Target)


class drive(Drive.SkillBase):
    """Drives in a straight line."""

    def onStart(self):
        self.left = TICKS
        return True

    def execute(self):
        if self.left == 0:
            self.world.relate(self.params.Robot, skiros.at, self.params.Target)
            return self.success(f"at {self.params.Target}")
        self.left -= 1
        return self.step(f"on the way to {self.params.Target}")
