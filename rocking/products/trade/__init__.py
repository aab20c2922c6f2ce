"""What accuracy costs, on the records and structures of a study."""
