"""Motions of the robot, and what rules keep: speeds in places, reached in time."""
