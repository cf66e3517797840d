"""Actions: each effect is checked separately, with its target, numbers and resource."""
