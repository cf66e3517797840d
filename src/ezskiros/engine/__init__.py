"""Runs skills without ROS, in a world model of their own."""
