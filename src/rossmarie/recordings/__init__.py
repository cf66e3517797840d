"""Recordings of robots, as updates for a monitor.

`opening.open_recording` opens ROS 1 and ROS 2 bags, MCAP and CSV. `model.Recording.batches` gives
their samples in order of time, and `batches.updates_in` the updates in a batch. This package
imports none of its modules: `explain` shows diagnostics of recordings without NumPy.
"""
