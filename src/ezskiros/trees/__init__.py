"""Behavior trees, as `expandBT` of an implementation builds them."""
