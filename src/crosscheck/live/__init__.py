"""A running robot: the reports of its skills and of the node of its rules, compared."""
