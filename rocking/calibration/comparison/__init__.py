"""Comparison: work against precision of this package and of the codes that engineers know."""
