"""Skills of a robot that picks things and places them."""

from ezskiros.hosts.skiros2 import host

host(__name__)  # where SkiROS2 loads this library
