"""Tests of rules: runs on the interpreter and in C, generation, and coverage."""
