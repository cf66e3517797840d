"""What is declared, and what the checker knows while it goes over a program."""
