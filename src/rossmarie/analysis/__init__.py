"""Queries about a machine, answered by a proof, by a witness, or not at all.

`queries.ask_all` asks them, `failures.losses` tells of inputs that are stale, `witness` knows
what a witness is. Importing this package does not import the solver.
"""
