"""Skills of a robot that erases whiteboards. Contact is a hazard, except for wiping."""

from ezskiros.hosts.skiros2 import host

host(__name__, context="../skills.json")  # only for SkiROS2, which loads this library
