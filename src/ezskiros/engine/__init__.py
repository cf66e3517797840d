"""Execution of skills without ROS, in their own world model."""
