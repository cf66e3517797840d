"""The targets to which a machine can be compiled."""
