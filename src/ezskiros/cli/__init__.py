"""The `ezskiros` command."""
