"""The results of a replay, for readers: a table, JSON lines, and a timeline that opens in a
browser.

The subpackage `wiring` shows the connections of a rules file's node. This package imports none of
its modules: pages about rules alone are written without NumPy.
"""
