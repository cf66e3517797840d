"""What a machine can be compiled to."""
