"""The locations of a scene: the positions of its individuals in the plane, for rules that look
ahead.
"""

from ezskiros.locations.find import FoundLocations, find_locations
from ezskiros.locations.location import Location, Point

__all__ = ["FoundLocations", "Location", "Point", "find_locations"]
