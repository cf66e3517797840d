"""The study of learning with rules: its folder, its page, and a view of running trainings."""

from heron.evaluation.learning.folder import PAGE, LearningFolder, write_learning_page
from heron.evaluation.learning.watch import TrainingLogs

__all__ = ["PAGE", "LearningFolder", "TrainingLogs", "write_learning_page"]
