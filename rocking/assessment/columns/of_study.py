"""The columns of the tables of a whole study: its structures, its counts, its failures and its spectrum."""

from rocking.assessment.columns.shared import (
    COMPONENT_COLUMN,
    PROVENANCE,
    RATIO_COLUMN,
    RECORD_COLUMN,
    STRUCTURE_COLUMN,
)
from rocking.tables import Column, Table

STRUCTURES = Table(
    "structures",
    "One row per structure: its mechanism and its equivalent block",
    (
        STRUCTURE_COLUMN,
        Column("type", "string", "Type of the structure"),
        Column("geometry", "string", "Its geometry, SI and radians"),
        Column("frequency_parameter_rad_s", "number", "p of the equivalent block", "Eq. 11"),
        Column("critical_rotation_rad", "number", "Critical rotation"),
        Column("uplift_multiplier", "number", "Uplift acceleration in g", "Eq. 7"),
        Column("acceleration_scale_linearised", "number", "a_sc", "Eq. 11"),
        Column("acceleration_scale_uplift", "number", "a_sc,alt", "Eq. 13"),
        Column(
            "linearised_over_true_uplift",
            "number",
            "Uplift acceleration of the linearised block over the true one",
            "Eq. 12",
        ),
        Column("restitution", "number", "Ratio of angular velocities after and before an impact", "Eq. 2"),
    ),
)

EQUIVALENCE = Table(
    "equivalence",
    "One row per structure, side and measure: what the equivalent block gets wrong, by quadrature",
    (
        STRUCTURE_COLUMN,
        Column("side", "string", "positive or negative: the side to which it rocks"),
        Column("measure", "string", "natural period, uplift acceleration or time to overturn"),
        Column(
            "acceleration_scale_choice",
            "string",
            "linearised, uplift or mean, where the measure depends on it",
        ),
        Column(
            "at",
            "number",
            "Rotation amplitude over critical rotation, or constant ground acceleration over uplift acceleration",
        ),
        Column("block_over_structure", "number", "Equivalent block over structure", "Figs. 3, 4, 6, 7"),
    ),
)

AGREEMENT = Table(
    "agreement",
    "One row per light and one for all: the closed form under the dominant pulse against the full integration",
    (
        Column("light", "string", "green, amber or red; all for their sum"),
        Column("records", "integer", "Records behind the row"),
        Column("cases", "integer", "Component and structure pairs with both a prediction and an integration"),
        Column("both_rock", "integer", "Cases in which both rock and stay up"),
        Column(
            "within_factor_two", "integer", "Those whose predicted over integrated rotation lies in [1/2, 2]"
        ),
        Column("median_ratio", "number", "Median of predicted over integrated rotation where both rock"),
        Column("overturning", "integer", "Cases that overturn in the integration"),
        Column("overturning_found", "integer", "Those in which the closed form overturns too"),
        Column("overturning_missed", "integer", "Those in which it does not"),
        Column("overturning_false", "integer", "Cases in which the closed form alone overturns"),
        Column("fragile", "integer", "Cases whose verdict the stated change of amplitude flips"),
    ),
)

FAILURES = Table(
    "failures",
    "One row per record or structure that gave no result, and why",
    (
        RECORD_COLUMN,
        COMPONENT_COLUMN,
        STRUCTURE_COLUMN,
        Column("stage", "string", "Stage that failed"),
        Column("message", "string", "What is wrong, what is allowed and what to do"),
    ),
)

TIMINGS = Table(
    "timings",
    "One row per record and stage; differs between runs of the same input",
    (RECORD_COLUMN, Column("stage", "string", "Stage"), Column("duration_s", "number", "CPU time")),
)

SPECTRUM = Table(
    "spectrum",
    "One row per component and equivalent block under the whole record; written by rocking spectrum",
    (
        COMPONENT_COLUMN,
        Column("frequency_parameter_rad_s", "number", "p of the equivalent block", "Eq. 11"),
        Column("uplift_multiplier", "number", "Uplift acceleration of the equivalent block in g", "Eq. 12"),
        Column("restitution", "number", "Ratio of angular velocities after and before an impact", "Eq. 2"),
        RATIO_COLUMN,
        *PROVENANCE[:2],
    ),
)
