"""Actions: each effect checked by itself, with its target, numbers and resource."""
