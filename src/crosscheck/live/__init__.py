"""A running robot: the reports of its skills are compared with those of the node of its rules."""
