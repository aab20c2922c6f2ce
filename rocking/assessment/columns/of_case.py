"""The columns of the tables with a row per case, a structure under a component: what was predicted and integrated."""

from rocking.assessment.columns.shared import (
    COMPONENT_COLUMN,
    FRAGILE_COLUMN,
    IMPACTS_COLUMN,
    LIGHT_COLUMN,
    METHOD_COLUMN,
    OUTCOME_COLUMN,
    PROVENANCE,
    RATIO_COLUMN,
    RECORD_COLUMN,
    REGIME_COLUMN,
    ROTATION_COLUMN,
    SENSITIVITY_COLUMN,
    STRUCTURE_COLUMN,
)
from rocking.tables import Column, Table

PREDICTIONS = Table(
    "predictions",
    "One row per structure and closed form: the equivalent block under the dominant pulse",
    (
        RECORD_COLUMN,
        COMPONENT_COLUMN,
        STRUCTURE_COLUMN,
        METHOD_COLUMN,
        Column("pulse_rank", "integer", "Rank of the pulse among those that its method offers"),
        Column("acceleration_scale_choice", "string", "linearised (a_sc), uplift (a_sc,alt) or their mean"),
        Column("frequency_parameter_rad_s", "number", "p of the equivalent block", "Eq. 11"),
        Column("critical_rotation_rad", "number", "Critical rotation"),
        Column("acceleration_scale", "number", "Acceleration scale of the equivalent block", "Eqs. 11, 13"),
        Column("uplift_multiplier", "number", "Uplift acceleration of the equivalent block in g", "Eq. 12"),
        Column("restitution", "number", "Ratio of angular velocities after and before an impact", "Eq. 2"),
        Column("amplitude_ratio", "number", "a = a_g / (g times uplift multiplier)", "Eq. 16"),
        Column(
            "frequency_ratio", "number", "Circular frequency of the pulse over frequency parameter", "Eq. 16"
        ),
        RATIO_COLUMN,
        ROTATION_COLUMN,
        Column(
            "rotation_ratio_low",
            "number",
            "Lower end of the 90 % band of the prediction, from the interval of the pulse",
        ),
        Column(
            "rotation_ratio_high",
            "number",
            "Upper end of the 90 % band of the prediction, from the interval of the pulse",
        ),
        OUTCOME_COLUMN,
        REGIME_COLUMN,
        IMPACTS_COLUMN,
        LIGHT_COLUMN,
        *PROVENANCE,
    ),
)

RESPONSES = Table(
    "responses",
    "One row per structure and integration",
    (
        RECORD_COLUMN,
        COMPONENT_COLUMN,
        STRUCTURE_COLUMN,
        METHOD_COLUMN,
        RATIO_COLUMN,
        ROTATION_COLUMN,
        OUTCOME_COLUMN,
        IMPACTS_COLUMN,
        Column(
            "peak_side",
            "integer",
            "Side of the largest rotation or of the overturning: 1, -1, or 0 without uplift",
        ),
        Column("peak_time_s", "number", "Time of the largest rotation after the first sample"),
        Column("uplift_time_s", "number", "Time of the first uplift after the first sample"),
        SENSITIVITY_COLUMN,
        FRAGILE_COLUMN,
        Column("tolerance", "number", "Relative tolerance of the integration; 0 for an exact solution"),
        Column("steps", "integer", "Steps taken"),
        Column(
            "friction_needed",
            "number",
            "Largest friction coefficient a contact needs while rocking; INF where a contact is not pressed",
        ),
        Column(
            "slides",
            "boolean",
            "Whether that exceeds the friction coefficient of the settings: the model does not hold",
        ),
        Column("bounces", "boolean", "Whether a contact would have to pull: the model does not hold"),
        Column("reason", "string", "Why it failed, if it did"),
        *PROVENANCE,
    ),
)

COMPARISON = Table(
    "comparison",
    "One row per structure: the closed form under the dominant pulse beside the integration of the whole record",
    (
        RECORD_COLUMN,
        COMPONENT_COLUMN,
        STRUCTURE_COLUMN,
        Column(
            "printed_rotation_ratio",
            "number",
            "Eq. 15 as the paper prints it; empty where its radicand is negative",
            "Eq. 15",
        ),
        Column(
            "predicted_rotation_ratio",
            "number",
            "Exact maximum of the equivalent block under the dominant pulse",
        ),
        Column("pulse_rotation_ratio", "number", "Nonlinear mechanism under the dominant pulse"),
        Column("block_rotation_ratio", "number", "Equivalent block under the whole record"),
        Column("integrated_rotation_ratio", "number", "Nonlinear mechanism under the whole record"),
        Column(
            "answer_rotation_ratio",
            "number",
            "Of the mechanism under the record, or of the cheapest method that fidelity: auto trusts instead",
        ),
        Column("answer_method", "string", "Which method that was"),
        Column(
            "prediction_over_integration",
            "number",
            "Predicted over integrated rotation ratio, where both rock",
        ),
        Column("within_factor_two", "boolean", "Whether that ratio lies between 1/2 and 2, where both rock"),
        Column(
            "reliability_within_factor_two",
            "number",
            "Share of comparisons of this light and frequency ratio within a factor two, from the shipped calibration",
        ),
        Column(
            "reliability_overturnings_found",
            "number",
            "Share of overturnings that such predictions found, from the shipped calibration; empty if there were none",
        ),
        Column("reliability_records", "integer", "Independent records behind those two shares"),
        Column(
            "verdict",
            "string",
            "agree, unsafe (overturning or rocking missed) or safe (predicted, did not happen)",
        ),
        REGIME_COLUMN,
        LIGHT_COLUMN,
        SENSITIVITY_COLUMN,
        FRAGILE_COLUMN,
        *PROVENANCE,
    ),
)

CANDIDATES = Table(
    "candidates",
    "One row per height at which a wall may be hinged or a spire cracked: the governing height is marked",
    (
        RECORD_COLUMN,
        COMPONENT_COLUMN,
        STRUCTURE_COLUMN,
        Column("position_m", "number", "Height of the hinge or of the crack above the base"),
        Column(
            "predicted_rotation_ratio",
            "number",
            "Exact maximum of its equivalent block under the dominant pulse",
        ),
        Column("integrated_rotation_ratio", "number", "Its mechanism under the whole record"),
        Column(
            "governs_pulse",
            "boolean",
            "Whether it rotates most under the pulse; the lowest of those that overturn",
        ),
        Column(
            "governs_record",
            "boolean",
            "Whether it rotates most under the record; the lowest of those that overturn",
        ),
        *PROVENANCE,
    ),
)

PROCESSING = Table(
    "processing",
    "One row per structure and processing of the record: what the answer owes to baseline and corner frequency",
    (
        RECORD_COLUMN,
        COMPONENT_COLUMN,
        STRUCTURE_COLUMN,
        Column("processing", "string", "What was done to the record besides what the record table says"),
        Column("peak_acceleration_m_s2", "number", "Largest magnitude of the acceleration then"),
        RATIO_COLUMN,
        OUTCOME_COLUMN,
        *PROVENANCE,
    ),
)

MAXIMA = Table(
    "maxima",
    "One row per record, component, structure and method",
    (
        RECORD_COLUMN,
        COMPONENT_COLUMN,
        STRUCTURE_COLUMN,
        METHOD_COLUMN,
        RATIO_COLUMN,
        ROTATION_COLUMN,
        OUTCOME_COLUMN,
        REGIME_COLUMN,
        LIGHT_COLUMN,
        Column(
            "error",
            "number",
            "Rotation ratio over that of the mechanism on the record, minus 1, where both rock",
        ),
        FRAGILE_COLUMN,
        *PROVENANCE,
    ),
)
