"""Instances: files that are imported with values for their parameters, or under a name."""
