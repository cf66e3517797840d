"""The context: the running skills and their individuals, for rules that monitor the robot."""
