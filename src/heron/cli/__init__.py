"""The command `heron`: a thin layer that prints the results of experiments."""
