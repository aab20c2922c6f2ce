"""Fragility: intensity measures, curves over them, and annual rates."""
