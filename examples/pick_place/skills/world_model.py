"""Skills that change only the world model.

The skills of SkiROS2 with these names can set any relation. A text names the relation at run time,
so a description cannot contain it. The skills here describe one relation, and fail for all others.
"""

from ezskiros import INFERRED, SkillDescription

from .world import skiros, sumo


class WmSetRelation(SkillDescription):
    """Sets the place of an individual.

    Args:
        Src: the individual.
        Dst: the place of the individual.
        Relation: `skiros.at`.
        RelationState: True. With False, the skill fails.

    """

    def description(
        self,
        Src: sumo.Object,
        Dst: sumo.Object,
        Relation: str = "skiros.at",
        RelationState: bool = True,
    ):
        self.post_conditions += Src.at(Dst)


class wm_set_relation(WmSetRelation.SkillBase):
    """Ends at once."""

    def execute(self):
        if self.params.Relation != "skiros.at" or not self.params.RelationState:
            return self.fail("this skill can set only the relation skiros.at to true", -1)
        self.world.relate(self.params.Src, skiros.at, self.params.Dst)
        return self.success(f"{self.params.Src} is at {self.params.Dst}")


class WmMoveObject(SkillDescription):
    """Moves an individual from its container to another location.

    Args:
        TargetLocation: the location that contains the individual afterwards.

    """

    def description(
        self,
        StartLocation: INFERRED[sumo.Object],
        TargetLocation: sumo.Object,
        Object: sumo.Object,
    ):
        self.pre_conditions += StartLocation.contain(Object)
        self.post_conditions += ~StartLocation.contain(Object)
        self.post_conditions += TargetLocation.contain(Object)


class wm_move_object(WmMoveObject.SkillBase):
    """Ends at once."""

    def execute(self):
        self.world.relate(self.params.TargetLocation, skiros.contain, self.params.Object)
        return self.success(f"{self.params.TargetLocation} contains {self.params.Object}")
