"""The columns of every result table, described once."""

from rocking.tables import Column, Table

_RECORD = Column("record", "string", "Identifier of the record in the catalogue")
_COMPONENT = Column("component", "string", "Component of the ground motion, as the file names it")
_STRUCTURE = Column("structure", "string", "Name of the structure in the structure list")
_METHOD = Column("method", "string", "How the number was computed")
_RATIO = Column(
    "rotation_ratio",
    "number",
    "Largest rotation over critical rotation; INF if it overturns, 0 without uplift",
)
_ROTATION = Column("rotation_rad", "number", "Largest rotation; INF if it overturns")
_OUTCOME = Column("outcome", "string", "no uplift, rocks, overturns or failed")
_REGIME = Column("regime", "string", "Regime of the closed form in which the prediction was made")
_LIGHT = Column(
    "light", "string", "Whether one pulse can stand for this record and structure: green, amber or red"
)
_IMPACTS = Column("impacts", "integer", "Number of impacts")
_FRAGILE = Column("fragile", "boolean", "Whether the stated change of amplitude flips the verdict")
_SENSITIVITY = Column("sensitivity", "number", "d ln(largest rotation) / d ln(ground acceleration)")
_PROVENANCE = (
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

RECORD = Table(
    "record",
    "One row per component: what was read and what was done to it before use",
    (
        _RECORD,
        _COMPONENT,
        Column("event", "string", "Earthquake"),
        Column("station", "string", "Recording station"),
        Column("file", "string", "File the record was read from"),
        Column("format", "string", "Format that recognised the file"),
        Column("unit", "string", "Unit of the numbers in the file"),
        Column("licence", "string", "Licence of the record, as the catalogue declares it"),
        Column("vertical_component", "string", "Vertical component that acts too; empty where none does"),
        Column("vertical_peak_acceleration_m_s2", "number", "Largest magnitude of the vertical acceleration"),
        Column("samples", "integer", "Number of samples"),
        Column("time_step_s", "number", "Time step"),
        Column("duration_s", "number", "Time from the first to the last sample"),
        Column("peak_acceleration_m_s2", "number", "Largest magnitude of the acceleration"),
        Column("peak_velocity_m_s", "number", "Largest magnitude of the velocity by trapezoid"),
        Column("peak_displacement_m", "number", "Largest magnitude of the displacement by trapezoid"),
        Column("high_pass_frequency_hz", "number", "Corner of the high-pass known to have been applied"),
        Column("processing", "string", "Steps applied to the numbers of the file, in order"),
        Column("warnings", "string", "What the reader noticed"),
        *_PROVENANCE,
    ),
)

PULSES = Table(
    "pulses",
    "One row per sine pulse of acceleration; rank 1 of kind alternative is the dominant pulse",
    (
        _RECORD,
        _COMPONENT,
        Column(
            "kind",
            "string",
            "alternative: ranked on the record; sequence: pursued on the residual of the pulses before it",
        ),
        Column("rank", "integer", "Place in its kind, from 1"),
        Column("amplitude_m_s2", "number", "Signed amplitude a_g"),
        Column("amplitude_low_m_s2", "number", "Lower end of the 90 % bootstrap interval of the amplitude"),
        Column("amplitude_high_m_s2", "number", "Upper end of the 90 % bootstrap interval of the amplitude"),
        Column("circular_frequency_rad_s", "number", "Circular frequency of the pulse"),
        Column("period_s", "number", "Period of the pulse"),
        Column("period_low_s", "number", "Lower end of the 90 % bootstrap interval of the period"),
        Column("period_high_s", "number", "Upper end of the 90 % bootstrap interval of the period"),
        Column("start_time_s", "number", "Start of the pulse after the first sample"),
        Column("gain_m2_s3", "number", "Energy gain of the matched filter"),
        Column("gain_ratio", "number", "Energy gain over that of the dominant pulse"),
        Column(
            "explained_energy",
            "number",
            "Share of the record's acceleration energy that the pulse explains (EVa)",
        ),
        Column("effective_length_m", "number", "Amplitude times period squared"),
        Column("flags", "string", "What makes the pulse doubtful"),
        *_PROVENANCE,
    ),
)

PREDICTIONS = Table(
    "predictions",
    "One row per structure and closed form: the equivalent block under the dominant pulse",
    (
        _RECORD,
        _COMPONENT,
        _STRUCTURE,
        _METHOD,
        Column("pulse_rank", "integer", "Rank of the pulse among the record's alternatives"),
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
        _RATIO,
        _ROTATION,
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
        _OUTCOME,
        _REGIME,
        _IMPACTS,
        _LIGHT,
        *_PROVENANCE,
    ),
)

RESPONSES = Table(
    "responses",
    "One row per structure and integration",
    (
        _RECORD,
        _COMPONENT,
        _STRUCTURE,
        _METHOD,
        _RATIO,
        _ROTATION,
        _OUTCOME,
        _IMPACTS,
        Column(
            "peak_side",
            "integer",
            "Side of the largest rotation or of the overturning: 1, -1, or 0 without uplift",
        ),
        Column("peak_time_s", "number", "Time of the largest rotation after the first sample"),
        Column("uplift_time_s", "number", "Time of the first uplift after the first sample"),
        _SENSITIVITY,
        _FRAGILE,
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
        *_PROVENANCE,
    ),
)

COMPARISON = Table(
    "comparison",
    "One row per structure: the closed form under the dominant pulse beside the integration of the whole record",
    (
        _RECORD,
        _COMPONENT,
        _STRUCTURE,
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
        _REGIME,
        _LIGHT,
        _SENSITIVITY,
        _FRAGILE,
        *_PROVENANCE,
    ),
)

CANDIDATES = Table(
    "candidates",
    "One row per height at which a wall may be hinged or a spire cracked: the governing height is marked",
    (
        _RECORD,
        _COMPONENT,
        _STRUCTURE,
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
        *_PROVENANCE,
    ),
)

PROCESSING = Table(
    "processing",
    "One row per structure and processing of the record: what the answer owes to baseline and corner frequency",
    (
        _RECORD,
        _COMPONENT,
        _STRUCTURE,
        Column("processing", "string", "What was done to the record besides what the record table says"),
        Column("peak_acceleration_m_s2", "number", "Largest magnitude of the acceleration then"),
        _RATIO,
        _OUTCOME,
        *_PROVENANCE,
    ),
)

MAXIMA = Table(
    "maxima",
    "One row per record, component, structure and method",
    (
        _RECORD,
        _COMPONENT,
        _STRUCTURE,
        _METHOD,
        _RATIO,
        _ROTATION,
        _OUTCOME,
        _REGIME,
        _LIGHT,
        Column(
            "error",
            "number",
            "Rotation ratio over that of the mechanism on the record, minus 1, where both rock",
        ),
        _FRAGILE,
        *_PROVENANCE,
    ),
)

STRUCTURES = Table(
    "structures",
    "One row per structure: its mechanism and its equivalent block",
    (
        _STRUCTURE,
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
        _STRUCTURE,
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
        _RECORD,
        _COMPONENT,
        _STRUCTURE,
        Column("stage", "string", "Stage that failed"),
        Column("message", "string", "What is wrong, what is allowed and what to do"),
    ),
)

TIMINGS = Table(
    "timings",
    "One row per record and stage; differs between runs of the same input",
    (_RECORD, Column("stage", "string", "Stage"), Column("duration_s", "number", "CPU time")),
)

SPECTRUM = Table(
    "spectrum",
    "One row per component and equivalent block under the whole record; written by rocking spectrum",
    (
        _COMPONENT,
        Column("frequency_parameter_rad_s", "number", "p of the equivalent block", "Eq. 11"),
        Column("uplift_multiplier", "number", "Uplift acceleration of the equivalent block in g", "Eq. 12"),
        Column("restitution", "number", "Ratio of angular velocities after and before an impact", "Eq. 2"),
        _RATIO,
        *_PROVENANCE[:2],
    ),
)

RECORD_TABLES = (RECORD, PULSES, PREDICTIONS, RESPONSES, COMPARISON, CANDIDATES, PROCESSING)
"""The tables of one record's folder that hold results."""
PER_RECORD = (*RECORD_TABLES, FAILURES, TIMINGS)
"""Every table of one record's folder."""
SUMMARY_TABLES = (RECORD, PULSES, COMPARISON, AGREEMENT, MAXIMA, STRUCTURES, EQUIVALENCE, FAILURES, TIMINGS)
"""The tables of the summary folder."""
