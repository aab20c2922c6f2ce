"""What the reports of a study are written into: one module each, for a job that sets one imports no other."""
