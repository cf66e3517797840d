"""Behavior trees: what `expandBT` of an implementation builds."""
