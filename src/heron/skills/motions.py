"""The motions of the robot. Each motion is a goal for an action server."""

from ezskiros import INFERRED, SkillDescription, contact, force, server
from heron.goals import ARM, LOOK_OUT, NAVIGATE
from heron.skills.servers import SentGoal
from heron.skills.world import heron


class Drive(SkillDescription):
    """Drives the base along a path, from one place to another."""

    def description(self, Robot: heron.Robot, Start: INFERRED[heron.Place], Target: heron.Place):
        self.pre_conditions += Robot.at(Start)
        self.pre_conditions += Start.leadsTo(Target)
        self.post_conditions += Robot.at(Target)


class drive(Drive.SkillBase):
    def onStart(self):
        self.sent = SentGoal(NAVIGATE, {"place": str(self.params.Target)})
        return True

    def execute(self):
        if self.sent.is_reached is None:
            return self.step(f"on the way to {self.params.Target}")
        if not self.sent.is_reached:
            return self.fail(f"no path to {self.params.Target}")
        self.world.relate(self.params.Robot, heron.at, self.params.Target)
        return self.success(f"at {self.params.Target}")

    def onPreempt(self):
        self.sent.cancel()
        return self.fail("the base has stopped")


class TurnBack(SkillDescription):
    """Drives the base back along an unfinished path, to the start of the path."""

    def description(self, Robot: heron.Robot, Start: heron.Place):
        self.pre_conditions += Robot.at(Start)
        self.post_conditions += Robot.at(Start)


class turn_back(TurnBack.SkillBase):
    def onStart(self):
        self.sent = SentGoal(NAVIGATE, {"place": str(self.params.Start)})
        return True

    def execute(self):
        if self.sent.is_reached is None:
            return self.step(f"back to {self.params.Start}")
        if not self.sent.is_reached:
            return self.fail(f"no path back to {self.params.Start}")
        return self.success(f"back at {self.params.Start}")

    def onPreempt(self):
        self.sent.cancel()
        return self.fail("the base has stopped")


class WaitUntilFree(SkillDescription):
    """Waits until the path ahead is free.

    Args:
        Seconds: the longest wait; then the skill fails.

    """

    def description(self, Seconds: float):
        pass


class wait_until_free(WaitUntilFree.SkillBase):
    def onStart(self):
        self.sent = SentGoal(LOOK_OUT, {"seconds": self.params.Seconds})
        return True

    def execute(self):
        if self.sent.is_reached is None:
            return self.step("waiting until the path is free")
        if not self.sent.is_reached:
            return self.fail("the path is still blocked")
        return self.success("the path is free")

    def onPreempt(self):
        self.sent.cancel()
        return self.fail("the wait was cancelled")


class MarkAsBlocked(SkillDescription):
    """Marks a path as blocked in the world model."""

    def description(self, Start: heron.Place, Target: heron.Place):
        self.pre_conditions += Start.leadsTo(Target)
        self.post_conditions += ~Start.leadsTo(Target)


class mark_as_blocked(MarkAsBlocked.SkillBase):
    def execute(self):
        self.world.unrelate(self.params.Start, heron.leadsTo, self.params.Target)
        return self.success(f"no path from {self.params.Start} to {self.params.Target}")


class Reach(SkillDescription):
    """Moves the hand to a pose that the arm knows by name.

    Args:
        Pose: the name of the pose.
        Seconds: the time limit; with 0, the arm chooses its own speed.

    """

    def description(self, Pose: str, Seconds: float = 0.0):
        pass


class reach(Reach.SkillBase):
    def onStart(self):
        self.sent = SentGoal(ARM, {"pose": self.params.Pose, "seconds": self.params.Seconds})
        return True

    def execute(self):
        if self.sent.is_reached is None:
            return self.step(f"on the way to {self.params.Pose}")
        if not self.sent.is_reached:
            return self.fail(f"{self.params.Pose} was not reached")
        return self.success(f"at {self.params.Pose}")

    def onPreempt(self):
        self.sent.cancel()
        return self.fail("the arm has stopped")


class Grasp(SkillDescription):
    """Closes the fingers around a block that is between them."""

    def description(
        self, Robot: heron.Robot, Table: INFERRED[heron.Table], Block: INFERRED[heron.Block]
    ):
        self.pre_conditions += Robot.at(Table)
        self.pre_conditions += Table.carries(Block)
        self.pre_conditions += ~Robot.holds(Block)
        self.post_conditions += Robot.holds(Block)
        self.post_conditions += ~Table.carries(Block)


class grasp(Grasp.SkillBase):
    def onStart(self):
        self.sent = SentGoal(ARM, {"pose": "grasp"})
        return True

    def execute(self):
        if self.sent.is_reached is None:
            return self.step("closing the fingers")
        if not self.sent.is_reached:
            return self.fail("nothing is between the fingers")
        self.world.relate(self.params.Robot, heron.holds, self.params.Block)
        self.world.unrelate(self.params.Table, heron.carries, self.params.Block)
        return self.success(f"holds {self.params.Block}")


class PutDown(SkillDescription):
    """Places the block in the hand on a table, compliantly."""

    def description(
        self, Robot: heron.Robot, Table: INFERRED[heron.Table], Block: INFERRED[heron.Block]
    ):
        self.pre_conditions += Robot.at(Table)
        self.pre_conditions += Robot.holds(Block)
        self.post_conditions += ~Robot.holds(Block)
        self.post_conditions += Table.carries(Block)


class put_down(PutDown.SkillBase):
    def onStart(self):
        self.sent = SentGoal(ARM, {"pose": "place"})
        return True

    def execute(self):
        if self.sent.is_reached is None:
            return self.step("on the way down")
        if not self.sent.is_reached:
            return self.fail("the block was not put down")
        self.world.unrelate(self.params.Robot, heron.holds, self.params.Block)
        self.world.relate(self.params.Table, heron.carries, self.params.Block)
        return self.success(f"{self.params.Block} is on {self.params.Table}")

    def onPreempt(self):
        self.sent.cancel()
        return self.fail("the arm has stopped")


class Push(SkillDescription):
    """Pushes a box along a table to a mark, with the tool in the hand."""

    def description(
        self, Robot: heron.Robot, Sponge: INFERRED[heron.Block], Object: heron.Box, Mark: heron.Mark
    ):
        self.pre_conditions += Robot.holds(Sponge)
        self.post_conditions += Object.standsOn(Mark)
        self.permits += contact(Object)
        self.permits += force(Object, "30 N")
        self.uses += server(ARM)


class push(Push.SkillBase):
    def onStart(self):
        self.sent = SentGoal(ARM, {"pose": "push"})
        return True

    def execute(self):
        if self.sent.is_reached is None:
            return self.step(f"pushing {self.params.Object}")
        if not self.sent.is_reached:
            return self.fail(f"{self.params.Mark} was not reached")
        self.world.relate(self.params.Object, heron.standsOn, self.params.Mark)
        return self.success(f"{self.params.Object} stands on {self.params.Mark}")

    def onPreempt(self):
        self.sent.cancel()
        return self.fail("the arm has stopped")


class Wipe(SkillDescription):
    """Presses the tool in the hand on a board, and wipes the board."""

    def description(self, Robot: heron.Robot, Sponge: INFERRED[heron.Block], Board: heron.Board):
        self.pre_conditions += Robot.holds(Sponge)
        self.post_conditions += Robot.hasWiped(Board)
        self.permits += contact(Board)
        self.permits += force(Board, "30 N")
        self.uses += server(ARM)


class wipe(Wipe.SkillBase):
    def onStart(self):
        self.sent = SentGoal(ARM, {"pose": "wipe"})
        return True

    def execute(self):
        if self.sent.is_reached is None:
            return self.step(f"wiping {self.params.Board}")
        if not self.sent.is_reached:
            return self.fail(f"{self.params.Board} was not wiped")
        self.world.relate(self.params.Robot, heron.hasWiped, self.params.Board)
        return self.success(f"{self.params.Board} is clean")

    def onPreempt(self):
        self.sent.cancel()
        return self.fail("the arm has stopped")
