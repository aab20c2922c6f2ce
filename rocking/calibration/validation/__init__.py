"""Validation: predictions held against shake-table tests that took no part in the fit."""
