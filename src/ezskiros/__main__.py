"""`python -m ezskiros` is the command `ezskiros`."""

from ezskiros.cli.main import main

main()
