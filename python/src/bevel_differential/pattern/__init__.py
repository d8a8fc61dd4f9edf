"""Contact patterns of solid teeth."""
