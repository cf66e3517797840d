"""The command line of crosscheck."""
