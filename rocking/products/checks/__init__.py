"""The checks of the Italian code at the design level of a study, with a page of each structure to sign."""
