"""The command line. Thin: it parses arguments, calls the driver and prints."""
