"""Simulated motions. Each motion declares its permits, and the interfaces that it uses."""

from ezskiros import INFERRED, SkillDescription, closeness, contact, force, server, speed, topic

from .world import cora, office, rparts, skiros

TICKS = 5
"""The duration of a simulated motion, in ticks."""
ARM = "/arm_controller/follow_joint_trajectory"


class Drive(SkillDescription):
    """Drives the robot to another place.

    Args:
        Target: the place of the robot afterwards.

    """

    def description(
        self,
        Robot: cora.Robot,
        Start: INFERRED[skiros.Location],
        Target: skiros.Location,
    ):
        self.pre_conditions += Robot.at(Start)
        self.post_conditions += Robot.at(Target)
        self.permits += speed("0.5 m/s")
        self.uses += topic("/cmd_vel", "geometry_msgs/Twist")
        self.uses += server("/move_base", "move_base_msgs/MoveBase")


class Reach(SkillDescription):
    """Moves the gripper until it almost touches a board.

    Args:
        Board: the board in front of the robot.

    """

    def description(
        self, Robot: cora.Robot, Gripper: rparts.GripperEffector, Board: office.Whiteboard
    ):
        self.pre_conditions += Robot.at(Board)
        self.post_conditions += Gripper.at(Board)
        self.permits += closeness(Board, "2 cm")
        self.permits += speed("0.1 m/s")
        self.uses += server(ARM, "control_msgs/FollowJointTrajectory")


class Wipe(SkillDescription):
    """Wipes a board with the sponge that is in the gripper.

    Args:
        Board: the board at the gripper.

    """

    def description(
        self,
        Gripper: rparts.GripperEffector,
        Sponge: INFERRED[office.Sponge],
        Board: office.Whiteboard,
    ):
        self.pre_conditions += Gripper.at(Board)
        self.pre_conditions += Gripper.contain(Sponge)
        self.post_conditions += Board.Clean == True  # noqa: E712
        self.permits += contact(Board)
        self.permits += force(Board, "20 N")
        self.permits += speed("0.2 m/s")
        self.uses += server(ARM, "control_msgs/FollowJointTrajectory")


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


class reach(Reach.SkillBase):
    """Moves on a straight line."""

    def onStart(self):
        self.left = TICKS
        return True

    def execute(self):
        if self.left == 0:
            self.world.relate(self.params.Gripper, skiros.at, self.params.Board)
            return self.success(f"at {self.params.Board}")
        self.left -= 1
        return self.step(f"on the way to {self.params.Board}")


class wipe(Wipe.SkillBase):
    """Wipes stroke by stroke."""

    def onStart(self):
        self.left = TICKS
        return True

    def execute(self):
        if self.left == 0:
            self.world.set_value(self.params.Board, office.Clean, True)
            return self.success(f"{self.params.Board} is clean")
        self.left -= 1
        return self.step(f"{self.left} strokes are left")
