"""Assessment: one record against one list of structures, and the rows that say what came of it."""
