"""A skill that waits."""

from ezskiros import SkillDescription


class Wait(SkillDescription):
    """Does nothing for a while.

    Args:
        Duration: the duration, in seconds.

    """

    def description(self, Duration: float):
        pass


class wait(Wait.SkillBase):
    """Waits by the clock of the engine."""

    def onStart(self):
        self.end = self.now() + self.params.Duration
        return True

    def execute(self):
        if self.now() >= self.end:
            return self.success("done")
        return self.step(f"waiting {self.params.Duration} s")
