"""Optimisation of the gears by several objectives at once: docs/design.md."""
