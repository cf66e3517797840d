"""What changes nothing but the world model.

SkiROS2's skills of these names set any relation, by a text that is known only when they run: what
they do cannot be described. These say it, and fail if they are asked for something else.
"""

from ezskiros import INFERRED, SkillDescription

from .world import skiros, sumo


class WmSetRelation(SkillDescription):
    """Says where a thing is.

    Args:
        Src: what is somewhere.
        Dst: where it is.
        Relation: `skiros.at`.
        RelationState: whether it is there; else this fails.

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
    """At once."""

    def execute(self):
        if self.params.Relation != "skiros.at" or not self.params.RelationState:
            return self.fail("only that a thing is somewhere can be set", -1)
        self.world.relate(self.params.Src, skiros.at, self.params.Dst)
        return self.success(f"{self.params.Src} is at {self.params.Dst}")


class WmMoveObject(SkillDescription):
    """Moves a thing from where it is contained to somewhere else.

    Args:
        TargetLocation: what it is contained in afterwards.

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
    """At once."""

    def execute(self):
        self.world.relate(self.params.TargetLocation, skiros.contain, self.params.Object)
        return self.success(f"{self.params.TargetLocation} contains {self.params.Object}")
