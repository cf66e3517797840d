"""A robot that runs: what its skills and the node of its rules tell, looked at together."""
