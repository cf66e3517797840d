"""Translation of SkiROS2 skills to EzSkiROS, from Python source to Python source."""
