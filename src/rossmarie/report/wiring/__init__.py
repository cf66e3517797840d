"""The wiring of a rules file, for readers: as text, as SVG, and for Graphviz."""

from rossmarie.report.wiring.dot import wiring_dot
from rossmarie.report.wiring.model import NodeWiring, wiring_of
from rossmarie.report.wiring.svg import wiring_svg
from rossmarie.report.wiring.text import wiring_text

__all__ = ["NodeWiring", "wiring_dot", "wiring_of", "wiring_svg", "wiring_text"]
