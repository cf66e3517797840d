"""The command `heron`: thin, it prints what the experiments found."""
