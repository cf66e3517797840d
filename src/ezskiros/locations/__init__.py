"""The locations of a scene: the positions of its individuals in the plane, for rules that look
ahead.
"""

from ezskiros.locations.find import Found, find_locations
from ezskiros.locations.location import Location, Point

__all__ = ["Found", "Location", "Point", "find_locations"]
