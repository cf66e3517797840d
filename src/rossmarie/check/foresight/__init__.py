"""Motions of the robot, and the requirements of rules: speeds in places, reached in time."""
