"""Skills of a robot that picks things and places them."""

from ezskiros.hosts.skiros2 import host

host(__name__)  # only for SkiROS2, which loads this library
