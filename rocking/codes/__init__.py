"""Codes: the design level, the records that stand for it, and the checks of the Italian code."""
