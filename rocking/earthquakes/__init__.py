"""Earthquakes: which stations and earthquakes a result is of, and what interval they allow."""
