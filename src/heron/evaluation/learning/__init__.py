"""The study of learning behind rules: its folder, its page, and a look at trainings that go on."""

from heron.evaluation.learning.folder import PAGE, LearningFolder, write_learning_page
from heron.evaluation.learning.watch import Watch

__all__ = ["PAGE", "LearningFolder", "Watch", "write_learning_page"]
