"""Host systems that run EzSkiROS skills, such as SkiROS2."""
