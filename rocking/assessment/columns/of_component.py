"""The columns of the tables with a row per component: the record and its pulses."""

from rocking.assessment.columns.shared import COMPONENT_COLUMN, PROVENANCE, RECORD_COLUMN
from rocking.tables import Column, Table

RECORD = Table(
    "record",
    "One row per component: what was read and what was done to it before use",
    (
        RECORD_COLUMN,
        COMPONENT_COLUMN,
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
        *PROVENANCE,
    ),
)

PULSES = Table(
    "pulses",
    "One row per sine pulse of acceleration; rank 1 of kind alternative is the dominant pulse",
    (
        RECORD_COLUMN,
        COMPONENT_COLUMN,
        Column(
            "kind",
            "string",
            "alternative: ranked on the record; sequence: pursued on the residual of the pulses before it; "
            "predicting: the pulse that predicts, where it is no alternative",
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
        *PROVENANCE,
    ),
)
