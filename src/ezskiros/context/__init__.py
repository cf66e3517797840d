"""The context: which skills run, with which things, for rules that watch them."""
