"""Simulated perception."""

from ezskiros import INFERRED, SkillDescription

from .world import skiros


class HSVDetection(SkillDescription):
    """Looks for a product by its color, and finds a pose to grasp it."""

    def description(
        self,
        Object: skiros.Product,
        GraspPose: INFERRED[skiros.GraspingPose],
    ):
        self.pre_conditions += Object.hasA(GraspPose)
        self.post_conditions += Object.hasA(GraspPose)


class hsv_detection(HSVDetection.SkillBase):
    """Finds the product of the world model at the second look."""

    def onStart(self):
        self.looks = 0
        return True

    def execute(self):
        self.looks += 1
        if self.looks < 2:
            return self.step(f"looking for {self.params.Object}")
        return self.success(f"{self.params.Object} is to be grasped at {self.params.GraspPose}")
