"""Study: many records against one list of structures, from the settings to the finished folder."""
