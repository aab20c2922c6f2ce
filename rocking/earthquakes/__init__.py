"""Earthquakes: which stations and earthquakes stand behind a result, and what interval they allow."""
