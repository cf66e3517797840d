"""The context: the running skills and their things, for rules that monitor the robot."""
