"""The task: a compound of the motions."""

from ezskiros import INFERRED, SkillDescription

from .motions import Drive, Reach, Wipe
from .world import cora, office, rparts, skiros


class Erase(SkillDescription):
    """Drives to a board and erases it.

    Args:
        Board: which one.

    """

    def description(
        self,
        Robot: cora.Robot,
        Start: INFERRED[skiros.Location],
        Gripper: rparts.GripperEffector,
        Sponge: INFERRED[office.Sponge],
        Board: office.Whiteboard,
    ):
        self.pre_conditions += Robot.at(Start)
        self.pre_conditions += Gripper.contain(Sponge)
        self.post_conditions += Board.Clean == True  # noqa: E712


class erase(Erase.SkillBase):
    """Drive, reach, wipe."""

    def expandBT(self, params):
        self.serialstar(
            Drive(Target=params.Board),
            Reach(),
            Wipe(),
        )
