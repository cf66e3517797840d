"""Tests: whether names, fields, units and instants fit; and what they say, as data."""
