"""Codes: the records that stand for a design level, and the checks of the Italian code."""
