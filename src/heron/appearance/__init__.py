"""The look of a scene: shapes, materials and light. The physics never sees any of it: a copy of the
scene is dressed, and shows the states of the plain one.
"""

from heron.appearance.canvas import Camera, CannotDrawError, Canvas, Pixels, Size
from heron.appearance.stage import Moment, Stage, moment_of

__all__ = [
    "Camera",
    "CannotDrawError",
    "Canvas",
    "Moment",
    "Pixels",
    "Size",
    "Stage",
    "moment_of",
]
