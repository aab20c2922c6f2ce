"""Meanings of columns that several tables share, so that one name of a column means one quantity."""

RECORD = "Identifier of the record in the catalogue"
COMPONENT = "Component of the ground motion, as the file names it"
STRUCTURE = "Name of the structure in the structure list"
SUPPORT_PERIOD = (
    "First period of the support below the structure; 0: its ground, to compare with; empty: it has none"
)
SCALE_FACTOR = "Factor of the catalogue on the accelerations of the file"
RECORD_SHA256 = "SHA-256 of the file the record was read from"
PEAK_SIDE = "Side of the largest rotation or of the overturning: 1, -1, or 0 without uplift"
