"""Tests: their names, fields, units and instants are checked, and their content becomes data."""
