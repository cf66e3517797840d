"""From SkiROS2's descriptions of skills to those of EzSkiROS: Python in, Python out."""
