"""Meanings of columns that several tables share, so that one name of a column means one quantity."""

from rocking.assessment.decide import Verdict

RECORD = "Identifier of the record in the catalogue"
COMPONENT = "Component of the ground motion, as the file names it"
STRUCTURE = "Name of the structure in the structure list"
SUPPORT_PERIOD = (
    "First period of the support below the structure; 0: its ground, to compare with; empty: it has none"
)
SCALE_FACTOR = "Factor of the catalogue on the accelerations of the file"
RECORD_SHA256 = "SHA-256 of the file the record was read from"
VERDICT = f"The verdict: {', '.join(Verdict)}"
OVERTURNING_SHARE = "Share of the members that overturn; of a single run 0 or 1; empty where none can be told"
PEAK_SIDE = "Side of the largest rotation or of the overturning: 1, -1, or 0 without uplift"
