"""The results of a replay, for readers: a table, JSON lines, and a timeline that opens in a
browser.

Beside it, in `wiring`, how the node of a rules file is connected. This package imports none of its
modules: pages about rules alone are written without NumPy.
"""
