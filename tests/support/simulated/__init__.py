"""Robots in the box as simulations, which write the recordings in the folders of these robots."""
