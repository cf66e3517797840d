"""Behavior trees as drawings: on a terminal, as a picture, and for BehaviorTree.CPP."""
