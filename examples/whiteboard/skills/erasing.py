"""The task: a compound skill of the motions."""

from ezskiros import INFERRED, SkillDescription

from .motions import Drive, Reach, Wipe
from .world import cora, office, rparts, skiros


class Erase(SkillDescription):
    """Drives to a board and erases it.

    Args:
        Board: the board to erase.

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
    """Drives, reaches and wipes."""

    def expandBT(self, params):
        self.serialstar(
            Drive(Target=params.Board),
            Reach(),
            Wipe(),
        )
