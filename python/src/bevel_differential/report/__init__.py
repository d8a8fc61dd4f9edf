"""Report of a scene: one HTML file with figures, tables and explanations (docs/results.md)."""
