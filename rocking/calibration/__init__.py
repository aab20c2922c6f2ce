"""Calibration: how far each method may be trusted, and what accuracy costs."""
