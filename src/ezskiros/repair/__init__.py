"""Repairs of descriptions in their source files."""
