"""The fragility of every structure under all records of a study."""
