"""Behavior trees for other eyes: on a terminal, as a picture, and for BehaviorTree.CPP."""
