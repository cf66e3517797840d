"""Common parts of the targets for ROS 1 and ROS 2: a node that monitors, acts, and filters
commands.
"""
