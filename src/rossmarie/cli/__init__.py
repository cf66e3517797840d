"""The command line. It parses arguments, calls the driver and prints, and does nothing else."""
