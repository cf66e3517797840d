"""Tests of rules: run on the interpreter and in C, generated, and what they cover."""
