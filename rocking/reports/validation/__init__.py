"""The report of the validation: predictions against shake-table tests."""
