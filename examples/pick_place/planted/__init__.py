"""Skills with mistakes that SkiROS2 would find when they run, or never."""
