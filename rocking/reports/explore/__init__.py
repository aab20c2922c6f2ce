"""The page to explore a study: one HTML file without a network."""
