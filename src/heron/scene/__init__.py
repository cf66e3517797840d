"""Builders of MJCF for the things in a scene, from parameters in SI units."""

from heron.scene.arm import ArmParameters
from heron.scene.base import AXLES, BaseParameters, add_base
from heron.scene.cell import CellParameters, ForearmParameters, build_cell
from heron.scene.corridor import CHILD, CorridorParameters, build_corridor
from heron.scene.course import Course, CourseParameters, Slope, add_course, course
from heron.scene.ground import Contact
from heron.scene.paths import PathsParameters, StraightPath, build_paths
from heron.scene.person import PersonParameters
from heron.scene.placing import TableParameters, build_placing
from heron.scene.room import RoomParameters, build_room
from heron.scene.scene import build_navigation

__all__ = [
    "AXLES",
    "CHILD",
    "ArmParameters",
    "BaseParameters",
    "CellParameters",
    "Contact",
    "CorridorParameters",
    "Course",
    "CourseParameters",
    "ForearmParameters",
    "PathsParameters",
    "PersonParameters",
    "RoomParameters",
    "Slope",
    "StraightPath",
    "TableParameters",
    "add_base",
    "add_course",
    "build_cell",
    "build_corridor",
    "build_navigation",
    "build_paths",
    "build_placing",
    "build_room",
    "course",
]
