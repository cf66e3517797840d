"""The tasks of the experiments, as behavior trees."""

from ezskiros import INFERRED, SkillDescription
from heron.skills.motions import (
    Drive,
    Grasp,
    MarkAsBlocked,
    Push,
    PutDown,
    Reach,
    TurnBack,
    WaitUntilFree,
    Wipe,
)
from heron.skills.world import heron


class Fetch(SkillDescription):
    """Experiment I: drives to a block, and picks it up."""

    def description(
        self,
        Robot: heron.Robot,
        Start: INFERRED[heron.Place],
        Target: heron.Table,
        Block: INFERRED[heron.Block],
    ):
        self.pre_conditions += Robot.at(Start)
        self.pre_conditions += Start.leadsTo(Target)
        self.pre_conditions += Target.carries(Block)
        self.pre_conditions += ~Robot.holds(Block)
        self.post_conditions += Robot.at(Target)
        self.post_conditions += Robot.holds(Block)


class fetch(Fetch.SkillBase):
    def expandBT(self, params):
        self.serialstar(
            Drive(Target=params.Target),
            Reach(Pose="above"),
            Reach(Pose="down"),
            Grasp(Table=params.Target),
            Reach(Pose="above"),
        )


class Place(SkillDescription):
    """Experiment II: puts the block down."""

    def description(
        self, Robot: heron.Robot, Table: INFERRED[heron.Table], Block: INFERRED[heron.Block]
    ):
        self.pre_conditions += Robot.at(Table)
        self.pre_conditions += Robot.holds(Block)
        self.post_conditions += ~Robot.holds(Block)
        self.post_conditions += Table.carries(Block)


class place(Place.SkillBase):
    def expandBT(self, params):
        self.serialstar(PutDown())


class PlaceInHaste(SkillDescription):
    """Experiment II: on each return, the motion planner demands too much speed of the arm.

    Args:
        Seconds: the time limit for each return.

    """

    def description(
        self,
        Robot: heron.Robot,
        Table: INFERRED[heron.Table],
        Block: INFERRED[heron.Block],
        Seconds: float,
    ):
        self.pre_conditions += Robot.at(Table)
        self.pre_conditions += Robot.holds(Block)
        self.post_conditions += ~Robot.holds(Block)
        self.post_conditions += Table.carries(Block)


class place_in_haste(PlaceInHaste.SkillBase):
    def expandBT(self, params):
        back_and_forth = (
            self.serialstar(
                Reach(Pose="aside", Seconds=2.0), Reach(Pose="above", Seconds=params.Seconds)
            )
            for _ in range(3)
        )
        self.serialstar(*back_and_forth, PutDown())


class CarryToAndFro(SkillDescription):
    """Experiment III: carries the block from one table to the other and back, four times."""

    def description(self, Robot: heron.Robot, Block: INFERRED[heron.Block]):
        self.pre_conditions += Robot.holds(Block)
        self.hold_conditions += Robot.holds(Block)


class carry_to_and_fro(CarryToAndFro.SkillBase):
    def expandBT(self, params):
        poses = ("here", "above_here", "above_there", "there", "above_there", "above_here")
        self.serialstar(*(Reach(Pose=pose) for _ in range(4) for pose in poses))


class TidyUp(SkillDescription):
    """Experiment IV: pushes a box to its mark, and wipes a board.

    If a skill does not succeed in time, the task continues with the next skill.

    Args:
        Patience: the time limit (s) for pushing, and for wiping.

    """

    def description(
        self,
        Robot: heron.Robot,
        Sponge: INFERRED[heron.Block],
        Box: heron.Box,
        Mark: heron.Mark,
        Board: heron.Board,
        Patience: float = 16.0,
    ):
        self.pre_conditions += Robot.holds(Sponge)
        self.hold_conditions += Robot.holds(Sponge)


class tidy_up(TidyUp.SkillBase):
    def expandBT(self, params):
        self.serialstar(
            Reach(Pose="above_box"),
            Reach(Pose="before_box"),
            self.nofail(
                self.timeout(Push(Object=params.Box, Mark=params.Mark), params.Patience),
            ),
            Reach(Pose="above_box"),
            Reach(Pose="before_board"),
            self.nofail(self.timeout(Wipe(Board=params.Board), params.Patience)),
            Reach(Pose="home"),
        )


class Deliver(SkillDescription):
    """Experiment VI: drives to a place behind a junction, on the path straight on."""

    def description(
        self,
        Robot: heron.Robot,
        Begin: INFERRED[heron.Place],
        Junction: INFERRED[heron.Place],
        Place: heron.Place,
    ):
        self.pre_conditions += Robot.at(Begin)
        self.pre_conditions += Begin.leadsTo(Junction)
        self.pre_conditions += Junction.leadsTo(Place)
        self.post_conditions += Robot.at(Place)


class deliver(Deliver.SkillBase):
    def expandBT(self, params):
        self.serialstar(
            Drive(Start=params.Begin, Target=params.Junction),
            Drive(Start=params.Junction, Target=params.Place),
        )


class GiveWay(SkillDescription):
    """Waits for a free path. After the longest wait, turns back and marks the path as blocked.

    Each step has a deadline, in case a server never answers: 53 s in all.

    Args:
        Seconds: the longest wait, at most 12.

    """

    def description(
        self, Robot: heron.Robot, Start: heron.Place, Target: heron.Place, Seconds: float
    ):
        self.pre_conditions += Robot.at(Start)
        self.pre_conditions += Start.leadsTo(Target)


class give_way(GiveWay.SkillBase):
    def expandBT(self, params):
        self.selectorstar(
            self.timeout(WaitUntilFree(Seconds=params.Seconds), 12.0),
            self.serialstar(
                self.timeout(TurnBack(), 40.0),
                self.timeout(MarkAsBlocked(), 1.0),
            ),
        )
