"""ROSSMARie: safety rules for robots, checked before launch and monitored at run time."""
