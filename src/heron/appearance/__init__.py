"""The appearance of a scene: shapes, materials and light. The physics is not affected: a dressed
copy of the scene shows the states of the plain scene.
"""

from heron.appearance.canvas import Camera, CannotDrawError, Canvas, Pixels, Size
from heron.appearance.stage import Stage, VisibleState, moment_of

__all__ = [
    "Camera",
    "CannotDrawError",
    "Canvas",
    "Pixels",
    "Size",
    "Stage",
    "VisibleState",
    "moment_of",
]
