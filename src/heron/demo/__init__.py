"""The demo: episodes with and without a monitor, side by side on one page."""

from heron.demo.page import page_of
from heron.demo.shots import Shot, shoot, shoot_all

__all__ = ["Shot", "page_of", "shoot", "shoot_all"]
