"""Optimisation of the gears by several objectives at once: docs/optimisation.md."""
