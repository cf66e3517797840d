"""Zones: boxes, circles and polygons in the plane of a frame."""
