"""The report of the comparison of codes."""
