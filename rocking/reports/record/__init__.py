"""The PDF of one record."""
