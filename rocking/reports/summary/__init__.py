"""The PDF of a whole study."""
