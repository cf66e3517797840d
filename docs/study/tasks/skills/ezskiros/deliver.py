"""Skills of a robot that delivers what its gripper holds."""

from ezskiros import INFERRED, SkillDescription
from world import cora, rparts, skiros


class Drive(SkillDescription):
    """Drives the robot to another place."""

    def description(
        self,
        Robot: cora.Robot,
        Start: INFERRED[skiros.Location],
        Target: skiros.Location,
    ):
        self.pre_conditions += Robot.at(Start)
        self.post_conditions += Robot.at(Target)
        self.post_conditions += ~Robot.at(Start)


class drive(Drive.SkillBase):
    """Drives at once: this is a simulation."""

    def execute(self):
        return self.success(f"at {self.params.Target}")


class Release(SkillDescription):
    """Opens the gripper above a place. Force is in N."""

    def description(
        self,
        Robot: INFERRED[cora.Robot],
        Gripper: rparts.GripperEffector,
        Object: INFERRED[skiros.Product],
        Place: skiros.Location,
        Force: float = 2.0,
    ):
        self.pre_conditions += Robot.at(Place)
        self.pre_conditions += Gripper.contain(Object)
        self.post_conditions += ~Gripper.contain(Object)
        self.post_conditions += Place.contain(Object)


class release(Release.SkillBase):
    """Releases at once: this is a simulation."""

    def execute(self):
        return self.success(f"{self.params.Object} is at {self.params.Place}")


class Deliver(SkillDescription):
    """Brings what the gripper holds to a shelf."""

    def description(
        self,
        Robot: cora.Robot,
        Start: INFERRED[skiros.Location],
        Gripper: rparts.GripperEffector,
        Object: INFERRED[skiros.Product],
        Shelf: skiros.Location,
        Grip: float = 2.0,
    ):
        self.pre_conditions += Robot.at(Start)
        self.pre_conditions += Gripper.contain(Object)
        self.post_conditions += Robot.at(Shelf)
        self.post_conditions += Shelf.contain(Object)


class deliver(Deliver.SkillBase):
    """Drives first and then releases."""

    def expandBT(self, params):
        self.serialstar(
            Drive(Target=params.Shelf),
            Release(Place=params.Shelf, Force=params.Grip),
        )
