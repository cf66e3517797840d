"""A master that is started anew knows nobody."""

from __future__ import annotations

from pathlib import Path

from support.live import until
from support.ros1_live import Master, Ros1, free_port, master_of, process_of


def test_the_master_is_started_anew(ros1: Ros1, tmp_path: Path) -> None:
    """The node ends, because nobody new could find it, and comes back as it was."""
    elsewhere = {**ros1.variables, "ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}"}
    log, latched = tmp_path / "log", str(tmp_path / "latched")
    master, robot = Master(elsewhere, log), ros1.robot(elsewhere)
    launch = ros1.launch(tmp_path, {"state_file": latched}, elsewhere)
    try:
        robot.set(pitch=15.0, speed=1.0)
        robot.passes(0.2, 30)
        before = process_of(elsewhere, "/vehicle_safety")
        master.end()
        robot.stays_at(0.2)
        master = Master(elsewhere, log)
        until(
            lambda: process_of(elsewhere, "/vehicle_safety") not in (before, None),
            "the node is back",
            30,
        )
        assert "the master was started anew" in launch.said()
        with master_of(elsewhere) as asked:
            assert asked.getParam("/test", "/vehicle_safety/state_file")[2] == latched
        robot.end()
        robot = ros1.robot(elsewhere)
        robot.set(pitch=15.0, speed=1.0)
        robot.passes(0.2)
    finally:
        launch.end_gently()
        robot.end()
        master.end()
