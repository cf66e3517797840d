# mypy: ignore-errors
"""A process that has rospy imported, and whose children become scripts that need it.

`ros1_python.py` starts it and asks it by a socket, its standard input. A request is one byte with
four open files: what is to be run (JSON), and its standard input, output and error. The answer is
the number of the child. Children that have ended keep their numbers as long as this process lives.
"""

import importlib
import json
import os
import socket
import struct
import sys
import threading
from pathlib import Path
from types import ModuleType

NUMBER = struct.Struct("q")
_MODULES = (
    "actionlib",
    "diagnostic_msgs.msg",
    "dynamic_reconfigure.cfg.TestConfig",
    "dynamic_reconfigure.server",
    "geometry_msgs.msg",
    "nav_msgs.msg",
    "rosmaster.main",
    "rospy",
    "rostopic",
    "sensor_msgs.msg",
    "std_srvs.srv",
)


def answer(asking):
    """Answer requests until nobody asks any more; returns in children only."""
    while True:
        asked, files, _, _ = socket.recv_fds(asking, 1, 4)
        if not asked:
            os._exit(0)
        with os.fdopen(files.pop(0), "rb") as file:
            request = json.load(file)
        child = os.fork()
        if child == 0:
            asking.close()
            get_ready(request, files)
            return
        for each in files:
            os.close(each)
        asking.sendall(NUMBER.pack(child))


def get_ready(request, files):
    """Make this child such as a new process of Python is before its script runs."""
    os.setsid()
    for number, given in enumerate(files):
        os.dup2(given, number)
        os.close(given)
    os.environ.clear()
    os.environ.update(request["variables"])
    sys.argv[:] = request["arguments"]  # who has been imported knows this list
    sys.path.insert(0, str(Path(sys.argv[0]).parent))
    sys.path_importer_cache.clear()  # packages have been built meanwhile


def run():
    """Run the script that the arguments name, in a `__main__` of its own."""
    path = sys.argv[0]
    main = ModuleType("__main__")
    main.__file__ = path
    sys.modules["__main__"] = main
    exec(compile(Path(path).read_bytes(), path, "exec", dont_inherit=True), vars(main))


if __name__ == "__main__":
    del sys.path[0]  # the folder of this file
    for name in _MODULES:
        importlib.import_module(name)
    assert threading.active_count() == 1, "only what has one thread can be copied"
    answer(socket.socket(fileno=os.dup(0)))
    run()
