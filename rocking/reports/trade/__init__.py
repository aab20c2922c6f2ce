"""The trade of error for time as a document."""
