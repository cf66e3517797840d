"""Skills in rules: the file that says what skills there are, and what rules ask of them."""
