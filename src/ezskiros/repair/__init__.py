"""Repairs of descriptions, in the files where they are written."""
