"""Rocking structures under recorded earthquakes: SI units and radians inside."""
