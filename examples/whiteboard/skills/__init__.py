"""Skills of a robot that erases whiteboards: contact is a hazard, but for wiping."""

from ezskiros.hosts.skiros2 import host

host(__name__, context="../skills.json")  # where SkiROS2 loads this library
