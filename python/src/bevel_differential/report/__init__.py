"""A report of a scene: one HTML file with figures, tables and what they say (docs/results.md)."""
