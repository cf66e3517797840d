"""Queries about a machine: each is answered by a proof or by a witness, or stays undecided.

`queries.ask_all` asks all of them, `failures.losses` finds the effects of stale inputs, and
`witness` defines witnesses. Importing this package does not import the solver.
"""
