"""Columns that several tables share, each written once."""

from rocking.tables import Column

RECORD_COLUMN = Column("record", "string", "Identifier of the record in the catalogue")
COMPONENT_COLUMN = Column("component", "string", "Component of the ground motion, as the file names it")
STRUCTURE_COLUMN = Column("structure", "string", "Name of the structure in the structure list")
METHOD_COLUMN = Column("method", "string", "How the number was computed")
RATIO_COLUMN = Column(
    "rotation_ratio",
    "number",
    "Largest rotation over critical rotation; INF if it overturns, 0 without uplift",
)
ROTATION_COLUMN = Column("rotation_rad", "number", "Largest rotation; INF if it overturns")
OUTCOME_COLUMN = Column("outcome", "string", "no uplift, rocks, overturns or failed")
REGIME_COLUMN = Column("regime", "string", "Regime of the closed form in which the prediction was made")
LIGHT_COLUMN = Column(
    "light", "string", "Whether one pulse can stand for this record and structure: green, amber or red"
)
IMPACTS_COLUMN = Column("impacts", "integer", "Number of impacts")
FRAGILE_COLUMN = Column("fragile", "boolean", "Whether the stated change of amplitude flips the verdict")
SENSITIVITY_COLUMN = Column("sensitivity", "number", "d ln(largest rotation) / d ln(ground acceleration)")
PROVENANCE = (
    Column(
        "scale_factor", "number", "What the accelerations of the file were multiplied by, beyond their unit"
    ),
    Column("record_sha256", "string", "SHA-256 of the file the record was read from"),
    Column(
        "settings_sha256",
        "string",
        "SHA-256 of the settings, the structure list and the package that made this row",
    ),
)
