"""The meanings of columns that more than one table has."""

ROTATION_RATIO = "Largest rotation over critical rotation; INF if it overturns, 0 without uplift"
ROTATION = "Largest rotation; INF if it overturns"
PROBABILITY = (
    "Of overturning, from closed form, PGV, PGA and structure: calibrated on real records (tiers.csv)"
)
METHOD = "How the number was computed"
OUTCOME = "no uplift, rocks, overturns or failed"
REGIME = "Regime of the closed form in which the prediction was made"
IMPACTS = "Number of impacts"
RECORD = "Identifier of the record in the catalogue"
COMPONENT = "Component of the ground motion, as the file names it"
STRUCTURE = "Name of the structure in the structure list"
SCALE_FACTOR = "What the accelerations of the file were multiplied by, beyond their unit"
RECORD_SHA256 = "SHA-256 of the file the record was read from"
FREQUENCY_PARAMETER = "p of the equivalent block"
RESTITUTION = "Ratio of angular velocities after and before an impact"
PEAK_SIDE = "Side of the largest rotation or of the overturning: 1, -1, or 0 without uplift"
