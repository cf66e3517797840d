"""The study of learning with rules: its folder, its page, and a view of running trainings."""

from heron.evaluation.learning.folder import PAGE, LearningFolder, write_learning_page
from heron.evaluation.learning.watch import Watch

__all__ = ["PAGE", "LearningFolder", "Watch", "write_learning_page"]
