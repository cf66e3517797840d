"""Where skills run: what EzSkiROS hands over to other systems."""
