"""z3 is asked, and does not keep what is not for it."""

from __future__ import annotations

import os
import signal
import threading

import pytest
import z3

from rossmarie.analysis.solver import check


def test_an_interrupt_is_no_answer() -> None:
    x, y, z = z3.Ints("x y z")
    solver = z3.Solver()
    solver.add(x > 1, y > 1, z > 1, x != y, x**3 + y**3 == z**3 + 1000003 * x)
    solver.set("timeout", 60_000)
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        check(solver)
