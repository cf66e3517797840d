"""Skills of a robot that picks and places objects."""

from ezskiros.hosts.skiros2 import host

host(__name__)  # only for SkiROS2, which loads this library
