"""The tests of the package, of the workflow and of the research."""
