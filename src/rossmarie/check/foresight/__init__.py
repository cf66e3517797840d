"""Motions of the robot, and the requirements of rules: speeds in locations, reached in time."""
